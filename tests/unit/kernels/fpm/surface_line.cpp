// The free surface as a line: its level and its front.
#include <catch2/catch.hpp>

#include "kernels/fpm/cells/surface_line.hpp"
#include "tests/support/points/fpm_points.hpp"

using namespace freshet;
using test::FlowPoints;

namespace {

constexpr double dx = 0.1;  // m
const fpm::VoronoiRule rule;

// Water below the level 1 + slope x for 0 <= x <= 2 in a tank, a lone point above it, a lone one to its
// right.
struct Tilted {
  FlowPoints set;
  explicit Tilted(double slope, bool drops = true)
      : set(points(slope, drops), dx, {{{0, 3}, {0, 0}, {4, 0}, {4, 3}}}) {
    set.flags();
  }
  static std::vector<Point> points(double slope, bool drops) {
    std::vector<Point> all;
    for (int i = 0; i <= 20; ++i)
      for (int j = 0; j <= 10; ++j) all.push_back({i * dx, j * dx * (1 + slope * i * dx)});
    if (drops) all.insert(all.end(), {{1.0, 2.5}, {3.5, 1.0}});
    return all;
  }
  double level(double x) {
    return fpm::highest_level(set.cloud(), set.fields.integer("surface"), set.size(), rule, x);
  }
  double front() { return fpm::farthest_x(set.cloud(), set.fields.integer("surface"), set.size(), rule); }
};

}  // namespace

TEST_CASE("fpm surface line: levels along a slanting surface, on points, between them and on the wall") {
  Tilted water(0.1);
  for (const double x : {0.0, 0.04, 0.1, 0.77, 1.0, 1.96})
    CHECK(water.level(x) == Approx(1 + 0.1 * x).epsilon(1e-12));
}

TEST_CASE("fpm surface line: beside the water there is none, and lone points do not count") {
  Tilted water(0), still(0, false);
  CHECK(water.level(2.5) == fpm::no_water);
  CHECK(water.level(1.0) == Approx(1));
  CHECK(water.front() == Approx(2));
  CHECK(still.front() == Approx(2));
}
