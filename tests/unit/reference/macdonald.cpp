// MacDonald's channel: the bed against its differential equation and against the published table.
#include "src/reference/macdonald.hpp"

#include <catch2/catch.hpp>

#include <cmath>

#include "tests/support/run/data.hpp"

using namespace freshet;

namespace {

constexpr double g = 9.81, manning = 0.033, length = 1000;  // m/s2, s/m^(1/3), m
const double critical = std::cbrt(4 / g);                   // m

double depth(double x, double) { return critical * (1 + 0.5 * std::exp(-16 * std::pow(x / 1000 - 0.5, 2))); }
double depth_slope(double x) { return -0.032 * (x / 1000 - 0.5) * (depth(x, 0) - critical); }

double friction_slope(double x) { return std::pow(manning * 2, 2) / std::pow(depth(x, 0), 10.0 / 3); }

// dz/dx of the differential equation.
double bed_slope(double x) {
  return (4 / (g * std::pow(depth(x, 0), 3)) - 1) * depth_slope(x) - friction_slope(x);
}

}  // namespace

TEST_CASE("macdonald: the bed satisfies the differential equation and ends at zero") {
  const auto bed = macdonald_bed({depth, 2}, manning, length, g);
  CHECK(bed(length, 0) == Approx(0).margin(1e-12));
  // Central differences over 2 m: 1/6 of the curvature of the slope, 0.0085/(177 m)^2.
  for (double x = 2; x < 999; x += 13.7)
    CHECK((bed(x + 1, 0) - bed(x - 1, 0)) / 2 == Approx(bed_slope(x)).margin(5e-7));
  // Outside, friction stays what it is at the end.
  const double frozen = friction_slope(-10) - friction_slope(0);
  CHECK((bed(-9, 0) - bed(-11, 0)) / 2 == Approx(bed_slope(-10) + frozen).margin(5e-7));
}

TEST_CASE("macdonald: depth and discharge are those prescribed") {
  const auto exact = macdonald({depth, 2});
  for (const double x : {0.0, 321.0, 1000.0}) {
    CHECK(exact->at(x, 3, 7).depth == depth(x, 0));
    CHECK(exact->at(x, 3, 7).depth * exact->at(x, 3, 7).u == Approx(2));
  }
}

TEST_CASE("macdonald: the published depths and slopes of the bed") {
  const auto file = test::data_file("macdonald_swashes/McDonald_long_channel_wo_rain/mcdo_norain.csv");
  if (!file) return;
  const auto rows = test::number_rows(*file);  // x, bed, surface
  REQUIRE(rows.size() == 200);
  const double rounding = 1e-5 * (1 + 1e-3);  // m, of the difference of two numbers of five digits
  for (const auto& row : rows) CHECK(row[2] - row[1] == Approx(depth(row[0], 0)).margin(rounding));
  // The table's bed is a sum: each cell of 5 m falls by the slope at its lower end.
  for (std::size_t k = 0; k + 1 < rows.size(); ++k)
    CHECK((rows[k + 1][1] - rows[k][1]) / 5 == Approx(bed_slope(rows[k + 1][0])).margin(rounding / 5));
}
