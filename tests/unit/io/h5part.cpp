// particles.h5part: positions, selection of fluid particles, appending after a truncation.
#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>
#include <set>

#include "cellgrid/parallel/assign.hpp"
#include "src/errors.hpp"
#include "src/io/h5part.hpp"
#include "src/io/hdf5.hpp"
#include "tests/support/watch/full_disk.hpp"
#include "tests/support/watch/scratch.hpp"

using namespace freshet;

namespace {

constexpr double easting = 412345.678,
                 northing = 6543210.123;  // m, UTM: the largest coordinates that maps use

// Three particles; the second is a boundary particle.
FieldSet three_particles(bool two_d) {
  FieldSet fields(3);
  const auto set = [&](const char* name, double a, double b, double c) {
    const bool speed = name[0] == 'u' || name[0] == 'v';
    upload(fields.real(name, speed ? "m/s" : "m", Carry::state), std::vector<double>{a, b, c});
  };
  const auto set_integer = [&](const char* name, int a, int b, int c) {
    upload(fields.integer(name, "1", Carry::state), std::vector<int>{a, b, c});
  };
  set("x", easting, easting + 1, easting + 0.001);
  set("u", 1.5, 2.5, -3.5);
  if (two_d) {
    set("y", northing, northing, northing + 0.002);
    set("v", 0.25, 0, 0.125);
  }
  set("bed", -1, -2, -3);
  set("depth", 1.75, 2, 4.5);
  set_integer("id", 7, 8, 9);
  set_integer("kind", 0, 1, 0);
  return fields;
}

}  // namespace

TEST_CASE("particle files give UTM positions back and leave boundary particles out") {
  const test::Scratch scratch;
  const ParticleFile file(scratch / "particles.h5part");
  file.create("a = 1\n", "0.1", three_particles(true));
  file.append(0, 0.5, three_particles(true));

  const auto step = read_particle_step(scratch / "particles.h5part", 0);
  REQUIRE(step["x"].size() == 2);
  CHECK(step.t == 0.5);
  // Required: 1 mm. Stored as float64: the same bits. As float32 the error would be 0.25 m.
  CHECK(step["x"] == std::vector<double>{easting, easting + 0.001});
  CHECK(step["y"] == std::vector<double>{northing, northing + 0.002});
  // Numbers that float32 holds exactly.
  CHECK(step["z"] == std::vector<double>{0.75, 1.5});
  CHECK(step["depth"] == std::vector<double>{1.75, 4.5});
  CHECK(step["v_0"] == std::vector<double>{1.5, -3.5});
  CHECK(step["v_1"] == std::vector<double>{0.25, 0.125});
  CHECK(step["id"] == std::vector<double>{7, 9});
}

TEST_CASE("what is read of a step comes in one order, with units") {
  const test::Scratch scratch;
  const ParticleFile file(scratch / "particles.h5part", {{"bed", "v", "z", "depth"}});
  file.create("", "0.1", three_particles(true));
  file.append(0, 0, three_particles(true));
  std::string titles;
  for (const ParticleColumn& column : read_particle_step(scratch / "particles.h5part", 0).columns)
    titles += column.name + " [" + column.unit + "] ";
  CHECK(titles == "x [m] y [m] z [m] depth [m] v_1 [m/s] bed [m] id [1] ");
}

TEST_CASE("particle files of 1-D scenes have y = 0 and no v_1") {
  const test::Scratch scratch;
  const ParticleFile file(scratch / "particles.h5part");
  file.create("", "0.1", three_particles(false));
  file.append(0, 0, three_particles(false));
  const auto step = read_particle_step(scratch / "particles.h5part", 0);
  CHECK(step["y"] == std::vector<double>{0, 0});
  CHECK(step["v_1"].empty());
}

TEST_CASE("particle files tell the scene, the version and the units") {
  const test::Scratch scratch;
  // Attributes end at 64 KiB: a scene with a long series must not.
  const std::string scene(200000, '#');
  ParticleFile(scratch / "particles.h5part").create(scene, "1.2.3", three_particles(true));
  const auto file = hdf5::File::look(scratch / "particles.h5part");  // must outlive its groups
  const auto about = file.open("freshet");
  CHECK(about.text("scene") == scene);
  CHECK(about.text_attribute("version") == "1.2.3");
  CHECK(about.text_attribute("units") ==
        "x m, y m, z m (free surface), depth m, v_0 m/s, v_1 m/s, id 1, TimeValue s");
}

TEST_CASE("particle files hold the fields that are asked for, once each, and no others") {
  const test::Scratch scratch;
  const ParticleFile file(scratch / "particles.h5part", {{"bed", "v", "bed"}});
  file.create("", "0.1", three_particles(true));
  file.append(0, 0, three_particles(true));
  const auto all = hdf5::File::look(scratch / "particles.h5part");
  CHECK(all.open("freshet").text_attribute("units") == "x m, y m, bed m, v_1 m/s, id 1, TimeValue s");
  const auto step = all.open("Step#0");
  CHECK(step.names() == std::vector<std::string>{"bed", "id", "v_1", "x", "y"});
  CHECK(step.reals("bed") == std::vector<double>{-1, -3});
  CHECK(read_particle_step(scratch / "particles.h5part", 0)["depth"].empty());
}

