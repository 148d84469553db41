// Each way to go wrong is caught and told: what, which particle, where, when, which limit.
#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

#include "src/errors.hpp"
#include "src/run/watch/monitor.hpp"
#include "tests/support/run/fake_method.hpp"

using namespace freshet;
using Catch::Contains;
using Kind = test::Trouble::Kind;

namespace {

// Steps until the trouble in step 3 and asks the monitor after each.
void run(const Scene& scene, Kind kind) {
  test::FakeMethod method(scene);
  method.trouble = {kind, 3, 5};
  Monitor monitor(scene);
  monitor.begin(method);
  Clock clock;
  for (int k = 0; k < 3; ++k) {
    monitor.check(method, clock);  // does not cry before
    method.step(clock.t, 0.01);
    clock = {0.01 * (k + 1), k + 1};
  }
  monitor.check(method, clock);
  monitor.check_all(method, clock);
}

}  // namespace

TEST_CASE("the monitor is silent while all is well") {
  const int dimension = GENERATE(1, 2);
  CHECK_NOTHROW(run(test::fake_scene(dimension), Kind::none));
}

TEST_CASE("the monitor names what, which particle, when and the limit") {
  const int dimension = GENERATE(1, 2);
  const Scene scene = test::fake_scene(dimension);
  const std::vector<std::pair<Kind, std::string>> troubles{
      {Kind::not_a_number, "u = "},
      {Kind::infinite, "depth = inf; limit: every value is finite"},
      {Kind::negative_depth, "depth = -0.001 m; limit: "},
      {Kind::fast, "limit: limits.speed = 10 m/s"},
      {Kind::lost, "left the domain; limit: "}};
  for (const auto& [kind, what] : troubles) {
    CHECK_THROWS_AS(run(scene, kind), Diverged);
    CHECK_THROWS_WITH(run(scene, kind),
                      Contains("particle 5 at x = ") && Contains("t = 0.03 s, step 3:") && Contains(what));
  }
  CHECK_THROWS_WITH(run(scene, Kind::leak),
                    Contains("mass balance") && Contains("limits.mass_error = 1e-06"));
}

TEST_CASE("of several troubled particles the lowest id is named, wherever it lies in memory") {
  const Scene scene = test::fake_scene(1);
  test::FakeMethod method(scene);
  for (int k = 0; k < 7; ++k) method.step(0, 1e-3);  // they change places in the fourth
  Kokkos::deep_copy(method.fields().real("depth"), -1.0);
  CHECK_THROWS_WITH(Monitor(scene).check(method, {}), Contains("particle 0 at"));
}

TEST_CASE("particles may enter the buffer of an open boundary, and no more") {
  Scene scene = test::fake_scene(1);
  const double dx = scene.water.spacing;
  const auto check_at = [&](double x) {
    test::FakeMethod method(scene);
    const auto field = method.fields().real("x");
    Kokkos::deep_copy(Kokkos::subview(field, 0), x);
    Monitor(scene).check(method, {});
  };
  CHECK_THROWS_AS(check_at(-6 * dx), Diverged);  // 5 h without a boundary: outside the margin of 4 h
  scene.boundaries.emplace_back();
  CHECK_NOTHROW(check_at(-6 * dx));
  CHECK_THROWS_AS(check_at(-12 * dx), Diverged);
}

TEST_CASE("a field that no pass reads yet is looked at when output is due") {
  const Scene scene = test::fake_scene(1);
  test::FakeMethod method(scene);
  Monitor monitor(scene);
  monitor.begin(method);
  Kokkos::deep_copy(Kokkos::subview(method.fields().real("bed"), 2), std::numeric_limits<double>::infinity());
  CHECK_NOTHROW(monitor.check(method, {}));
  CHECK_THROWS_WITH(monitor.check_all(method, {}), Contains("particle 2 at") && Contains("bed = inf"));
}

TEST_CASE("a time step that does not advance is a divergence") {
  const Monitor monitor(test::fake_scene());
  CHECK_NOTHROW(monitor.check_dt(1e-9, {1.0, 5}));
  for (const double dt : {0.0, -1.0, 1e-20, std::nan("")})
    CHECK_THROWS_AS(monitor.check_dt(dt, {1.0, 5}), Diverged);
}

TEST_CASE("the mass error counts what came in and went out") {
  Totals totals;
  totals.mass = 12.5;
  totals.inflow = 3;
  totals.outflow = 1;
  CHECK(mass_error(10, totals) == Approx(0.05).epsilon(1e-14));  // 0.5 too much of 10; rounding only
}
