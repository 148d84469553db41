#include "src/run/events.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/run/profiles.hpp"

namespace freshet {

double Timetable::next() const {
  return done_ < times_.size() ? times_[done_] : std::numeric_limits<double>::infinity();
}

std::vector<double> regular_times(double interval, double end) {
  std::vector<double> times{0};
  // Half an interval in a thousand: k * interval that misses the end by rounding is the end.
  const double last = end - 5e-4 * interval;
  for (long k = 1; interval > 0 && k * interval < last; ++k) times.push_back(k * interval);
  if (end > 0) times.push_back(end);
  return times;
}

std::vector<double> comparison_times(const Compare& compare, double end) {
  std::vector<double> times;
  if (!compare.exact) return times;
  const int intervals = std::max(compare.samples - 1, 1);
  for (int k = std::max(compare.samples - 1, 0); k >= 0; --k)
    times.push_back(end - compare.window * k / intervals);
  times.erase(times.begin(), std::find_if(times.begin(), times.end(), [](double t) { return t >= 0; }));
  return times;
}

Events::Events(const Scene& scene)
    : outputs(regular_times(scene.output.every, scene.end_time)),
      comparisons(comparison_times(scene.compare, scene.end_time)),
      profiles(profile_times(scene)),
      snapshots(scene.compare.times),
      end(scene.end_time) {}

Stride Events::shorten(const Clock& clock, double stable_dt, double next) const {
  const double event = std::min({outputs.next(), comparisons.next(), profiles.next(), snapshots.next(), next, end});
  const double remaining = event - clock.t;
  const double parts = std::max(1.0, std::ceil(remaining / stable_dt));
  const double dt = remaining / parts;
  return {dt, parts > 1 ? clock.t + dt : event};
}

}  // namespace freshet
