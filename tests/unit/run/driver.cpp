// The loop: what is written when, and what is left behind by a run that diverges.
#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include "src/errors.hpp"
#include "src/io/files.hpp"
#include "src/io/h5part.hpp"
#include "src/io/hdf5.hpp"
#include "src/reference/exact.hpp"
#include "src/run/driver.hpp"
#include "tests/support/run/fake_method.hpp"
#include "tests/support/run/run_case.hpp"
#include "tests/support/watch/scratch.hpp"

using namespace freshet;
namespace fs = std::filesystem;

namespace {

class Still : public Exact {
 public:
  FlowState at(double, double, double) const override { return {1, 0, 0}; }
};

std::vector<double> output_times(const test::Scratch& scratch) {
  std::vector<double> times;
  for (const auto& step : list_particle_steps(scratch / "particles.h5part")) times.push_back(step.t);
  return times;
}

}  // namespace

TEST_CASE("a run writes its outputs exactly on time") {
  const test::Scratch scratch;
  const Scene scene = test::fake_scene();
  test::FakeMethod method(scene);
  Driver driver(scene, method, {scratch.path()});
  driver.begin();
  CHECK(driver.run());
  CHECK(output_times(scratch) == std::vector<double>{0, 0.25, 0.5, 0.75, 1});
  CHECK(fs::exists(scratch / "state.h5"));
  CHECK_FALSE(fs::exists(scratch / "measured.csv"));

  const test::Results summary = test::results_of(driver, method);
  CHECK(summary.simulated == 1.0);
  CHECK(summary.steps == driver.clock().step);
  CHECK(summary.initial_particles == 400);
  CHECK(summary.final_particles == 400);
  CHECK(summary.mass.relative_error == 0);  // the fake method never touches the mass
  CHECK(summary.particle_steps_per_s > 0);
  REQUIRE(summary.gauges.size() == 1);
  CHECK(summary.gauges[0].peak >= 1);
  CHECK_FALSE(find<ErrorRecorder>(driver.observers()));
}

// The fake method shuffles its particles: a field in another order than the ids would show.
TEST_CASE("a run writes the fields that its scene asks for, each value with its particle") {
  const test::Scratch scratch;
  Scene scene = test::fake_scene();
  scene.output.fields = {{"mass", "depth", "h"}};
  test::FakeMethod method(scene);
  Driver driver(scene, method, {scratch.path()});
  driver.begin();
  REQUIRE(driver.run());
  const int last = list_particle_steps(scratch / "particles.h5part").back().step;
  const auto file = hdf5::File::look(scratch / "particles.h5part");
  const auto group = file.open("Step#" + std::to_string(last));
  CHECK(group.names() == std::vector<std::string>{"depth", "h", "id", "mass", "x", "y"});
  const FieldSet& fields = std::as_const(method).fields();
  const auto id = group.integers("id");
  REQUIRE(id.size() == static_cast<std::size_t>(fields.size()));
  for (const char* name : {"depth", "mass", "h"}) {
    std::map<int, float> held;
    const auto written = group.reals(name);
    for (std::size_t k = 0; k < id.size(); ++k) held[id[k]] = static_cast<float>(written[k]);
    for (int i = 0; i < fields.size(); ++i)
      REQUIRE(held.at(fields.integer("id")(i)) == static_cast<float>(fields.real(name)(i)));
  }
}

TEST_CASE("a scene without an output interval writes its first and last state") {
  const test::Scratch scratch;
  Scene scene = test::fake_scene(1);
  scene.output = {};
  test::FakeMethod method(scene);
  Driver driver(scene, method, {scratch.path()});
  driver.begin();
  CHECK(driver.run());
  CHECK(output_times(scratch) == std::vector<double>{0, 1});
}

