// Stops a run that has gone wrong: values that are not finite, negative depth, speed above the limit,
// particles outside the domain, water that appears or vanishes. Throws Diverged with what, which particle,
// where, when, which limit.
#pragma once
#include "src/method.hpp"
#include "src/run/events.hpp"

namespace freshet {

// Where particles may be and how fast.
struct Allowed {
  double x_low, x_high, y_low, y_high;  // m, the domain and its margin
  double margin;                        // m, how far outside the domain a particle may be
  double speed;                         // m/s
};

class Monitor {
 public:
  explicit Monitor(const Scene& scene);

  // One reduction over all particles; the particle is searched only if something is wrong.
  void check(const Method& method, const Clock& clock) const;
  // Every saved or sorted field of every particle, and the mass balance: at outputs and every hundredth step.
  void check_all(const Method& method, const Clock& clock) const;
  void check_dt(double dt, const Clock& clock) const;

  void start(double initial_mass) { initial_mass_ = initial_mass; }  // m3
  double initial_mass() const { return initial_mass_; }
  double mass_error(const Totals& totals) const;  // |M - M0 - in + out| / M0 (M0 = 0: per inflow)

 private:
  Allowed allowed_;
  double mass_limit_;  // relative
  double initial_mass_ = 0;
};

}  // namespace freshet
