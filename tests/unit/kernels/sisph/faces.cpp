// The depth between two particles: continuous where one falls dry.
#include <catch2/catch.hpp>

#include <random>

#include "kernels/sisph/surface/surface.hpp"

using freshet::sisph::face_depth;

TEST_CASE("sisph face depth: a film that rounding leaves counts as dry land") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> bed(-1, 1), deep(0.1, 2);
  for (int n = 0; n < 1000; ++n) {
    const double bi = bed(random), bj = bed(random), h = deep(random);
    const double dry = face_depth<true>(h, 0.0, bi, bj);
    REQUIRE(dry == Approx(std::max(0.0, std::max(bi + h, bj) - std::max(bi, bj))).margin(1e-14));
    // The film's part of the depth between rises with slope 1 / (2 x 0.2) at most where the deep one has its
    // mean, and a little more on slopes.
    for (const double film : {1e-300, 1e-20, 1e-12})
      REQUIRE(std::abs(face_depth<true>(h, film, bi, bj) - dry) <= 1e-14 + 20 * film / h);
    REQUIRE(face_depth<true>(h, 0.3 * h, bi, bj) == Approx(0.65 * h).margin(1e-14));  // wet alike: the mean
    REQUIRE(face_depth<true>(0.0, h, bj, bi) == Approx(dry).margin(1e-14));  // the same seen from the other
    REQUIRE(face_depth<true>(0.0, 0.0, bi, bj) == 0);
  }
}