TEST_CASE("all errors are taken at the times that the scene names, before and after a restart") {
  const test::Scratch scratch;
  Scene scene = test::fake_scene(1);
  scene.compare.exact = std::make_shared<Still>();
  scene.compare.times = {0.3, 0.6, 1};
  std::atomic<bool> stop{false};
  const auto finish = [&](const std::string& directory, bool interrupted) {
    fs::create_directories(directory);
    test::FakeMethod method(scene);
    Driver driver(scene, method, {directory, nullptr, false, interrupted ? &stop : nullptr});
    if (interrupted) method.on_step = [&](long step) { stop = step == 30; };
    driver.begin();
    CHECK(driver.run() == !interrupted);
    return test::results_of(driver, method);
  };
  const test::Results whole = finish(scratch / "whole", false);
  REQUIRE(whole.errors_at.size() == 3);
  CHECK(whole.errors_at[1].t == 0.6);
  CHECK(whole.errors_at[2].errors.depth_l2_rel == whole.errors.depth_l2_rel);
  CHECK(whole.errors_at[0].errors.depth_l2_rel != whole.errors_at[1].errors.depth_l2_rel);

  const test::Results half = finish(scratch / "half", true);
  REQUIRE(half.errors_at.size() == 1);
  test::FakeMethod method(scene);
  const Checkpoint checkpoint = read_checkpoint(scratch / "half/state.h5");
  read_checkpoint_fields(scratch / "half/state.h5", method.fields());
  method.restore(checkpoint.method);
  Driver driver(scene, method, {scratch / "half"});
  driver.restore(checkpoint);
  CHECK(driver.run());
  const auto again = test::results_of(driver, method).errors_at;
  REQUIRE(again.size() == 3);
  for (std::size_t k = 0; k < 3; ++k)
    CHECK(again[k].errors.depth_l2_rel == whole.errors_at[k].errors.depth_l2_rel);
}

TEST_CASE("depth_l1_rel is the median over the comparison times") {
  const test::Scratch scratch;
  Scene scene = test::fake_scene(1);
  scene.compare.exact = std::make_shared<Still>();
  scene.compare.samples = 3;
  scene.compare.window = 0.4;
  test::FakeMethod method(scene);
  Driver driver(scene, method, {scratch.path()});
  driver.begin();
  CHECK(driver.run());
  const Values run = read_checkpoint(scratch / "state.h5").run;
  REQUIRE(run.at("depth_l1_rel").size() == 3);
  auto samples = run.at("depth_l1_rel");
  std::sort(samples.begin(), samples.end());
  CHECK(samples[0] < samples[2]);  // three different times
  const ErrorNorms errors = test::results_of(driver, method).errors;
  CHECK(errors.depth_l1_rel == samples[1]);
  CHECK(errors.depth_l2_rel > 0);
}

TEST_CASE("a run that diverges leaves its state beside the last good checkpoint") {
  const test::Scratch scratch;
  Scene scene = test::fake_scene();
  scene.output.checkpoint_every = 1e-9;  // after every step
  test::FakeMethod method(scene);
  method.trouble = {test::Trouble::Kind::not_a_number, 20, 3};
  Driver driver(scene, method, {scratch.path()});
  driver.begin();
  CHECK_THROWS_WITH(driver.run(), Catch::Contains("particle 3") && Catch::Contains("diverged.h5"));
  CHECK(read_checkpoint(scratch / "state.h5").run.at("clock")[1] == 19);
  CHECK(read_checkpoint(scratch / "diverged.h5").run.at("clock")[1] == 20);
  CHECK(list_particle_steps(scratch / "particles.h5part").back().t == driver.clock().t);
}

TEST_CASE("a collapsed time step ends the run") {
  const test::Scratch scratch;
  const Scene scene = test::fake_scene(1);
  test::FakeMethod method(scene);
  method.trouble = {test::Trouble::Kind::no_dt, 10, 0};
  Driver driver(scene, method, {scratch.path()});
  driver.begin();
  CHECK_THROWS_WITH(driver.run(), Catch::Contains("stable time step is 0 s"));
}

TEST_CASE(
    "a full or lost directory in the middle of a run is an input-output error and spares the last "
    "checkpoint") {
  const test::Scratch scratch;
  Scene scene = test::fake_scene(1);
  scene.output.checkpoint_every = 1e-9;
  test::FakeMethod method(scene);
  method.on_step = [&](long step) {
    if (step == 10) fs::create_directory(scratch / "state.h5.new");
  };
  Driver driver(scene, method, {scratch.path()});
  driver.begin();
  CHECK_THROWS_AS(driver.run(), IoError);
  CHECK(read_checkpoint(scratch / "state.h5").run.at("clock")[1] == 9);
}

TEST_CASE("progress: ten plain lines elsewhere than on a terminal") {
  const test::Scratch scratch;
  const Scene scene = test::fake_scene(1);
  test::FakeMethod method(scene);
  std::FILE* log = std::fopen((scratch / "log").c_str(), "w");
  Driver driver(scene, method, {scratch.path(), log});
  driver.begin();
  CHECK(driver.run());
  std::fclose(log);
  const std::string text = read_text(scratch / "log");
  CHECK(std::count(text.begin(), text.end(), '\n') == 10);
  CHECK(text.find("100.0 %  0:00 left  t 1 s") != std::string::npos);
  CHECK(text.find('\r') == std::string::npos);
}
