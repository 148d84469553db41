// Errors against the scene's exact solution ([compare]): at the end, and at the times that it names. Taking
// them is no part of the run.
#pragma once
#include "src/run/observe/observer.hpp"
#include "src/run/record/norms.hpp"

namespace freshet {

// The times at which depth_l1_rel is taken.
std::vector<double> comparison_times(const Compare& compare, double end);

struct ErrorsAt {
  double t = 0;  // s
  ErrorNorms errors;
};

class ErrorRecorder : public Observer {
 public:
  static bool wanted(const Scene& scene) { return scene.compare.exact != nullptr; }
  explicit ErrorRecorder(const Scene& scene);  // keeps a reference to the scene

  void take(const Method& method, const Clock& clock) override;
  double seconds_apart() const override { return comparing_; }
  void save(Values& values) const override;
  void restore(const Values& values, const Clock& clock) override;
  void report(const Method& method, const Clock& clock, Report& report) const override;

  // depth_l1_rel: the median of its samples.
  ErrorNorms at_end(const Method& method, const Clock& clock) const;
  const std::vector<ErrorsAt>& snapshots() const { return errors_at_; }

 private:
  ErrorNorms errors(const Method& method, double t) const;

  const Scene& scene_;
  std::vector<double> comparisons_;  // s
  std::vector<double> l1_samples_;   // depth_l1_rel at these times
  std::vector<ErrorsAt> errors_at_;
  double comparing_ = 0;  // s
};

}  // namespace freshet
