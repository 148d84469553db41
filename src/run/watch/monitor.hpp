// Stops a run that has gone wrong: values that are not finite, negative depth, speed above the limit,
// particles outside the domain, water that appears or vanishes. Throws Diverged with what, which particle,
// where, when, which limit. Keeps the account of the mass for that.
#pragma once
#include "src/run/observe/observer.hpp"

namespace freshet {

// Where particles may be and how fast.
struct Allowed {
  double x_low, x_high, y_low, y_high;  // m, the domain and its margin
  double margin;                        // m, how far outside the domain a particle may be
  double speed;                         // m/s
};

struct MassBalance {
  double initial = unknown, inflow = 0, outflow = 0, final = unknown;  // m3
  double relative_error = unknown;  // |final - initial - inflow + outflow| / initial (initial = 0: / inflow)
  double flux_error = unknown;      // |inflow - outflow - straddle - flux| / gross flux, at open boundaries
};
double mass_error(double initial, const Totals& totals);  // the relative error

class Monitor : public Observer {
 public:
  explicit Monitor(const Scene& scene);

  void begin(const Method& method) override;
  void after_step(const Method& method, const Clock& clock) override;  // every hundredth: check_all()
  // Before output is written.
  void take(const Method& method, const Clock& clock) override { look(method, clock); }
  void finish(const Method& method, const Clock& clock) override { look(method, clock); }
  void save(Values& values) const override;
  void restore(const Values& values, const Clock& clock) override;
  void report(const Method& method, const Clock& clock, Report& report) const override;

  // One reduction over all particles; the particle is searched only if something is wrong.
  void check(const Method& method, const Clock& clock) const;
  // Every saved or sorted field of every particle, and the mass balance.
  void check_all(const Method& method, const Clock& clock) const;
  static void check_dt(double dt, const Clock& clock);

  MassBalance balance(const Totals& totals) const;
  int initial_particles() const { return initial_particles_; }  // of the fluid

 private:
  void look(const Method& method, const Clock& clock);  // check_all() once a step

  Allowed allowed_;
  double mass_limit_;        // relative
  bool open_;                // open boundaries
  double initial_mass_ = 0;  // m3
  int initial_particles_ = 0;
  long looked_at_ = -1;  // step
};

}  // namespace freshet
