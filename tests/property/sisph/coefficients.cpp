// Runs whose coefficients are found anew in every product against those that store them.
#include <catch2/catch.hpp>

#include "tests/support/run/scenes.hpp"

using namespace freshet;
using test::Flow;

namespace {

// The largest difference of depths [m] after some steps of dt.
double largest_difference(Scene scene, double dt, int steps) {
  scene.method = "sisph";
  scene.sph.eta = scene.sisph.smoothing;
  Flow stored(scene);
  scene.sisph.recomputed = true;
  Flow found(scene);
  for (int k = 0; k < steps; ++k) stored.step(dt), found.step(dt);
  const auto a = stored.real("depth"), b = found.real("depth");
  double most = 0;
  for (int i = 0; i < stored.size(); ++i) most = std::max(most, std::abs(a(i) - b(i)));
  CHECK(found.method->report().iterations == stored.method->report().iterations);
  const Totals totals = found.method->totals();
  CHECK(std::abs(totals.mass - stored.method->totals().mass) <= 1e-13 * totals.mass);
  return most;
}

}  // namespace

TEST_CASE("sisph recomputed: a hump between walls on disordered particles") {
  Scene scene = test::bare_scene(2, {0, 0}, {2, 2}, 0.05);
  test::close_box(scene);
  scene.water.disorder = 0.2;
  scene.water.depth = [](double x, double y) {
    return 1 + 0.2 * std::exp(-20 * ((x - 0.8) * (x - 0.8) + (y - 1) * (y - 1)));
  };
  CHECK(largest_difference(scene, 0.05, 20) <= 1e-11);
}

TEST_CASE("sisph recomputed: water that runs over dry islands with friction") {
  Scene scene = test::bare_scene(2, {0, 0}, {2, 2}, 0.05);
  test::close_box(scene);
  scene.manning = Manning(0.02);
  scene.bed.elevation = [](double x, double y) { return 0.3 * std::sin(5 * x) * std::sin(4 * y) - 0.1; };
  scene.water.surface = [](double x, double) { return x < 0.7 ? 0.15 : 0.0; };
  CHECK(largest_difference(scene, 0.01, 20) <= 1e-9);
}

TEST_CASE("sisph recomputed: a wave through a channel with open ends, in 1-D") {
  Scene scene = test::bare_scene(1, {0, 0}, {20, 0}, 0.1);
  scene.water.depth = [](double, double) { return 1.0; };
  test::open_both(scene, IncomingWave{}, Transmissive{});
  test::impose(scene.boundaries[0], "level", {{0, 1, 2, 3, 1e9}, {1, 1, 1.05, 1, 1}});
  test::impose(scene.boundaries[1], "level", {{0, 1e9}, {1, 1}});
  CHECK(largest_difference(scene, 0.03, 200) <= 1e-11);
}
