#include "src/run/strain.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace freshet {
namespace {

constexpr double round_off = 1e-10;  // of the energy at the start: water at rest has no kinetic energy to compare with

std::string sentence(const char* what, double strained, double spans, double first, double worst, double limit) {
  char text[400];
  std::snprintf(text, sizeof text,
                "%s in %.0f of %.0f spans of %ld steps (the last may be shorter), first after t = %.6g s: up to %.3g per step, limit %.3g\n"
                "  help: the time step may be too long for this flow: see whether a smaller time.cfl gives the same results",
                what, strained, spans, Strain::span, first, worst, limit);
  return text;
}

}  // namespace

void Strain::Kind::note(double value, double limit, double from) {
  worst = std::max(worst, value);
  if (!(value > limit)) return;
  if (spans == 0) first = from;
  ++spans;
}

void Strain::judge(const StepReport& report) {
  ++spans_;
  labour_.note(iterations_ / steps_, most_iterations, begun_);
  outgrown_.note((static_cast<double>(report.rebuilds) - rebuilds_) / steps_, most_rebuilds, begun_);
}

void Strain::record(const StepReport& report, const Clock& clock) {
  ++steps_;
  iterations_ += report.newton_mean;
  if (steps_ < span) return;
  judge(report);
  begun_ = clock.t, steps_ = 0, iterations_ = 0, rebuilds_ = static_cast<double>(report.rebuilds);
}

std::vector<std::string> Strain::warnings(const StepReport& report) const {
  Strain whole = *this;
  if (steps_ >= least) whole.judge(report);
  std::vector<std::string> lines;
  const auto add = [&](const char* what, const Kind& kind, double limit) {
    if (kind.spans > 0) lines.push_back(sentence(what, kind.spans, whole.spans_, kind.first, kind.worst, limit));
  };
  add("the density iteration laboured", whole.labour_, most_iterations);
  add("smoothing lengths outgrew their neighbour lists", whole.outgrown_, most_rebuilds);
  if (report.unsettled > 0)
    lines.push_back("the free surface did not settle in " + std::to_string(report.unsettled) + " of " + std::to_string(report.passes) +
                    " passes; the mass is kept all the same\n  help: a smaller time step, or larger sisph.newton.max and sisph.cg.max");
  return lines;
}

void Strain::save(Values& values) const {
  values["strain"] = {begun_, steps_, iterations_, rebuilds_, spans_};
  values["strain_kinds"] = {labour_.spans, labour_.first, labour_.worst, outgrown_.spans, outgrown_.first, outgrown_.worst};
}

void Strain::restore(const Values& values) {
  const auto& s = values.at("strain");
  begun_ = s.at(0), steps_ = s.at(1), iterations_ = s.at(2), rebuilds_ = s.at(3), spans_ = s.at(4);
  const auto& k = values.at("strain_kinds");
  labour_ = {k.at(0), k.at(1), k.at(2)};
  outgrown_ = {k.at(3), k.at(4), k.at(5)};
}

void EnergyWatch::record(const Mechanics& mechanics, const Clock& clock) {
  kinetic_ = std::max(kinetic_, mechanics.kinetic);
  gain_ = std::max(gain_, mechanics.kinetic + mechanics.potential - start_);
  if (first_ < 0 && gain_ > most_gain * kinetic_ + round_off * std::abs(start_)) first_ = clock.t;
}

std::vector<std::string> EnergyWatch::warnings() const {
  if (first_ < 0) return {};
  char text[400];
  std::snprintf(text, sizeof text,
                "the water gained energy, up to %.3g m5/s2 per unit density, largest kinetic energy %.3g; first noticed at t = %.6g s\n"
                "  help: the results may be worthless: take a shorter time step (time.cfl; sisph: time.dt)\n"
                "  or a finer water.spacing and compare; sph-swe also has sph.stabilise",
                gain_, kinetic_, first_);
  return {text};
}

void EnergyWatch::restore(const Values& values) {
  const auto& v = values.at("energy_watch");
  start_ = v.at(0), kinetic_ = v.at(1), gain_ = v.at(2), first_ = v.at(3);
}

}  // namespace freshet