TEST_CASE("particle files read no field that nobody asked for") {
  static std::vector<std::string> read;
  const test::Scratch scratch;
  FieldSet fields = three_particles(true);
  for (const char* name : {"mass", "h", "ax"}) fields.real(name, "m", Carry::state);
  const auto labels = [&](const std::optional<std::vector<std::string>>& wanted) {
    const ParticleFile file(scratch / "particles.h5part", wanted);
    file.create("", "0.1", fields);
    read.clear();
    on_host_read = [](const char* label, std::size_t) { read.emplace_back(label); };
    file.append(0, 0, fields);
    on_host_read = nullptr;
    return std::set<std::string>(read.begin(), read.end());
  };
  CHECK(labels({{"h"}}) == std::set<std::string>{"kind", "x", "y", "h", "id"});
  CHECK(labels({}) ==
        std::set<std::string>{"kind", "x", "y", "bed", "depth", "u", "v", "mass", "id"});  // mass: of size
}

// Numbers that float32 holds exactly.
TEST_CASE(
    "particle files tell what each particle covers: a square's side, in 1-D a length, 0 where it is dry") {
  const bool two_d = GENERATE(true, false);
  const test::Scratch scratch;
  FieldSet fields = three_particles(two_d);
  upload(fields.real("mass", two_d ? "m3" : "m2", Carry::state), std::vector<double>{7, 1, 0});
  upload(fields.real("depth"), std::vector<double>{1.75, 1, 0});
  const ParticleFile file(scratch / "particles.h5part");
  file.create("", "0.1", fields);
  file.append(0, 0, fields);
  const auto all = hdf5::File::look(scratch / "particles.h5part");
  CHECK(all.open("freshet").text_attribute("units").find("size m,") != std::string::npos);
  CHECK(all.open("Step#0").reals("size") == std::vector<double>{two_d ? 2.0 : 4.0, 0});
}

TEST_CASE(
    "particle files of points without a depth have the spacing for a size, where it varies each point's") {
  const test::Scratch scratch;
  FieldSet fields(2);
  for (const char* name : {"x", "y", "u", "v", "p"}) fields.real(name, "1", Carry::state);
  fields.integer("id", "1", Carry::state);
  fields.integer("surface", "1", Carry::state);
  const ParticleFile file(scratch / "particles.h5part", {}, 0.25);
  file.create("", "0.1", fields);
  file.append(0, 0, fields);
  upload(fields.real("dx", "m", Carry::state), std::vector<double>{0.25, 0.5});
  file.append(1, 1, fields);
  const auto all = hdf5::File::look(scratch / "particles.h5part");
  CHECK(all.open("Step#0").names() ==
        std::vector<std::string>{"id", "p", "size", "surface", "v_0", "v_1", "x", "y"});
  CHECK(all.open("Step#0").reals("size") == std::vector<double>{0.25, 0.25});
  CHECK(all.open("Step#1").reals("size") == std::vector<double>{0.25, 0.5});
}

TEST_CASE("particle files are cut and continued") {
  const test::Scratch scratch;
  const ParticleFile file(scratch / "particles.h5part");
  const auto fields = three_particles(true);
  file.create("", "0.1", fields);
  for (int k = 0; k < 12; ++k) file.append(k, 0.1 * k, fields);
  file.truncate(3);
  file.append(3, 9.0, fields);
  const auto steps = list_particle_steps(scratch / "particles.h5part");
  REQUIRE(steps.size() == 4);  // in the order of their numbers: 0, 1, 2, 3
  CHECK(steps[2].t == 0.1 * 2);
  CHECK(steps[3].step == 3);
  CHECK(steps[3].t == 9.0);
}

TEST_CASE("a disk that fills up in the middle of an output is an error and spares the earlier outputs") {
  const test::Scratch scratch;
  const std::string path = scratch / "particles.h5part";
  FieldSet fields(20000);
  for (const char* name : {"x", "u", "depth"}) fields.real(name, "m", Carry::state);
  fields.integer("id", "1", Carry::state);
  const ParticleFile file(path);
  file.create("", "0.1", fields);
  file.append(0, 0, fields);
  for (const std::size_t room : {0u, 3000u, 100000u, 600000u}) {  // an output takes 720 kB
    CAPTURE(room);
    const test::FileSizeLimit full(std::filesystem::file_size(path) + room);
    CHECK_THROWS_AS(file.append(1, 1, fields), IoError);
    CHECK_THROWS_WITH(file.append(1, 1, fields), Catch::Contains(path) && Catch::Contains("cannot grow"));
    REQUIRE(list_particle_steps(path).size() == 1);
    CHECK(read_particle_step(path, 0)["x"].size() == 20000);
  }
  CHECK_NOTHROW(file.append(1, 1, fields));  // once there is room again
  CHECK(list_particle_steps(path).size() == 2);
}

TEST_CASE("empty particle sets can be written and read") {
  const test::Scratch scratch;
  FieldSet fields(0);
  for (const char* name : {"x", "u", "depth"}) fields.real(name, "m", Carry::state);
  fields.integer("id", "1", Carry::state);
  const ParticleFile file(scratch / "particles.h5part");
  file.create("", "0.1", fields);
  file.append(0, 0, fields);
  CHECK(read_particle_step(scratch / "particles.h5part", 0)["x"].empty());
}

TEST_CASE("particle file errors name the file and the step") {
  const test::Scratch scratch;
  const std::string path = scratch / "particles.h5part";
  CHECK_THROWS_AS(list_particle_steps(path), IoError);
  ParticleFile(path).create("", "0.1", three_particles(true));
  CHECK_THROWS_WITH(read_particle_step(path, 4), Catch::Contains(path) && Catch::Contains("no step 4"));
}
