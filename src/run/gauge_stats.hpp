// A computed gauge against the measured one. Computed values lie between two rows by linear interpolation.
#pragma once
#include <vector>

#include "src/io/gauges.hpp"
#include "src/io/summary.hpp"
#include "src/scene/scene.hpp"

namespace freshet {

// Column `index` of the rows as a series [m].
Series gauge_series(const std::vector<GaugeRow>& rows, std::size_t index);

// Statistics over the measured times that lie within the computed series. With tau = the measured rise from
// arrival to peak, the window of the main wave is [arrival - tau/2, peak time + tau]: it leaves out the rest
// before the wave, which any computation matches. Only for gauges with peak_after > 0.
GaugeResult compare_gauge(const Gauge& gauge, const std::vector<GaugeRow>& rows, std::size_t index);

struct Peak {
  double value = unknown, t = unknown;  // m, s
};
Peak peak_after(const Series& series, double after, double until);

// First time after `after` at which the series crosses `level` upwards, by linear interpolation; unknown if
// it does not.
double arrival_after(const Series& series, double level, double after, double until);

}  // namespace freshet
