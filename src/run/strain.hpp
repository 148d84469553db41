// Notices a run that goes on with garbage: past its stable time step the density iteration labours and neighbour lists are
// outgrown in every other step, long before a value leaves its limits. Looked at in spans of 1000 steps, the last one perhaps
// shorter: thin tongues may outgrow their lists in forty steps of a hundred and be right.
#pragma once
#include <string>
#include <vector>

#include "src/io/checkpoint.hpp"
#include "src/method.hpp"
#include "src/run/events.hpp"

namespace freshet {

class Strain {
 public:
  static constexpr long span = 1000;            // steps
  static constexpr long least = 100;            // steps of a last span that is judged
  static constexpr double most_iterations = 3;  // mean density evaluations per cluster in a span; sound runs reach 2
  static constexpr double most_rebuilds = 0.1;  // neighbour lists made again, per step of a span

  void record(const StepReport& report, const Clock& clock);  // after a step
  // One line per kind of strain; none: empty. At the end, with the report of the last step.
  std::vector<std::string> warnings(const StepReport& report) const;

  void save(Values& values) const;
  void restore(const Values& values);

 private:
  struct Kind {
    double spans = 0, first = 0, worst = 0;  // strained spans, start of the first [s], largest value
    void note(double value, double limit, double from);
  };
  void judge(const StepReport& report);

  double begun_ = 0, steps_ = 0, iterations_ = 0, rebuilds_ = 0;  // of the span at hand; rebuilds: at its start
  double spans_ = 0;
  Kind labour_, outgrown_;
};

// Notices water that gains energy where nothing feeds it: in a scene without open boundaries its energy cannot grow.
class EnergyWatch {
 public:
  static constexpr double most_gain = 0.05;  // of the largest kinetic energy; an integrator's error is below 0.005

  void start(const Mechanics& mechanics) { start_ = mechanics.kinetic + mechanics.potential; }
  void record(const Mechanics& mechanics, const Clock& clock);
  std::vector<std::string> warnings() const;

  void save(Values& values) const { values["energy_watch"] = {start_, kinetic_, gain_, first_}; }
  void restore(const Values& values);

 private:
  double start_ = 0, kinetic_ = 0, gain_ = 0, first_ = -1;  // m5/s2: at the start, largest so far, largest gain; s: first alarm
};

}  // namespace freshet
