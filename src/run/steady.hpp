// How still a flow stands that should not change: the largest speed over time and the rate of change of the depths.
#pragma once
#include "src/io/checkpoint.hpp"
#include "src/io/summary.hpp"
#include "src/method.hpp"

namespace freshet {

// Does nothing unless scene.compare.steady.
class SteadyRecorder {
 public:
  explicit SteadyRecorder(const Scene& scene) : wanted_(scene.compare.steady), gravity_(scene.gravity) {}

  void begin(const Method& method);  // the deepest water of the start
  void record(const Method& method);
  bool wanted() const { return wanted_; }
  // The explicit method gives the rate of change of each particle's depth as the field depth_rate; with others it is not known. `dt` [s] of
  // the last step.
  Steadiness result(const Method& method, double dt) const;

  void save(Values& values) const { values["steady"] = {deepest_, fastest_}; }
  void restore(const Values& values);

 private:
  bool wanted_;
  double gravity_;
  double deepest_ = 0, fastest_ = 0;  // m, m/s
};

}  // namespace freshet
