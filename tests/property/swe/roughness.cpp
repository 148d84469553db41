// Friction takes Manning's n of the place: by region, wherever particles go.
#include <catch2/catch.hpp>

#include "tests/support/run/scenes.hpp"

using namespace freshet;
using test::Flow;

namespace {

// Water 0.2 m deep that flows at 1 m/s over two kinds of ground; the border is at x = 0.5 m.
Scene two_grounds(int dimension) {
  Scene scene = test::bare_scene(dimension, {0, 0}, {1, dimension == 2 ? 0.5 : 0}, 0.05);
  scene.water.depth = [](double, double) { return 0.2; };
  scene.water.velocity[0] = [](double, double) { return 1.0; };
  if (dimension == 2) scene.water.velocity[1] = [](double, double) { return 0.0; };
  scene.manning.emplace();
  scene.manning->map = [](double x, double) { return x < 0.5 ? 0.01 : 0.05; };
  scene.manning->node = {0.025, 0};
  scene.manning->step = {0.05, 0.05};
  return scene;
}

}  // namespace

TEST_CASE("roughness: every particle feels the n of its place, also after it has moved on") {
  const int dimension = GENERATE(1, 2);
  Flow flow(two_grounds(dimension));
  const auto worst = [&] {
    double most = 0;
    for (int i = 0; i < flow.size(); ++i) {
      const double n = flow.real("x")(i) < 0.5 ? 0.01 : 0.05;
      // docs/formulas/swe.md (S27)
      const double drag = 9.81 * n * n / std::pow(flow.real("depth")(i), 4.0 / 3);
      most = std::max(most, std::abs(flow.real("drag")(i) / drag - 1));
    }
    return most;
  };
  CHECK(worst() < 1e-11);  // d^(-1/3) is good to 2e-13
  flow.many_steps(30);
  CHECK(flow.t > 0.1);  // two cells further
  CHECK(worst() < 1e-11);
}

TEST_CASE("roughness: a map of one value is that value") {
  Scene number = two_grounds(2), map = two_grounds(2);
  number.manning = 0.03;
  map.manning->map = [](double, double) { return 0.03; };
  Flow a(number), b(map);
  a.many_steps(30), b.many_steps(30);
  CHECK(a.t == Approx(b.t).epsilon(1e-14));
  for (const char* name : {"x", "y", "u", "v", "depth"}) {
    CAPTURE(name);
    CHECK(test::largest_difference(a.by_id(name), b.by_id(name)) <
          1e-13);  // n^2 g and g n^2 round differently
  }
}

TEST_CASE("roughness: each ground slows the water as it should") {
  Scene scene = two_grounds(1);
  scene.domain.high = {4, 0};
  scene.manning->map = [](double x, double) { return x < 2 ? 0.01 : 0.05; };
  Flow flow(scene);
  flow.run(0.2);
  // dv/dt = -K v^2 as long as neither the ends nor the border (0.97 m away; waves and kernels cover 0.4 m)
  // are felt.
  const auto u = flow.by_id("u");
  for (const int column : {20, 60}) {
    const double n = column < 40 ? 0.01 : 0.05, k = 9.81 * n * n / std::pow(0.2, 4.0 / 3);
    // Backward Euler over steps of 0.014 s is off by (K v0)^2 t dt/2 = 6e-5 of v0.
    CHECK(u[static_cast<std::size_t>(column)] == Approx(1 / (1 + k * 0.2)).margin(2e-4));
  }
}
