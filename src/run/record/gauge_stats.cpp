#include "src/run/record/gauge_stats.hpp"

#include <algorithm>
#include <cmath>

namespace freshet {
namespace {

struct Deviation {
  double rms = unknown, largest = unknown;  // m
};

Deviation deviation(const Series& measured, const Series& computed, double from, double until) {
  double sum = 0, largest = 0;
  int count = 0;
  for (std::size_t k = 0; k < measured.t.size(); ++k) {
    if (measured.t[k] < from || measured.t[k] > until) continue;
    const double difference = computed.at(measured.t[k]) - measured.value[k];
    sum += difference * difference;
    largest = std::max(largest, std::abs(difference));
    ++count;
  }
  if (count == 0) return {};
  return {std::sqrt(sum / count), largest};
}

void compare_with_measured(const Gauge& gauge, const Series& computed, GaugeResult& result) {
  const Series& measured = *gauge.measured;
  const double begin = computed.t.front(), end = computed.t.back();
  const Deviation all = deviation(measured, computed, begin, end);
  result.rmse = all.rms;
  result.max_abs_error = all.largest;
  const Peak peak = peak_after(measured, gauge.peak_after, end);
  result.measured_peak = peak.value;
  result.measured_peak_time = peak.t;
  result.measured_arrival = arrival_after(measured, gauge.arrival_level, gauge.peak_after, end);
  const double rise = peak.t - result.measured_arrival;
  if (!(gauge.peak_after > 0 && rise > 0)) return;
  result.window = {std::max(begin, result.measured_arrival - rise / 2), std::min(end, peak.t + rise)};
  result.rmse_window = deviation(measured, computed, result.window.first, result.window.second).rms;
}

}  // namespace

Series gauge_series(const std::vector<GaugeRow>& rows, std::size_t index) {
  Series series;
  for (const auto& row : rows) {
    series.t.push_back(row.t);
    series.value.push_back(row.value[index]);
  }
  return series;
}

Peak peak_after(const Series& series, double after, double until) {
  Peak peak;
  for (std::size_t k = 0; k < series.t.size(); ++k) {
    if (series.t[k] < after || series.t[k] > until) continue;
    if (!(series.value[k] <= peak.value)) peak = {series.value[k], series.t[k]};
  }
  return peak;
}

double arrival_after(const Series& series, double level, double after, double until) {
  for (std::size_t k = 1; k < series.t.size() && series.t[k] <= until; ++k) {
    const double below = series.value[k - 1], above = series.value[k];
    if (!(below < level && above >= level)) continue;
    const double t = series.t[k - 1] + (level - below) / (above - below) * (series.t[k] - series.t[k - 1]);
    if (t > after) return t;
  }
  return unknown;
}

GaugeResult compare_gauge(const Gauge& gauge, const std::vector<GaugeRow>& rows, std::size_t index) {
  GaugeResult result;
  result.name = gauge.name;
  if (rows.empty()) return result;
  const Series computed = gauge_series(rows, index);
  const double end = computed.t.back();
  const Peak peak = peak_after(computed, gauge.peak_after, end);
  result.peak = peak.value;
  result.peak_time = peak.t;
  result.arrival = arrival_after(computed, gauge.arrival_level, gauge.peak_after, end);
  const auto dry =
      std::count_if(rows.begin(), rows.end(), [&](const GaugeRow& row) { return row.dry[index]; });
  result.dry = static_cast<double>(dry) / static_cast<double>(rows.size());
  if (gauge.measured) compare_with_measured(gauge, computed, result);
  return result;
}

}  // namespace freshet
