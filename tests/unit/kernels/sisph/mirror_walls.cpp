// Walls of mirror images against a cloud in which the images are real particles.
#include "kernels/boundaries/walls/walls.hpp"

#include <catch2/catch.hpp>

#include "tests/support/points/cloud.hpp"

using namespace freshet;
using test::Cloud;
using test::Grain;

namespace {

constexpr double dx = 0.1;       // m
constexpr double far = 60 * dx;  // m, where walls end

// The water lies on the left: above the x axis, in the first quadrant.
const std::vector<Polyline> straight{{{-far, 0}, {far, 0}}}, corner{{{0, far}, {0, 0}, {far, 0}}};

Grain mirrored(Grain grain, size_t axis) {
  grain.x[axis] *= -1;
  grain.v[axis] *= -1;
  return grain;
}

// The grains followed by their images in y = 0 and, for the corner, x = 0 and both.
std::vector<Grain> with_images(const std::vector<Grain>& grains, bool both) {
  std::vector<Grain> all = grains;
  for (const Grain& grain : grains) all.push_back(mirrored(grain, 1));
  if (!both) return all;
  const auto half = all;
  for (const Grain& grain : half) all.push_back(mirrored(grain, 0));
  return all;
}

// Random water with y > 0, for the corner x > 0 too; some very near the walls.
std::vector<Grain> water(bool both) {
  auto grains = test::random_water(2, 300, dx, both ? 21 : 22);
  for (Grain& grain : grains) {
    grain.x[1] = std::abs(grain.x[1]);
    if (both) grain.x[0] = std::abs(grain.x[0]);
    grain.rho0 *= both ? 4 : 2;  // folded together they are as dense: h stays within its bounds for most
  }
  return grains;
}

template <int D>
double worst_difference(const Cloud<D>& a, const Cloud<D>& b, const char* name, size_t count) {
  const auto left = a.by_id(name), right = b.by_id(name);
  double worst = 0;
  for (size_t i = 0; i < count; ++i) worst = std::max(worst, std::abs(left[i] - right[i]));
  return worst / test::largest_size(left);
}

template <int D>
void check_images(const std::vector<Grain>& grains, const std::vector<Grain>& all,
                  const std::vector<Polyline>& walls, const swe::AnyStabilisation& stabilise, double margin) {
  auto options = test::tight(D);
  options.margin = margin;
  Cloud<D> walled(grains, dx), whole(all, dx);
  walled.add_walls(walls, {1, 1}, WallKind::images);
  for (Cloud<D>* cloud : {&walled, &whole}) {
    cloud->settle(options);
    cloud->force(stabilise);
  }
  // The same sums in another order: 1/r to 1e-12 and the Newton to 1e-13.
  for (const char* name : {"depth", "h", "pressure", "depth_rate", "tx", "signal"}) {
    CAPTURE(name);
    CHECK(worst_difference(walled, whole, name, grains.size()) < 1e-9);
  }
  if (D == 2) CHECK(worst_difference(walled, whole, "ty", grains.size()) < 1e-9);
}

}  // namespace

TEST_CASE("mirror walls: images are the particles that they stand for") {
  const bool both = GENERATE(false, true);
  // With lists no longer than a step's: neighbours of a larger h have images that are felt from beyond the
  // particle's own support.
  const double margin = GENERATE(4.0, 0.05);
  CAPTURE(both, margin);
  const auto grains = water(both);
  for (const swe::AnyStabilisation& stabilise :
       {swe::AnyStabilisation(swe::NoStabilisation{}), swe::AnyStabilisation(swe::LaxFriedrichs{1})})
    check_images<2>(grains, with_images(grains, both), both ? corner : straight, stabilise, margin);
}

TEST_CASE("mirror walls: images at the end of a line") {
  auto grains = test::random_water(1, 80, dx, 23);
  for (Grain& grain : grains) grain.x[0] = std::abs(grain.x[0]);
  auto all = grains;
  for (const Grain& grain : grains) all.push_back(mirrored(grain, 0));
  for (const double margin : {4.0, 0.05})
    check_images<1>(grains, all, {{{0, 0}}}, swe::LaxFriedrichs{1}, margin);
}

TEST_CASE("mirror walls: a still lattice in a box feels nothing anywhere") {
  const Polyline box{{0, 0}, {2, 0}, {2, 1.5}, {0, 1.5}, {0, 0}};
  const auto grains = test::still_water(2, test::lattice(2, {0, 20, 0, 15}, dx), dx, 0.7, 1.2);
  Cloud<2> cloud(grains, dx);
  cloud.add_walls({box}, {1, 1}, WallKind::images);
  cloud.settle(test::tight(2));
  cloud.force(swe::LaxFriedrichsMuscl{1});
  const auto depth = cloud.by_id("depth");
  const auto [least, most] = std::minmax_element(depth.begin(), depth.end());
  CHECK(*most - *least < 1e-11);
  // Table 1.1: 2.43e-4 at fixed h; with h following the density the bias is a trifle less.
  CHECK(std::abs(depth[0] / 0.7 - 1) == Approx(2.4e-4).margin(0.1e-4));
  CHECK(test::largest_size(cloud.by_id("tx")) < 1e-9);  // of g depth / dx = 70 m/s2
  CHECK(test::largest_size(cloud.by_id("ty")) < 1e-9);
}

TEST_CASE("mirror walls: the force keeps the momentum along a wall and pushes away from it") {
  const auto grains = water(false);
  Cloud<2> cloud(grains, dx);
  cloud.add_walls(straight, {0, 1}, WallKind::images);
  cloud.settle(test::tight(2));
  cloud.force(swe::LaxFriedrichs{1});
  const auto m = cloud.by_id("mass"), tx = cloud.by_id("tx"), ty = cloud.by_id("ty");
  double along = 0, across = 0, size = 0;
  for (size_t i = 0; i < m.size(); ++i)
    along += m[i] * tx[i], across -= m[i] * ty[i], size += std::abs(m[i] * tx[i]);
  CHECK(std::abs(along) < 1e-12 * size);
  CHECK(across > 0.1 * size);
}

TEST_CASE("mirror walls: exact for right corners with the water inside, and for nothing else") {
  const Polyline box{{0, 0}, {2, 0}, {2, 1.5}, {0, 1.5}, {0, 0}};
  CHECK(only_right_corners({box}));
  CHECK(only_right_corners({{{0, 0}, {2, 0}}}));
  CHECK(only_right_corners({{{0, 0}, {2, 0}, {2, 1}}, {{5, 5}, {4, 4}}}));
  CHECK_FALSE(only_right_corners({{{0, 0}, {2, 0}, {2, -1}}}));       // re-entrant
  CHECK_FALSE(only_right_corners({{{0, 0}, {2, 0}, {3, 1}}}));        // 135 degrees
  CHECK_FALSE(only_right_corners({{{0, 0}, {2, 0}, {4, 0}}}));        // none: straight on
  CHECK_FALSE(only_right_corners({box, {{0, 0}, {1, 0}, {1, -1}}}));  // one of two lines
  CHECK_FALSE(only_right_corners({{{0, 0}, {2, 0}, {2, 1.5}, {1, 2.5}, {0, 1.5}, {0, 0}}}));  // a gable
}
