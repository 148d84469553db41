// Energy and momentum at the start and at the end; notices water that gains energy where nothing feeds it: in
// a scene without open boundaries its energy cannot grow.
#pragma once
#include "src/run/observe/observer.hpp"

namespace freshet {

class EnergyWatch : public Observer {
 public:
  // Of the largest kinetic energy; an integrator's error is below 0.005.
  static constexpr double most_gain = 0.05;

  explicit EnergyWatch(const Scene& scene);

  void begin(const Method& method) override { start(method.mechanics()); }
  void after_step(const Method& method, const Clock& clock) override;  // every hundredth
  void finish(const Method& method, const Clock& clock) override;
  void save(Values& values) const override;
  void restore(const Values& values, const Clock& clock) override;
  void report(const Method& method, const Clock& clock, Report& report) const override;

  void start(const Mechanics& mechanics) { start_ = mechanics; }
  void record(const Mechanics& mechanics, const Clock& clock);
  std::vector<std::string> warnings() const;
  const Mechanics& at_start() const { return start_; }

 private:
  double energy_at_start() const { return start_.kinetic + start_.potential; }

  bool closed_, incompressible_;
  double end_;  // s
  Mechanics start_;
  double kinetic_ = 0, gain_ = 0, first_ = -1;  // m5/s2: largest so far, largest gain; s: first alarm
};

}  // namespace freshet
