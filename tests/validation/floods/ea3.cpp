// EA test 3, momentum over an obstruction: water must pass the crest, about as much as in a finite-volume
// solution of the same equations along the (uniform) flow.
#include <catch2/catch.hpp>

#include "src/io/fluid.hpp"
#include "tests/support/run/data.hpp"
#include "tests/support/run/run_case.hpp"
#include "tests/support/solve/channel.hpp"

using namespace freshet;

namespace {

constexpr double crest = 200, width = 100, manning = 0.01;  // m, m, s/m^(1/3)

test::ChannelFlow finite_volumes(const Scene& scene) {
  const Series discharge = scene.boundaries.at(0).imposed.at(0).series;
  test::ChannelFlow flow({0,
                          300,
                          600,
                          scene.gravity,
                          manning,
                          [&](double x) { return scene.bed.elevation(x, 50); },
                          [](double) { return 0.0; },
                          {},
                          [discharge](double t) { return discharge.at(t) / width; }});
  while (flow.time() < scene.end_time) flow.step(scene.end_time);
  return flow;
}

}  // namespace

TEST_CASE("EA test 3: momentum carries water over the crest", "[ea3][long]") {
  if (!test::data_file("ea_tests/test3/test3DEM.asc")) return;
  const Scene scene = test::read_case("ea3");
  const test::ChannelFlow reference = finite_volumes(scene);
  const test::CaseRun run = test::finish_case("ea3");
  const double beyond = run.mass_where([](double x, double) { return x > crest; });
  // 1,310 m3 enter, the hydrograph's; the particles carry 0.2 to 0.3 m3 each across the line.
  CHECK(run.summary.mass.inflow == Approx(1310).epsilon(0.005));
  CHECK(run.summary.mass.relative_error <= 1e-10);
  CHECK(beyond > 0);  // what diffusive solvers fail
  // A fifth of what the equations let pass: 2.5 % of the inflow.
  CHECK(beyond == Approx(width * reference.volume_beyond(crest)).epsilon(0.2));
  // Levels at the end: 2 cm, the tolerance of EA 4.
  CHECK(run.gauges[0].value.back() == Approx(reference.level(150)).margin(0.02));
  CHECK(run.gauges[1].value.back() == Approx(reference.level(250)).margin(0.02));
  CHECK(run.gauges[0].value.back() < 9.9998);  // below the crest
}
