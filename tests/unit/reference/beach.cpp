// The exact wave on a plane beach: against the equations, and against the published solution of benchmark 1
// (ISEC 2004).
#include "src/reference/beach.hpp"

#include <catch2/catch.hpp>

#include <cmath>

#include "tests/support/run/data.hpp"

using namespace freshet;

namespace {

constexpr double g = 9.81;
const Beach benchmark{0.1, 5000, {{0.006, 0.4444, 4.1209}, {-0.018, 4.0, 1.6384}}};

}  // namespace

TEST_CASE("beach wave: it satisfies the shallow-water equations where it runs up and draws back") {
  const auto wave = beach_wave(benchmark, g);
  for (const double x : {300.0, 900.0, 5000.0}) {
    const double t = 150, s = 0.01 * x, tau = 0.05;
    const FlowState here = wave->at(x, 0, t), west = wave->at(x - s, 0, t), east = wave->at(x + s, 0, t);
    const FlowState before = wave->at(x, 0, t - tau), after = wave->at(x, 0, t + tau);
    const double d_t = (after.depth - before.depth) / (2 * tau),
                 flux_x = (east.depth * east.u - west.depth * west.u) / (2 * s);
    const double u_t = (after.u - before.u) / (2 * tau), advection = here.u * (east.u - west.u) / (2 * s);
    const double pressure = g * ((east.depth - west.depth) / (2 * s) - 0.1);
    CAPTURE(x);
    // Truncation of the central differences: the square of 1 % of the distance to the shore, times a few.
    CHECK(std::abs(d_t + flux_x) <= 3e-3 * std::abs(d_t));
    CHECK(std::abs(u_t + advection + pressure) <= 3e-3 * std::max(std::abs(u_t), std::abs(pressure)));
  }
}

TEST_CASE("beach wave: at rest at first, a level sea far out") {
  const auto wave = beach_wave(benchmark, g);
  for (const double x : {100.0, 5000.0, 15000.0}) CHECK(std::abs(wave->at(x, 0, 0).u) <= 1e-12);
  CHECK(wave->at(-100, 0, 0).depth == 0);
  CHECK(wave->at(1e5, 0, 0).depth == Approx(1e4));
  CHECK(wave->period() == 0);
}

TEST_CASE("beach wave: the published profiles") {
  const auto wave = beach_wave(benchmark, g);
  const auto start = test::data_file("landslide_tsunami_bp1/initial_condition.txt");
  if (!start) return;
  const auto rows = test::number_rows(*start);
  REQUIRE(rows.size() > 900);
  for (const auto& row : rows)
    if (row[0] > 0)
      CHECK(wave->at(row[0], 0, 0).depth - 0.1 * row[0] == Approx(row[1]).margin(1e-3));  // of waves of 9 m
  for (const int t : {160, 175, 220}) {
    const auto file = test::data_file("landslide_tsunami_bp1/t" + std::to_string(t) + ".csv");
    if (!file) return;
    double level = 0, velocity = 0;
    const auto profile = test::number_rows(*file);
    REQUIRE(profile.size() > 90);
    for (const auto& row : profile) {
      const FlowState state = wave->at(row[0], 0, t);
      level += std::abs(state.depth - 0.1 * row[0] - row[1]);
      velocity += std::abs(state.u - row[2]);
    }
    // Given to 0.5 cm at places rounded to 1 m; the level falls by 6 % a metre at the tips: a tenth of a
    // metre on average.
    CHECK(level / static_cast<double>(profile.size()) <= 0.1);
    CHECK(velocity / static_cast<double>(profile.size()) <= 0.1);
  }
}

TEST_CASE("beach wave: the published shoreline") {
  const auto file = test::data_file("landslide_tsunami_bp1/Shoreline.csv");
  if (!file) return;
  double farthest = 0;
  int compared = 0;
  const auto rows = test::number_rows(*file);
  for (std::size_t k = 0; k < rows.size(); k += 10) {
    const Shore shore = beach_shore(benchmark, g, rows[k][0]);
    farthest = std::max(farthest, std::abs(shore.x - rows[k][1]));
    ++compared;
  }
  CHECK(compared > 40);
  CHECK(farthest <= 5);  // m, 2 % of the 250 m that the sea draws back
}
