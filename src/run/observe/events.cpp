#include "src/run/observe/events.hpp"

#include <algorithm>
#include <cmath>

namespace freshet {

std::vector<double> regular_times(double interval, double end) {
  std::vector<double> times{0};
  // Half an interval in a thousand: k * interval that misses the end by rounding is the end.
  const double last = end - 5e-4 * interval;
  for (long k = 1; interval > 0 && k * interval < last; ++k) times.push_back(k * interval);
  if (end > 0) times.push_back(end);
  return times;
}

Stride stride_towards(double event, const Clock& clock, double stable_dt) {
  const double remaining = event - clock.t;
  const double parts = std::max(1.0, std::ceil(remaining / stable_dt));
  const double dt = remaining / parts;
  return {dt, parts > 1 ? clock.t + dt : event};
}

}  // namespace freshet
