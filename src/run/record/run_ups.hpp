// The highest water at each run-up point so far; kept on the device.
#pragma once
#include <utility>

#include "src/run/observe/observer.hpp"

namespace freshet {

struct RunUpResult {
  std::string name;
  double highest = unknown, waterline = unknown;         // m, bed and line of kernels/water/wet_levels.hpp
  std::pair<double, double> measured{unknown, unknown};  // m, lowest and highest
};

class RunUpRecorder : public Observer {
 public:
  static bool wanted(const Scene& scene) { return !scene.run_ups.empty(); }
  explicit RunUpRecorder(const Scene& scene);

  void begin(const Method& method) override { method.raise_wet_levels(shores_); }
  void after_step(const Method& method, const Clock&) override { method.raise_wet_levels(shores_); }
  void save(Values& values) const override;
  void restore(const Values& values, const Clock& clock) override;
  void report(const Method& method, const Clock& clock, Report& report) const override;

  std::vector<WetLevels> highest() const;
  std::vector<RunUpResult> results() const;  // in the order of the scene

 private:
  std::vector<RunUp> points_;
  Shores shores_;
};

}  // namespace freshet
