// How still a flow stands that should not change: the largest speed over time and the rate of change of the
// depths.
#pragma once
#include "src/run/observe/observer.hpp"

namespace freshet {

// How still a steady flow stands.
struct Steadiness {
  double max_speed_rel = unknown;  // largest speed at any step / sqrt(g d_max), d_max of the start
  double end_speed_rel = unknown;  // the same at the end alone
  double rate = unknown;           // 1/s, rms over the particles of the relative change of depth at the end
  double thesis_ls = unknown;      // the same as thesis (1.12), summed over N particles: sqrt(N) rate dt
};

class SteadinessWatch : public Observer {
 public:
  static bool wanted(const Scene& scene) { return scene.compare.steady; }
  explicit SteadinessWatch(const Scene& scene) : gravity_(scene.gravity) {}

  void begin(const Method& method) override;  // the deepest water of the start
  void after_step(const Method& method, const Clock& clock) override;
  void save(Values& values) const override { values["steady"] = {deepest_, fastest_}; }
  void restore(const Values& values, const Clock& clock) override;
  void report(const Method& method, const Clock& clock, Report& report) const override;

  // The explicit method gives the rate of change of each particle's depth as the field depth_rate; with
  // others it is not known.
  Steadiness result(const Method& method, const Clock& clock) const;

 private:
  double gravity_;
  double deepest_ = 0, fastest_ = 0;  // m, m/s
};

}  // namespace freshet
