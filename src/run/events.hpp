// The clock and the times at which something is written: steps end exactly on output and comparison times.
#pragma once
#include <cstddef>
#include <limits>
#include <vector>

#include "src/scene/scene.hpp"

namespace freshet {

struct Clock {
  double t = 0;   // s
  long step = 0;  // steps taken
};

// Increasing times [s], ticked off one by one.
class Timetable {
 public:
  explicit Timetable(std::vector<double> times = {}) : times_(std::move(times)) {}
  double next() const;  // infinity when all are done
  bool due(double t) const { return t >= next(); }
  void advance() { ++done_; }
  std::size_t done() const { return done_; }
  void skip_to(std::size_t done) { done_ = done; }
  std::size_t count() const { return times_.size(); }

 private:
  std::vector<double> times_;
  std::size_t done_ = 0;
};

// 0, interval, 2 interval ... end; an interval of 0 gives 0 and end. The last interval may be shorter.
std::vector<double> regular_times(double interval, double end);
// The times at which depth_l1_rel is taken; none without an exact solution.
std::vector<double> comparison_times(const Compare& compare, double end);

struct Stride {
  double dt;  // s
  double
      until;  // s, time after the step: the event's own time, not a rounded sum, where the step ends on one
};

struct Events {
  Timetable outputs, comparisons, profiles, snapshots;  // snapshots: Compare::times
  double end;  // s
  explicit Events(const Scene& scene);

  // The stable step, made shorter so that the time left to the next event is split into equal steps: no tiny
  // one remains.
  // next: of the other times that steps end on.
  Stride shorten(const Clock& clock, double stable_dt, double next = std::numeric_limits<double>::infinity()) const;
};

}  // namespace freshet
