// Gauge statistics against series whose figures can be found by hand.
#include <catch2/catch.hpp>

#include <cmath>

#include "src/run/record/gauge_stats.hpp"

using namespace freshet;

namespace {

std::vector<GaugeRow> rows_of(const Series& series) {
  std::vector<GaugeRow> rows;
  for (std::size_t k = 0; k < series.t.size(); ++k) rows.push_back({series.t[k], {series.value[k]}, {false}});
  return rows;
}

// A triangle: 0 until t = 10, up to `height` at 12, down to 0 at 14, 0 until 20.
Series triangle(double height, double delay = 0) {
  return {{0, 10 + delay, 12 + delay, 14 + delay, 20}, {0, 0, height, 0, 0}};
}

}  // namespace

TEST_CASE("rmse and largest deviation over the measured times that lie in the run") {
  Gauge gauge;
  gauge.measured = Series{{-1, 0, 1, 2, 3, 99}, {7, 0, 1, 2, 3, 7}};  // the first and the last lie outside
  const auto result = compare_gauge(gauge, rows_of({{0, 4}, {1, 5}}), 0);  // measured + 1 everywhere
  // Interpolation of small whole numbers: rounding only.
  CHECK(result.rmse == Approx(1).epsilon(1e-14));
  CHECK(result.max_abs_error == Approx(1).epsilon(1e-14));

  gauge.measured = Series{{0, 4}, {1, 2}};  // deviations 0 and 3
  const auto uneven = compare_gauge(gauge, rows_of({{0, 4}, {1, 5}}), 0);
  CHECK(uneven.rmse == Approx(std::sqrt(4.5)).epsilon(1e-14));
  CHECK(uneven.max_abs_error == Approx(3).epsilon(1e-14));
}

TEST_CASE("peaks and arrivals are taken after peak_after, arrivals by linear interpolation") {
  Gauge gauge;
  gauge.peak_after = 5;
  gauge.arrival_level = 0.01;
  gauge.measured = triangle(0.04);
  Series computed = triangle(0.05, 0.5);
  computed.t.insert(computed.t.begin() + 1, {2, 3});  // an earlier and higher bump that must not count
  computed.value.insert(computed.value.begin() + 1, {0.09, 0});
  const auto result = compare_gauge(gauge, rows_of(computed), 0);
  CHECK(result.peak == 0.05);
  CHECK(result.peak_time == 12.5);
  CHECK(result.measured_peak == 0.04);
  CHECK(result.measured_peak_time == 12.0);
  // On a rise of 2 s: a fifth of it to 0.01 of 0.05, a quarter to 0.01 of 0.04. Rounding only.
  CHECK(result.arrival == Approx(10.5 + 0.4).epsilon(1e-14));
  CHECK(result.measured_arrival == Approx(10.5).epsilon(1e-14));
}

TEST_CASE("the window of the main wave follows the measured rise") {
  Gauge gauge;
  gauge.peak_after = 5;
  gauge.measured = triangle(0.04);  // arrival 10.5, peak 12: rise 1.5 s
  const auto result = compare_gauge(gauge, rows_of({{0, 20}, {0, 0}}), 0);
  CHECK(result.window.first == Approx(10.5 - 0.75).epsilon(1e-14));
  CHECK(result.window.second == Approx(13.5).epsilon(1e-14));
  // The measured times inside are 10 and 12: deviations 0 and 0.04.
  CHECK(result.rmse_window == Approx(0.04 / std::sqrt(2.0)).epsilon(1e-14));
  CHECK(result.rmse == Approx(0.04 / std::sqrt(5.0)).epsilon(1e-14));
}

TEST_CASE("figures that do not exist are unknown, not zero") {
  Gauge gauge;
  const auto calm = compare_gauge(gauge, rows_of({{0, 1}, {0, 0}}), 0);
  CHECK(std::isnan(calm.arrival));
  CHECK(std::isnan(calm.rmse));
  CHECK(std::isnan(calm.measured_peak));
  CHECK(calm.peak == 0);
  gauge.measured = Series{{5, 6}, {1, 1}};  // after the run's end
  CHECK(std::isnan(compare_gauge(gauge, rows_of({{0, 1}, {0, 0}}), 0).rmse));
  CHECK(std::isnan(compare_gauge(gauge, {}, 0).peak));
}

TEST_CASE("a level that is reached from the start has not arrived") {
  CHECK(std::isnan(arrival_after({{0, 1, 2}, {0.5, 0.6, 0.7}}, 0.01, 0, 2)));
  CHECK(arrival_after({{0, 1, 2, 3}, {0.5, 0, 0, 0.02}}, 0.01, 0, 3) == Approx(2.5));
}
