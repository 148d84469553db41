// The scenes of cases/stress (tools/stress runs them all), a quick part: stable, or stopped with a message,
// never garbage in silence.
#include <catch2/catch.hpp>

#include "tests/support/run/run_case.hpp"
#include "tests/support/run/scenes.hpp"

using namespace freshet;

namespace {

test::Results run(const std::string& scene, const std::vector<std::string>& overrides) {
  return test::run_case("stress/" + scene, overrides);
}

// The limits of tools/stress, with d the depth that the scene starts from: energy in M g d/2, momentum in M
// sqrt(g d).
void require_sound(const test::Results& s, double depth) {
  const double g = 9.81, mass = s.mass.final;
  const double gained = s.end.kinetic + s.end.potential - s.start.kinetic - s.start.potential;
  CHECK(s.mass.relative_error < 1e-10);
  CHECK(gained / (0.5 * mass * g * depth) < 1e-3);
  CHECK(std::abs(s.end.momentum[1]) / (mass * std::sqrt(g * depth)) <
        1e-2);  // the scenes are symmetric about y
}

}  // namespace

TEST_CASE("stress: disorder, datum, origin and thin water leave a run sound") {
  const auto check = [](const std::string& scene, double depth, const std::vector<std::string>& overrides) {
    CAPTURE(scene, overrides);
    const test::Results s = run(scene, overrides);
    require_sound(s, depth);
    CHECK(s.report.warnings.empty());
  };
  check("basin", 0.5, {"time.end=2", "water.disorder=0.3"});
  check("hump", 0.5,
        {"time.end=2", "bed.z=1000 + 0.1*exp(-20*((x-0.5)^2+(y-0.5)^2))",
         "water.surface=1000.5 + 0.05*cos(pi*x/2)"});
  check("basin", 0.5,
        {"time.end=2", "domain.box=[5e5, 5e6, 500002.0, 5000001.0]",
         "water.depth=0.5 + 0.05*cos(pi*(x-500000)/2)"});
  check("film", 1e-4, {"time.end=10"});
  check("ratio", 1, {"water.depth=x < 0 ? 1 : 1e-6"});
  check("basin", 0.5, {"water.spacing=0.1", "time.end=40"});  // 2,000 steps
}

// A film without friction shoots down at 1 m/s where waves go at 0.03 m/s: a step of the waves alone carries
// it past the wall.
TEST_CASE("stress: thin fast water does not jump past a wall") {
  const test::Results s = run("film", {"bed.manning=0", "time.end=4"});
  CHECK(s.simulated == 4);
  CHECK(s.mass.relative_error < 1e-10);
}

// Particles of 1e-9 of the depth beside deep ones; the level right of the step is that of the bed.
TEST_CASE("stress: a surface level with the bed leaves no rounding that grows") {
  const test::Results s = run("step", {"bed.shape.right=0.3", "time.end=8"});
  require_sound(s, 0.5);
}

TEST_CASE("stress: past the stable step a run warns") {
  const test::Results s = run("basin", {"time.cfl=1.2", "time.end=4"});
  REQUIRE_FALSE(s.report.warnings.empty());
  CHECK_THAT(s.report.warnings[0], Catch::Contains("help: the time step may be too long"));
}

// Every second particle is put exactly onto its neighbour: pairs without a direction, twice the mass in half
// the places.
TEST_CASE("stress: particles released on top of each other") {
  Scene scene = test::read_case("stress/basin");
  test::Flow flow(scene);
  const auto id = std::as_const(*flow.method).fields().integer("id");
  std::vector<int> place(static_cast<std::size_t>(flow.size()));
  for (int i = 0; i < flow.size(); ++i) place[static_cast<std::size_t>(id(i))] = i;
  for (std::size_t k = 0; k + 1 < place.size(); k += 2)
    for (const char* x : {"x", "y"}) flow.real(x)(place[k + 1]) = flow.real(x)(place[k]);
  const Mechanics start = flow.method->mechanics();
  flow.many_steps(300);
  const Mechanics end = flow.method->mechanics();
  const double mass = flow.method->totals().mass;
  CHECK(std::isfinite(end.kinetic));
  CHECK(std::abs(end.momentum[1]) < 1e-2 * mass * std::sqrt(9.81 * 0.5));
  // The depth at the start is that before the move; afterwards the pairs' water can only fall.
  CHECK(end.kinetic + end.potential < 1.3 * (start.kinetic + start.potential));
  CHECK(flow.largest_speed() < 2 * std::sqrt(9.81 * 0.5));
}
