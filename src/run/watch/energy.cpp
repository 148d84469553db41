#include "src/run/watch/energy.hpp"

#include <algorithm>
#include <cmath>

namespace freshet {
namespace {

// of the energy at the start: water at rest has no kinetic energy to compare with
constexpr double round_off = 1e-10;

}  // namespace

EnergyWatch::EnergyWatch(const Scene& scene)
    : closed_(scene.boundaries.empty()), incompressible_(scene.fpm), end_(scene.end_time) {}

void EnergyWatch::after_step(const Method& method, const Clock& clock) {
  if (!closed_ || clock.step % 100 != 0) return;
  const TimedRegion region("run::check");
  record(method.mechanics(), clock);
}

// Incompressible methods' steps are few and long.
void EnergyWatch::finish(const Method& method, const Clock& clock) {
  if (incompressible_ && clock.t >= end_) record(method.mechanics(), clock);
}

void EnergyWatch::record(const Mechanics& mechanics, const Clock& clock) {
  kinetic_ = std::max(kinetic_, mechanics.kinetic);
  gain_ = std::max(gain_, mechanics.kinetic + mechanics.potential - energy_at_start());
  if (first_ < 0 && gain_ > most_gain * kinetic_ + round_off * std::abs(energy_at_start())) first_ = clock.t;
}

std::vector<std::string> EnergyWatch::warnings() const {
  if (first_ < 0) return {};
  return {
      formatted("the water gained energy, up to %.3g m5/s2 per unit density, largest kinetic energy %.3g; "
                "first noticed at "
                "t = %.6g s\n"
                "  help: the results may be worthless: take a shorter time step (time.cfl; sisph: time.dt)\n"
                "  or a finer water.spacing and compare; sph-swe also has sph.stabilise",
                gain_, kinetic_, first_)};
}

void EnergyWatch::save(Values& values) const {
  values["mechanics"] = {start_.momentum[0], start_.momentum[1], start_.kinetic, start_.potential};
  values["energy_watch"] = {energy_at_start(), kinetic_, gain_, first_};
}

void EnergyWatch::restore(const Values& values, const Clock&) {
  const auto& m = values.at("mechanics");
  start_ = {{m.at(0), m.at(1)}, m.at(2), m.at(3)};
  const auto& v = values.at("energy_watch");
  kinetic_ = v.at(1), gain_ = v.at(2), first_ = v.at(3);
}

void EnergyWatch::report(const Method& method, const Clock&, Report& report) const {
  const Mechanics end = method.mechanics();
  report.object("energy")
      .value("kinetic_start_m5_s2", start_.kinetic)
      .value("potential_start_m5_s2", start_.potential)
      .value("kinetic_end_m5_s2", end.kinetic)
      .value("potential_end_m5_s2", end.potential)
      .end();
  report.object("momentum")
      .value("x_start_m4_s", start_.momentum[0])
      .value("y_start_m4_s", start_.momentum[1])
      .value("x_end_m4_s", end.momentum[0])
      .value("y_end_m4_s", end.momentum[1])
      .end();
  for (const auto& line : warnings()) report.warnings.push_back(line);
}

}  // namespace freshet
