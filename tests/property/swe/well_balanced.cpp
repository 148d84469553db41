// The well-balanced bed force: still water over any bed stays at rest to round-off; what it costs elsewhere.
#include <catch2/catch.hpp>

#include "tests/support/run/scenes.hpp"

using namespace freshet;
using test::Flow;

namespace {

// A lake 1 m above the lowest ground, closed, over a bed that is rough down to the spacing of the particles.
Scene lake(int dimension) {
  Scene scene = test::bare_scene(dimension, {0, 0}, {4, dimension == 2 ? 3.0 : 0.0}, 0.1);
  test::close_box(scene);
  scene.bed.elevation = [dimension](double x, double y) {
    return 0.3 * std::sin(2 * x) * std::cos(3 * y) + (x < 2 ? 0.2 : 0.0) +
           0.05 * std::sin(40 * x + (dimension == 2 ? 30 * y : 0));
  };
  scene.bed.spacing = 0.05;
  scene.water.surface = [](double, double) { return 1.0; };
  const Function bed = scene.bed.elevation;
  scene.water.depth = [bed](double x, double y) { return 1 - bed(x, y); };
  scene.sph.acceleration = Acceleration::classical;
  return scene;
}

double fastest_in(const Scene& scene, int steps) {
  Flow flow(scene);
  double fastest = 0;
  for (int n = 0; n < steps; ++n) {
    flow.many_steps(1);
    fastest = std::max(fastest, flow.largest_speed());
  }
  return fastest / std::sqrt(9.81);
}

}  // namespace

TEST_CASE("well-balanced: still water over a rough bed with a step stays at rest to round-off") {
  const int dimension = GENERATE(1, 2);
  CAPTURE(dimension);
  Scene scene = lake(dimension);
  // Round-off of a force of g d/dx = 100 m/s2, 1e-14 relative, over 300 steps of 0.01 s: 3e-12 m/s.
  scene.sph.well_balanced = true;
  CHECK(fastest_in(scene, 300) < 1e-11);
  scene.sph.well_balanced = false;  // the test can tell
  CHECK(fastest_in(scene, 300) > 1e-3);
}

TEST_CASE("well-balanced: a bump of the surface still makes waves") {
  Scene scene = lake(2);
  scene.sph.well_balanced = true;
  scene.water.surface = [](double x, double y) {
    return 1 + 0.01 * std::exp(-4 * ((x - 2) * (x - 2) + (y - 1.5) * (y - 1.5)));
  };
  CHECK(fastest_in(scene, 30) > 1e-3);
}
