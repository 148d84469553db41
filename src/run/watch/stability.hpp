// Notices a run that goes on with garbage: past its stable time step the density iteration labours and
// neighbour lists are outgrown in every other step, long before a value leaves its limits. Looked at in spans
// of 1000 steps, the last one perhaps shorter: thin tongues may outgrow their lists in forty steps of a
// hundred and be right.
#pragma once
#include "src/run/observe/observer.hpp"

namespace freshet {

class StabilityWatch : public Observer {
 public:
  static constexpr long span = 1000;            // steps
  static constexpr long least = 100;            // steps of a last span that is judged
  static constexpr double most_iterations = 3;  // mean density evaluations per cluster; sound runs reach 2
  static constexpr double most_rebuilds = 0.1;  // neighbour lists made again, per step of a span

  explicit StabilityWatch(const Scene& = {}) {}
  static bool wanted(const Scene& scene) { return !scene.fpm; }  // which reports none of this

  void after_step(const Method& method, const Clock& clock) override { record(method.report(), clock); }
  void save(Values& values) const override;
  void restore(const Values& values, const Clock& clock) override;
  void report(const Method& method, const Clock& clock, Report& report) const override;

  void record(const StepReport& report, const Clock& clock);
  // One line per kind of trouble; none: empty. At the end, with the report of the last step.
  std::vector<std::string> warnings(const StepReport& report) const;

 private:
  struct Trouble {
    double spans = 0, first = 0, worst = 0;  // spans above the limit, start of the first [s], largest value
    void note(double value, double limit, double from);
  };
  void judge(const StepReport& report);

  double begun_ = 0, steps_ = 0, iterations_ = 0;  // of the span at hand
  double rebuilds_ = 0;                            // at its start
  double spans_ = 0;
  Trouble labour_, outgrown_;
};

}  // namespace freshet
