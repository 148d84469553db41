// How steep a bed is, and which acceleration a scene takes by it.
#include <catch2/catch.hpp>

#include <cmath>

#include "src/scene/shapes/slope.hpp"

using namespace freshet;

namespace {

Scene over(Function bed, int dimension = 2) {
  Scene scene;
  scene.domain = {dimension, {0, 0}, {10, dimension == 2 ? 7.0 : 0.0}};
  scene.water.spacing = 0.1;
  scene.bed.elevation = std::move(bed);
  return scene;
}

}  // namespace

TEST_CASE("the slope of a plane is exact, along any direction") {
  CHECK(steepest_slope(over([](double x, double y) { return 0.3 * x - 0.4 * y; })) == Approx(0.5));
  CHECK(steepest_slope(over([](double x, double) { return 100 - 0.3 * x; }, 1)) == Approx(0.3));
  CHECK(steepest_slope(over({})) == 0);
}

TEST_CASE("a step is as steep as the lattice or the filter makes it") {
  Scene scene = over([](double x, double) { return x < 5.03 ? 0.0 : 0.33; });
  CHECK(steepest_slope(scene) == Approx(0.33 / 0.2));
  scene.bed.filter = 0.4;
  // After a Gaussian of that width: 0.33 / (0.4 sqrt(2 pi)); the window's 2.5 stands for sqrt(2 pi) = 2.507.
  CHECK(steepest_slope(scene) == Approx(0.33 / (0.4 * std::sqrt(2 * pi))).epsilon(0.003));
}
