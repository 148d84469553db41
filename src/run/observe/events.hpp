// The clock, and times on which steps end exactly.
#pragma once
#include <cstddef>
#include <limits>
#include <vector>

namespace freshet {

struct Clock {
  double t = 0;   // s
  long step = 0;  // steps taken
  double dt = 0;  // s, of the last one
};

constexpr double never = std::numeric_limits<double>::infinity();  // s

// Increasing times [s], ticked off one by one.
class Timetable {
 public:
  explicit Timetable(std::vector<double> times = {}) : times_(std::move(times)) {}
  double next() const { return done_ < times_.size() ? times_[done_] : never; }
  bool due(double t) const { return t >= next(); }
  void advance() { ++done_; }
  void skip_past(double t) {
    while (due(t)) advance();
  }
  std::size_t done() const { return done_; }
  std::size_t count() const { return times_.size(); }

 private:
  std::vector<double> times_;
  std::size_t done_ = 0;
};

// 0, interval, 2 interval ... end; an interval of 0 gives 0 and end. The last interval may be shorter.
std::vector<double> regular_times(double interval, double end);

struct Stride {
  double dt;     // s
  double until;  // s, time after the step; where it ends on an event the event's own time, not a rounded sum
};

// The stable step, made shorter so that the time left to the event [s] is split into equal steps: no tiny one
// remains.
Stride stride_towards(double event, const Clock& clock, double stable_dt);

}  // namespace freshet
