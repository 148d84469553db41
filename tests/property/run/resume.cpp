// A run that is stopped and resumed, once or often, ends with the bits of the straight run.
#include <catch2/catch.hpp>

#include <atomic>
#include <cstring>
#include <filesystem>
#include <functional>
#include <map>

#include "src/errors.hpp"
#include "src/io/files.hpp"
#include "src/io/h5part.hpp"
#include "src/io/hdf5.hpp"
#include "src/run/driver.hpp"
#include "src/scene/read.hpp"
#include "tests/support/run/fake_method.hpp"
#include "tests/support/watch/scratch.hpp"

using namespace freshet;
namespace fs = std::filesystem;

namespace {

using Factory = std::function<std::unique_ptr<Method>(const Scene&)>;

// Passes everything on and sets a flag at the end of the given step.
class Interrupted : public Method {
 public:
  Interrupted(Method& method, long steps, std::atomic<bool>& stop)
      : method_(method), left_(steps), stop_(stop) {}
  std::string name() const override { return method_.name(); }
  int dimension() const override { return method_.dimension(); }
  double stable_dt() const override { return method_.stable_dt(); }
  void step(double t, double dt) override {
    method_.step(t, dt);
    if (--left_ == 0) stop_ = true;
  }
  FieldSet& fields() override { return method_.fields(); }
  const FieldSet& fields() const override { return method_.fields(); }
  const Rows& rows() const override { return method_.rows(); }
  Totals totals() const override { return method_.totals(); }
  Mechanics mechanics() const override { return method_.mechanics(); }
  StepReport report() const override { return method_.report(); }
  std::vector<PointState> sample(const std::vector<Point>& points) const override {
    return method_.sample(points);
  }
  void raise_wet_levels(const Shores& shores) const override { method_.raise_wet_levels(shores); }
  std::vector<std::string> features() const override { return method_.features(); }
  ScalarState scalars() const override { return method_.scalars(); }
  void restore(const ScalarState& scalars) override { method_.restore(scalars); }

 private:
  Method& method_;
  long left_;
  std::atomic<bool>& stop_;
};

// One process' share of a run: from the checkpoint in the directory, if there is one, through so many steps.
// True at the end.
bool run_steps(const Scene& scene, const Factory& make, const test::Scratch& scratch, long steps) {
  std::atomic<bool> stop{false};
  const auto method = make(scene);
  Interrupted interrupted(*method, steps, stop);
  Driver driver(scene, interrupted, {scratch.path(), nullptr, false, &stop});
  const std::string state = scratch / "state.h5";
  if (std::filesystem::exists(state)) {
    const Checkpoint checkpoint = read_checkpoint(state);
    read_checkpoint_fields(state, method->fields());
    method->restore(checkpoint.method);
    driver.restore(checkpoint);
  } else {
    driver.begin();
  }
  return driver.run();
}

void require_same_group(const test::Scratch& a, const test::Scratch& b, const char* group) {
  const auto left = hdf5::File::look(a / "state.h5"), right = hdf5::File::look(b / "state.h5");
  const auto in_left = left.open(group), in_right = right.open(group);
  REQUIRE(in_left.names() == in_right.names());
  for (const auto& name : in_left.names()) {
    CAPTURE(group, name);
    const auto x = in_left.reals(name), y = in_right.reals(name);
    REQUIRE(x.size() == y.size());
    CHECK(std::memcmp(x.data(), y.data(), x.size() * sizeof(double)) == 0);
  }
}

// Every text file below the directory, by its path there.
std::map<std::string, std::string> texts(const test::Scratch& scratch) {
  std::map<std::string, std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(scratch.path()))
    if (entry.path().extension() == ".csv" || entry.path().extension() == ".asc")
      found[fs::relative(entry.path(), scratch.path()).string()] = read_text(entry.path().string());
  return found;
}

void require_same_results(const test::Scratch& a, const test::Scratch& b) {
  for (const char* group : {"reals", "integers", "method"}) require_same_group(a, b, group);
  Values left = read_checkpoint(a / "state.h5").run, right = read_checkpoint(b / "state.h5").run;
  for (Values* values : {&left, &right}) REQUIRE(values->erase("effort") == 1);  // seconds of wall clock
  REQUIRE(left.size() == right.size());
  for (const auto& [name, values] : left) {
    CAPTURE(name);
    // As bits: some are NaN, and the values themselves would flood the report.
    const auto& others = right.at(name);
    REQUIRE(values.size() == others.size());
    CHECK(std::memcmp(values.data(), others.data(), values.size() * sizeof(double)) == 0);
  }
  const auto of_a = texts(a), of_b = texts(b);
  REQUIRE(of_a.size() == of_b.size());
  for (const auto& [file, text] : of_a) {
    CAPTURE(file);
    CHECK((text == of_b.at(file)));
  }
  const auto steps = list_particle_steps(a / "particles.h5part");
  REQUIRE(steps.size() == list_particle_steps(b / "particles.h5part").size());
  for (const auto& step : steps) {
    CAPTURE(step.step);
    const auto of = [&](const test::Scratch& s) {
      return read_particle_step(s / "particles.h5part", step.step);
    };
    CHECK((of(a)["x"] == of(b)["x"] && of(a)["depth"] == of(b)["depth"] && of(a)["v_0"] == of(b)["v_0"] &&
           of(a)["id"] == of(b)["id"]));
  }
}

