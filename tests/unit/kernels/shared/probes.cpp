// What a gauge reads at the edge of the water.
#include <catch2/catch.hpp>

#include "tests/support/points/cloud.hpp"
#include "tests/support/run/scenes.hpp"

using namespace freshet;

namespace {

// Water 1 m deep on the left half of a closed box of 2 m x 1 m, spacing 0.05 m, h = 0.06 m.
std::vector<double> depths(const std::vector<Point>& points) {
  Scene scene = test::bare_scene(2, {0, 0}, {2, 1}, 0.05);
  test::close_box(scene);
  scene.water.depth = [](double x, double) { return x < 1 ? 1.0 : 0.0; };
  std::vector<double> depths;
  for (const PointState& state : make_method(scene)->sample(points)) depths.push_back(state.depth);
  return depths;
}

// The part of the kernel that reaches across a straight edge at a distance of a.
double across(double a, double h) {
  constexpr int cells = 400;
  double sum = 0;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      const double x = a + (2 * h - a) * (i + 0.5) / cells, y = 2 * h * (j + 0.5) / cells;
      sum += 2 * test::printed_w(2, std::hypot(x, y) / h) / (h * h);
    }
  return sum * (2 * h - a) * 2 * h / (cells * cells);
}

}  // namespace

TEST_CASE("a gauge reads the water's depth within it and at its walls, and little of it beyond a front") {
  const auto d = depths({{0.5, 0.5}, {0.5, 0}, {0, 0}, {0.98, 0.5}, {1.06, 0.5}, {1.08, 0.5}, {1.2, 0.5}});
  // The density at t = 0 is the summed one: within 1 % of the lattice's depth, half of it on the edge of the
  // water.
  for (const int inside : {0, 1, 2}) CHECK(d[inside] == Approx(1).epsilon(0.01));
  CHECK(d[3] > 0.5);
  // One h beyond the edge the mean over the particles would still be above 0.5 m: what counts is the plain
  // sum over a quarter. The particles on the edge lack neighbours: their density is between 0.6 and 1, their
  // h up to 1.3 times the others'.
  CHECK(d[4] >= 4 * across(0.06, 0.06));
  CHECK(d[4] <= 4 * across(0.06, 1.3 * 0.06));
  CHECK(d[5] < d[4]);
  CHECK(d[6] == 0);
}
