// What a run has to say of itself at its end: balances, errors, gauges.
#include <algorithm>
#include <cmath>

#include "cellgrid/runtime.hpp"
#include "src/io/fluid.hpp"
#include "src/run/build.hpp"
#include "src/run/compare.hpp"
#include "src/run/driver.hpp"
#include "src/run/gauge_stats.hpp"

namespace freshet {

MassBalance Driver::mass_balance() const {
  const Totals totals = method_.totals();
  MassBalance mass;
  mass.initial = monitor_.initial_mass();
  mass.inflow = totals.inflow;
  mass.outflow = totals.outflow;
  mass.final = totals.mass;
  mass.relative_error = monitor_.mass_error(totals);
  const double unaccounted = std::abs(totals.inflow - totals.outflow - totals.straddle - totals.flux);
  if (!scene_.boundaries.empty()) mass.flux_error = unaccounted / std::max(totals.flux_gross, 1e-300);
  return mass;
}

EnergyBalance Driver::energy_balance() const {
  const Mechanics &start = initial_mechanics_, end = method_.mechanics();
  return {start.kinetic, start.potential, end.kinetic, end.potential,
          {start.momentum[0], start.momentum[1]}, {end.momentum[0], end.momentum[1]}};
}

std::vector<std::string> Driver::warnings() const {
  std::vector<std::string> all = strain_.warnings(method_.report());
  for (const auto& line : energy_watch_.warnings()) all.push_back(line);
  for (const auto& line : method_.notes()) all.push_back(line);
  return all;
}

std::vector<GaugeResult> Driver::gauge_results() const {
  std::vector<GaugeResult> results;
  for (std::size_t g = 0; g < scene_.gauges.size(); ++g) {
    results.push_back(compare_gauge(scene_.gauges[g], gauges_.rows(), g));
  }
  return results;
}

std::vector<RunUpResult> Driver::run_up_results() const {
  std::vector<RunUpResult> results;
  for (std::size_t r = 0; r < scene_.run_ups.size(); ++r) {
    RunUpResult result;
    result.name = scene_.run_ups[r].name;
    const WetLevels highest = run_ups_.highest()[r];
    if (highest.bed > -1e299) result.highest = highest.bed, result.waterline = highest.line;
    if (const auto& range = scene_.run_ups[r].measured) result.measured = {(*range)[0], (*range)[1]};
    results.push_back(result);
  }
  return results;
}

ErrorNorms Driver::errors() const {
  ErrorNorms errors = error_norms(scene_, fluid_on_host(method_.fields()), clock_.t);
  errors.grid_l2_rel = grid_l2(scene_, method_, clock_.t);
  return errors;
}

Summary Driver::summary() const {
  Summary s;
  s.scene_case = scene_.name;
  s.method = method_.name();
  s.backend = backend_name();
  s.registers = registers_name();
  s.version = build::version;
  s.threads = thread_count();
  s.initial_particles = initial_particles_;
  s.final_particles = fluid_count(method_.fields());
  s.steps = clock_.step;
  const StepReport report = method_.report();
  s.list_rebuilds = report.rebuilds;
  s.solver = {report.passes, report.solves, report.iterations, report.unsettled, report.newton_max};
  s.simulated = clock_.t;
  s.wall = wall();
  s.particle_steps_per_s = (earlier_particle_steps_ + progress_.particle_steps()) / std::max(s.wall, 1e-9);
  s.mass = mass_balance();
  s.energy = energy_balance();
  s.warnings = warnings();
  s.gauges = gauge_results();
  s.run_ups = run_up_results();
  s.profiles = profiles_.results();
  s.compared = scene_.compare.exact != nullptr;
  if (s.compared) s.errors = errors();
  if (s.compared) s.errors.depth_l1_rel = median(l1_samples_);
  s.errors_at = errors_at_;
  s.watched = steady_.wanted();
  if (s.watched) s.steady = steady_.result(method_, dt_);
  return s;
}

}  // namespace freshet
