// A computed gauge against the measured one, in the unit of what it shows. Computed values lie between two
// rows by linear interpolation.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "src/io/gauges.hpp"
#include "src/scene/scene.hpp"
#include "src/text.hpp"

namespace freshet {

// Values in the unit of what the gauge shows, times in s.
struct GaugeResult {
  std::string name;
  double rmse = unknown, max_abs_error = unknown;  // over the measured times that lie in the run
  double rmse_window = unknown;                    // the same over the window of the main wave
  std::pair<double, double> window{unknown, unknown};
  double peak = unknown, peak_time = unknown;  // after Gauge::peak_after
  double measured_peak = unknown, measured_peak_time = unknown;
  double arrival = unknown, measured_arrival = unknown;  // first crossing of Gauge::arrival_level
  double dry = 0;                                        // fraction of the rows
};

// Column `index` of the rows as a series.
Series gauge_series(const std::vector<GaugeRow>& rows, std::size_t index);

// Statistics over the measured times that lie within the computed series. With tau = the measured rise from
// arrival to peak, the window of the main wave is [arrival - tau/2, peak time + tau]: it leaves out the rest
// before the wave, which any computation matches. Only for gauges with peak_after > 0.
GaugeResult compare_gauge(const Gauge& gauge, const std::vector<GaugeRow>& rows, std::size_t index);

struct Peak {
  double value = unknown, t = unknown;  // s
};
Peak peak_after(const Series& series, double after, double until);

// First time after `after` at which the series crosses `level` upwards, by linear interpolation; unknown if
// it does not.
double arrival_after(const Series& series, double level, double after, double until);

}  // namespace freshet