// Runs straight, then again in pieces of so many steps, each in a new method and driver.
void check_pieces(const Scene& scene, const Factory& make, long piece) {
  const test::Scratch straight, pieces;
  REQUIRE(run_steps(scene, make, straight, -1));
  int count = 1;
  while (!run_steps(scene, make, pieces, piece)) ++count;
  CHECK(count > 1);
  require_same_results(straight, pieces);
}

std::unique_ptr<Method> make_fake(const Scene& scene) { return std::make_unique<test::FakeMethod>(scene); }

}  // namespace

TEST_CASE("the run loop resumes to the bit") {
  const int dimension = GENERATE(1, 2);
  const long piece = GENERATE(1, 7);
  Scene scene = GENERATE(0, 1) ? test::observed_scene(dimension) : test::fake_scene(dimension);
  scene.end_time = 0.6;
  check_pieces(scene, make_fake, piece);
}

TEST_CASE("every observer resumes, and asks for what it saved") {
  const test::Scratch scratch;
  const Scene scene = test::observed_scene();
  REQUIRE_FALSE(run_steps(scene, make_fake, scratch, 20));
  const Checkpoint whole = read_checkpoint(scratch / "state.h5");
  test::FakeMethod method(scene);
  const auto restore = [&](const Checkpoint& from) { Driver(scene, method, {scratch.path()}).restore(from); };
  CHECK_NOTHROW(restore(whole));
  for (const auto& one : whole.run) {
    CAPTURE(one.first);
    Checkpoint without = whole;
    without.run.erase(one.first);
    // As an older version would have left it: an error that says so, not one of the program.
    CHECK_THROWS_AS(restore(without), IoError);
    CHECK_THROWS_WITH(restore(without), Catch::Contains("state.h5") &&
                                            Catch::Contains("another version of the program wrote it"));
  }
}

TEST_CASE("what was written after the last checkpoint is written again, not twice") {
  const test::Scratch straight, crashed;
  const Scene scene = test::fake_scene();
  REQUIRE(run_steps(scene, make_fake, straight, -1));
  REQUIRE_FALSE(run_steps(scene, make_fake, crashed, 20));
  const std::string checkpoint = read_text(crashed / "state.h5");
  REQUIRE_FALSE(run_steps(scene, make_fake, crashed, 30));
  write_text(crashed / "state.h5",
             checkpoint);  // as if the process had been killed: outputs are newer than the state
  REQUIRE(run_steps(scene, make_fake, crashed, -1));
  require_same_results(straight, crashed);
}

TEST_CASE("a wet dam break resumes to the bit") {
  Scene scene = read_scene("cases/dam_break_wet.toml", {"water.spacing=20", "output.every=5"});
  Gauge gauge;
  gauge.name = "right";
  gauge.at = {1200, 0};
  scene.gauges = {gauge};
  scene.output.gauges_every = 0.7;
  check_pieces(scene, make_method, GENERATE(5, 23));
}

TEST_CASE("semi-implicit runs resume to the bit") {
  const Scene wet =
      read_scene("cases/sisph_bump.toml", {"water.spacing=0.04", "water.disorder=0.2", "time.end=0.03"});
  check_pieces(wet, make_method, GENERATE(5, 13));
  const Scene drying =
      read_scene("cases/thacker.toml", {"scene.method=sisph", "water.spacing=250", "time.end=300"});
  check_pieces(drying, make_method, 4);
  const Scene walled = read_scene("cases/sisph_seiche.toml", {"time.end=0.2"});
  check_pieces(walled, make_method, 7);
  const Scene open = read_scene("cases/sisph_channel.toml", {"time.end=20", "boundary.1.type=transmissive"});
  check_pieces(open, make_method, 7);
}

TEST_CASE("semi-implicit runs whose particles move resume to the bit") {
  const std::string paths = GENERATE("theta", "rk3", "leap-frog");
  const Scene walled = read_scene("cases/sisph_seiche.toml",
                                  {"sisph.formulation=moving", "sisph.paths=" + paths,
                                   "water.depth=1+0.1*cos(pi*x)", "time.end=0.2", "bed.z=0.1*sin(3*x)"});
  check_pieces(walled, make_method, 3);
}

TEST_CASE("a dam break that splits and merges resumes to the bit") {
  const Scene scene = read_scene("cases/dam_break_dry_strip.toml",
                                 {"water.spacing=20", "time.end=24", "split.area=1.5",
                                  "split.velocity=linear", "merge.area=0.35", "output.every=5"});
  const auto method = make_method(scene);
  for (double t = 0; t < 24;) {
    const double dt = method->stable_dt();
    method->step(t, dt);
    t += dt;
  }
  REQUIRE(method->scalars().at("refinement")[0] > 50);
  REQUIRE(method->scalars().at("refinement")[1] > 10);
  check_pieces(scene, make_method, GENERATE(5, 13));
}

TEST_CASE("rasters and their maxima resume to the bit") {
  Scene scene;
  scene.name = "drop";
  scene.text = "name = \"drop\"\n";
  scene.end_time = 0.2;
  scene.domain = {2, {-1, -1}, {1, 1}};
  scene.water.spacing = 0.05;
  scene.water.depth = [](double x, double y) { return 0.5 - x * x - y * y; };
  scene.water.wet_above = 0.05;
  Rasters rasters;
  rasters.spacing = 0.07;
  rasters.every = 0.06;
  rasters.what = {Rasters::Quantity::depth};
  rasters.maxima = true;
  scene.rasters = rasters;
  check_pieces(scene, make_method, GENERATE(1, 6));
}
