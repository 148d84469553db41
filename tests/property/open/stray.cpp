// One particle far away changes no bit of the others: rows, bins, clusters and lists are fixed in space, not
// by who is there.
#include <catch2/catch.hpp>

#include "tests/support/run/scenes.hpp"

using namespace freshet;
using namespace freshet::test;

namespace {

// A drop that spreads in a wide dry domain, and in one cell far from it a little water, the last in the order
// of ids.
Scene drop_and_stray(int dimension, bool stray) {
  Scene scene =
      bare_scene(dimension, {-2, dimension == 2 ? -2.0 : 0.0}, {9, dimension == 2 ? 9.0 : 0.0}, 0.05);
  // else the stray's h outgrows its list, and all lists are made again: one more Newton step
  scene.sph.h_floor = scene.sph.h_cap = 1;
  scene.water.wet_above = 0.05;
  scene.water.depth = [stray](double x, double y) {
    const double far = std::max(std::abs(x - 8.025), y != 0 ? std::abs(y - 8.025) : 0.0);
    return stray && far < 0.02 ? 0.06 : 0.5 - x * x - y * y;
  };
  return scene;
}

}  // namespace

TEST_CASE("stray: a particle far away changes no bit of the others") {
  const int dimension = GENERATE(1, 2);
  Flow alone(drop_and_stray(dimension, false)), accompanied(drop_and_stray(dimension, true));
  REQUIRE(accompanied.size() == alone.size() + 1);
  for (int n = 0; n < 40; ++n) {
    const double dt = alone.method->stable_dt();
    alone.step(dt), accompanied.step(dt);
  }
  CHECK(alone.largest_speed() > 0.5);  // it has spread
  for (const char* name : {"x", "u", "depth", "h", "ax"}) {
    std::vector<double> with = accompanied.by_id(name);
    with.pop_back();
    CHECK((with == alone.by_id(name)));
  }
}
