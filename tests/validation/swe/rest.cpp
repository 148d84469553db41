// Still water over the beds of the thesis' first chapter (Vacondio 2010, section 1.6): what moves is error.
#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

#include "tests/support/run/run_case.hpp"

using namespace freshet;

namespace {

struct Basin {
  const char* name;
  double speed;  // bound of max |v| / sqrt(g d_max) over all times
  double order;  // least order of the L2 of the depth
  double scale;  // m, the coarsest spacing; three halvings follow
};

// The slope of the least-squares line through log2 of values at spacings that halve.
double fitted_order(const std::vector<double>& errors) {
  double sum = 0, weights = 0;
  const double middle = 0.5 * (static_cast<double>(errors.size()) - 1);
  for (std::size_t k = 0; k < errors.size(); ++k) {
    sum -= (static_cast<double>(k) - middle) * std::log2(errors[k]);
    weights += std::pow(static_cast<double>(k) - middle, 2);
  }
  return sum / weights;
}

// The four spacings of the thesis: still at all times, steady at the end; returns the errors of the depth.
std::vector<double> still_at_four_spacings(const Basin& basin, bool fine_bed = false) {
  std::vector<double> errors;
  for (double dx = basin.scale; dx > basin.scale / 10; dx /= 2) {
    std::vector<std::string> overrides{"water.spacing=" + std::to_string(dx)};
    if (fine_bed) overrides.push_back("bed.spacing=" + std::to_string(dx / 4));
    const test::Results s = test::run_case(basin.name, overrides);
    CAPTURE(basin.name, dx, s.steady.thesis_ls, s.errors.depth_l2_rel);
    CHECK(s.steady.max_speed_rel < basin.speed);
    CHECK(s.steady.rate < 1e-4);  // 1/s
    CHECK(s.mass.relative_error <= 1e-12);
    errors.push_back(s.errors.depth_l2_rel);
  }
  return errors;
}

void check_basin(const Basin& basin) {
  const auto errors = still_at_four_spacings(basin);
  const double order = fitted_order(errors);
  CAPTURE(basin.name, order);
  CHECK(order >= basin.order);
}

}  // namespace

TEST_CASE("a lake over a hump stays at rest", "[slow]") {
  // The lattice is no equilibrium of the summed densities: particles move until it is. Printed: < 0.01, order
  // about 1.
  check_basin({"lake_at_rest", 0.005, 0.9, 0.04});
}

TEST_CASE("water around an island stays at rest", "[long]") {
  // Printed: no speed, "convergent". The shore lies within one cell: of first order, fitted to four spacings
  // as 0.94.
  check_basin({"rest_island", 0.01, 0.8, 0.04});
}

TEST_CASE("water in a parabola stays at rest up to its shores", "[long]") {
  // Printed: < 0.02 at the finest spacing, order below 1. First order is the least that is claimed here;
  // fitted 1.45.
  check_basin({"rest_parabola", 0.02, 1.0, 80});
}

TEST_CASE("water in a parabola between walls stays at rest", "[long]") {
  check_basin({"rest_parabola_walls", 0.006, 0.9, 80});  // printed: < 0.006
}

TEST_CASE("the well-balanced bed keeps water over a step at rest to round-off", "[long]") {
  // Printed, without balancing: < 0.02. 1e-10 is a million roundings; bottom particles four times as dense,
  // as in the thesis.
  const auto errors = still_at_four_spacings({"rest_step", 0.02, 0, 0.04}, true);
  for (const double error : errors) CHECK(error <= 1e-10);
}

TEST_CASE("water in a paraboloid comes to rest up to its shore") {
  const test::Results s = test::run_case("rest_bowl");
  CHECK(s.initial_particles == 448);  // the thesis' number
  CAPTURE(s.steady.max_speed_rel, s.steady.rate, s.steady.thesis_ls, s.errors.depth_l2_rel);
  CHECK(s.steady.end_speed_rel < 0.015);  // printed: < 1.5 % at 1000 s
}
