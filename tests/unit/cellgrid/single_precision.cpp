// Pairs summed in single precision against the same pairs summed in double.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "tests/support/points/cloud.hpp"

using namespace freshet;
using test::Cloud;
using test::Grain;

namespace {

constexpr double dx = 0.1;  // m

std::vector<swe::AnyStabilisation> stabilisations() {
  return {swe::NoStabilisation{},  swe::ArtificialViscosity{0.8, 2},
          swe::LaxFriedrichs{0.8}, swe::LaxFriedrichsMuscl{0.8},
          swe::TwoShock{9.81},     swe::TwoShockMuscl{9.81}};
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
  return worst;
}

template <int D>
std::vector<const char*> components(const char* x, const char* y) {
  return D == 1 ? std::vector<const char*>{x} : std::vector<const char*>{x, y};
}

// Density first, then the force from a density that both share.
template <int D>
void check_against_double(std::vector<Grain> grains, const swe::AnyStabilisation& stabilise, double at) {
  for (Grain& g : grains) g.x[0] += at;
  Cloud<D> exact(grains, dx);
  exact.settle(test::tight(D));
  exact.force(stabilise);
  Cloud<D> single(grains, dx);
  single.settle(test::tight(D));
  single.use_single();
  single.force(stabilise);
  for (const char* name : components<D>("tx", "ty")) {
    const auto expected = exact.by_id(name);
    // Rounding of some 60 pairs' factors, each to 6e-8 of forces of both signs up to ten times their sum.
    CHECK(largest_difference(expected, single.by_id(name)) < 5e-6 * test::largest_size(expected));
  }
  const auto expected = exact.by_id("signal");
  CHECK(largest_difference(expected, single.by_id("signal")) < 2e-6 * test::largest_size(expected));
}

template <int D>
void check_density(std::vector<Grain> grains, double at) {
  for (Grain& g : grains) g.x[0] += at;
  Cloud<D> exact(grains, dx), single(grains, dx);
  exact.settle(test::tight(D));
  single.use_single();
  auto options = test::tight(D);
  options.tolerance = 1e-6;
  single.settle(options);
  for (const char* name : {"depth", "h", "pressure", "depth_rate", "strain_xx"}) {
    CAPTURE(name);
    const auto expected = exact.by_id(name);
    // Newton ends at a residual of 1e-6; the rate and the strain divide by sums as large as they are.
    CHECK(largest_difference(expected, single.by_id(name)) < 2e-5 * test::largest_size(expected));
  }
}

}  // namespace

TEST_CASE("single precision: forces as in double, each stabilisation, near the origin and 5000 km from it") {
  for (const swe::AnyStabilisation& stabilise : stabilisations())
    for (const double at : {0.0, 5e6}) {
      CAPTURE(stabilise.index(), at);
      check_against_double<1>(test::random_water(1, 251, dx, 7), stabilise, at);
      check_against_double<2>(test::random_water(2, 500, dx, 7), stabilise, at);
    }
}

TEST_CASE("single precision: densities, rates and strain as in double") {
  for (const double at : {0.0, 5e6}) {
    check_density<1>(test::random_water(1, 251, dx, 8), at);
    check_density<2>(test::random_water(2, 500, dx, 8), at);
  }
}

TEST_CASE("single precision: a particle alone and two in one place feel no force") {
  std::vector<Grain> grains = test::random_water(2, 3, dx, 9);
  grains[1].x = grains[0].x, grains[1].v = grains[0].v;
  grains[2].x = {1e3, 1e3};
  Cloud<2> cloud(grains, dx);
  cloud.use_single();
  auto options = test::tight(2);
  options.tolerance = 1e-6;
  cloud.settle(options);
  cloud.force(swe::LaxFriedrichsMuscl{1});
  for (const double t : cloud.by_id("tx")) CHECK(t == 0);
  for (const double rho : cloud.by_id("depth")) CHECK((std::isfinite(rho) && rho > 0));
}
