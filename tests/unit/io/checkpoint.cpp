// state.h5: to the bit, and never lost.
#include <catch2/catch.hpp>

#include <cstring>
#include <filesystem>
#include <limits>

#include "src/errors.hpp"
#include "src/io/checkpoint.hpp"
#include "src/io/files.hpp"
#include "tests/support/watch/full_disk.hpp"
#include "tests/support/watch/scratch.hpp"

using namespace freshet;
using test::FileSizeLimit;
namespace fs = std::filesystem;

namespace {

// Values whose bits a detour through text or float would change.
const std::vector<double> awkward{
    0.1, -0.0, 1e-310, 1 / 3.0, std::numeric_limits<double>::quiet_NaN(), 6543210.1234567};

FieldSet awkward_fields() {
  const int size = static_cast<int>(awkward.size());
  FieldSet fields(size);
  const auto x = fields.real("x", "m", Carry::state);
  const auto id = fields.integer("id", "1", Carry::state);
  fields.real("sorted", "1", Carry::sort);
  fields.real("scratch", "1", Carry::no);
  const auto host = on_host(x);
  const auto ids = on_host(id);
  for (int i = 0; i < size; ++i) {
    host(i) = awkward[static_cast<std::size_t>(i)];
    ids(i) = 100 - i;
  }
  Kokkos::deep_copy(x, host);
  Kokkos::deep_copy(id, ids);
  return fields;
}

Checkpoint some_checkpoint() {
  return {"/a/b.toml", "a = 1\n", {{"clock", {0.1, 7}}, {"none", {}}}, {{"phase", awkward}}};
}

bool same_bits(const std::vector<double>& a, const double* b) {
  return std::memcmp(a.data(), b, a.size() * sizeof(double)) == 0;
}

}  // namespace

TEST_CASE("checkpoints give every bit back") {
  const test::Scratch scratch;
  const std::string path = scratch / "state.h5";
  write_checkpoint(path, some_checkpoint(), awkward_fields());

  const Checkpoint read = read_checkpoint(path);
  CHECK(read.scene_file == "/a/b.toml");
  CHECK(read.scene_text == "a = 1\n");
  CHECK(read.run == some_checkpoint().run);
  CHECK(same_bits(awkward, read.method.at("phase").data()));

  FieldSet fields(2);  // a method starts with another particle count
  fields.real("x", "m", Carry::state);
  read_checkpoint_fields(path, fields);
  REQUIRE(fields.size() == static_cast<int>(awkward.size()));
  CHECK(same_bits(awkward, on_host(fields.real("x")).data()));
  CHECK(on_host(fields.integer("id"))(5) == 95);
  // What is recomputed every step is not stored.
  CHECK_FALSE(fields.has("sorted"));
  CHECK_FALSE(fields.has("scratch"));
  CHECK_FALSE(fs::exists(path + ".new"));
}

TEST_CASE("checkpoints lack no field that the method needs") {
  const test::Scratch scratch;
  write_checkpoint(scratch / "state.h5", some_checkpoint(), awkward_fields());
  FieldSet fields(1);
  fields.real("vorticity", "1/s", Carry::state);
  CHECK_THROWS_WITH(read_checkpoint_fields(scratch / "state.h5", fields),
                    Catch::Contains("no field vorticity"));
}

TEST_CASE("a checkpoint that cannot be written leaves the last one as it was") {
  const test::Scratch scratch;
  const std::string path = scratch / "state.h5";
  write_checkpoint(path, some_checkpoint(), awkward_fields());
  const std::string before = read_text(path);
  fs::create_directory(path + ".new");  // stands in the way even of root
  CHECK_THROWS_AS(write_checkpoint(path, {"", "other", {}, {}}, awkward_fields()), IoError);
  CHECK(read_text(path) == before);
}

TEST_CASE("a disk that fills up in the middle of a checkpoint is told and costs nothing") {
  const test::Scratch scratch;
  const std::string path = scratch / "state.h5";
  write_checkpoint(path, some_checkpoint(), awkward_fields());
  const std::string before = read_text(path);
  FieldSet large(20000);
  large.real("x", "m", Carry::state);
  for (const std::size_t limit : {3000u, 30000u, 200000u}) {  // a checkpoint takes 300 kB
    CAPTURE(limit);
    const FileSizeLimit full(limit);
    CHECK_THROWS_WITH(write_checkpoint(path, some_checkpoint(), large),
                      Catch::Contains(path) && Catch::Contains("cannot grow"));
  }
  CHECK(read_text(path) == before);
  CHECK_FALSE(fs::exists(path + ".new"));
  CHECK_NOTHROW(write_checkpoint(path, some_checkpoint(), large));  // once there is room again
  CHECK(read_checkpoint(path).run.at("clock") == std::vector<double>{0.1, 7});
}

TEST_CASE("a damaged checkpoint is an input error that names the file") {
  const test::Scratch scratch;
  const std::string path = scratch / "state.h5";
  write_checkpoint(path, some_checkpoint(), awkward_fields());
  fs::resize_file(path, fs::file_size(path) / 2);
  CHECK_THROWS_AS(read_checkpoint(path), IoError);
  CHECK_THROWS_WITH(read_checkpoint(path), Catch::Contains(path));
}
