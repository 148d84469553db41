// The synthetic flood plain of cases/breach: what its description promises.
#include "src/scene/shapes/floodplain.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "tests/support/run/scene_files.hpp"

using namespace freshet;
using input::Floodplain;
using input::floodplain;

namespace {

// Unevenness of at most 0.4 + 0.2 + 0.05 m about 2 m, and low areas of at most 2 m.
constexpr double lowest = 2 - 0.65 - 2, plain_top = 2 + 0.65;

}  // namespace

TEST_CASE("floodplain: depends on the seed alone") {
  const Function a = floodplain({{0, 0}, {9000, 4000}, 7}), b = floodplain({{0, 0}, {9000, 4000}, 7}),
                 c = floodplain({{0, 0}, {9000, 4000}, 8});
  int differ = 0, equal = 0;
  for (double x = 450; x < 9000; x += 777)
    for (double y = 450; y < 3600; y += 333) differ += a(x, y) != b(x, y), equal += a(x, y) == c(x, y);
  CHECK(differ == 0);
  CHECK(equal == 0);
}

TEST_CASE("floodplain: high all round but for the breach, a plain within") {
  const Function z = floodplain({{0, 0}, {9000, 4000}, 7});
  double rim = 1e9, breach = -1e9, high = -1e9, low = 1e9;
  for (double s = 0; s <= 1; s += 0.01) {
    rim = std::min({rim, z(9000 * s, 0), z(0, 4000 * s), z(9000, 4000 * s)});
    if (std::abs(s - 0.5) > 400.0 / 9000) rim = std::min(rim, z(9000 * s, 4000));
    breach = std::max(breach, z(4425 + 150 * s, 4000));
  }
  for (double x = 400; x <= 8600; x += 50)
    for (double y = 400; y <= 3600; y += 50) high = std::max(high, z(x, y)), low = std::min(low, z(x, y));
  CHECK(rim >= 8 + lowest);
  CHECK(breach <= plain_top);
  CHECK(high <= plain_top + 2.5);  // the embankment
  CHECK(low >= lowest);
  CHECK(low < 1);  // there are low areas
}

TEST_CASE("floodplain: the embankment stands 2.5 m above the ground beside it, but for its underpass") {
  const Function z = floodplain({{0, 0}, {9000, 4000}, 7});
  const double ax = 0.08 * 9000, ay = 0.12 * 4000, bx = 0.52 * 9000, by = 0.55 * 4000,
               length = std::hypot(bx - ax, by - ay);
  const double nx = -(by - ay) / length, ny = (bx - ax) / length;
  int gaps = 0, blocked = 0;
  for (double s = 0.1; s < 0.95; s += 0.005) {
    const double x = ax + s * (bx - ax), y = ay + s * (by - ay);
    const double above = z(x, y) - 0.5 * (z(x + 80 * nx, y + 80 * ny) + z(x - 80 * nx, y - 80 * ny));
    if (std::abs(s - 0.6) * length < 25)
      blocked += above > 1;  // the ground itself is uneven by up to 1 m over 160 m
    if (std::abs(s - 0.6) * length > 75) gaps += above < 1.5;
  }
  CHECK(blocked == 0);
  CHECK(gaps == 0);
}

TEST_CASE("floodplain: has its keys, and needs two dimensions") {
  const Scene scene = test::read_text(
      test::pond("[bed]\nshape = { type = \"floodplain\", seed = 3, box = [0, 0, 10, 5] }\n"));
  CHECK(scene.bed.elevation(5, 2.5) == floodplain({{0, 0}, {10, 5}, 3})(5, 2.5));
  CHECK_THAT(test::failure(test::pond("[bed]\nshape = { type = \"floodplain\", box = [0, 0, 10] }\n")).text,
             Catch::Contains("a flood plain has a box [x0, y0, x1, y1]"));
}
