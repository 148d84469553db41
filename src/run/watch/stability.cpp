#include "src/run/watch/stability.hpp"

#include <algorithm>

namespace freshet {
namespace {

std::string sentence(const char* what, double above, double spans, double first, double worst, double limit) {
  return formatted(
      "%s in %.0f of %.0f spans of %ld steps (the last may be shorter), first after t = %.6g s: up to %.3g "
      "per step, "
      "limit %.3g\n"
      "  help: the time step may be too long for this flow: see whether a smaller time.cfl gives the same "
      "results",
      what, above, spans, StabilityWatch::span, first, worst, limit);
}

}  // namespace

void StabilityWatch::Trouble::note(double value, double limit, double from) {
  worst = std::max(worst, value);
  if (!(value > limit)) return;
  if (spans == 0) first = from;
  ++spans;
}

void StabilityWatch::judge(const StepReport& report) {
  ++spans_;
  labour_.note(iterations_ / steps_, most_iterations, begun_);
  outgrown_.note((static_cast<double>(report.rebuilds) - rebuilds_) / steps_, most_rebuilds, begun_);
}

void StabilityWatch::record(const StepReport& report, const Clock& clock) {
  ++steps_;
  iterations_ += report.newton_mean;
  if (steps_ < span) return;
  judge(report);
  begun_ = clock.t, steps_ = 0, iterations_ = 0, rebuilds_ = static_cast<double>(report.rebuilds);
}

std::vector<std::string> StabilityWatch::warnings(const StepReport& report) const {
  StabilityWatch whole = *this;
  if (steps_ >= least) whole.judge(report);
  std::vector<std::string> lines;
  const auto add = [&](const char* what, const Trouble& one, double limit) {
    if (one.spans > 0) lines.push_back(sentence(what, one.spans, whole.spans_, one.first, one.worst, limit));
  };
  add("the density iteration laboured", whole.labour_, most_iterations);
  add("smoothing lengths outgrew their neighbour lists", whole.outgrown_, most_rebuilds);
  if (report.unsettled > 0)
    lines.push_back(
        formatted("the free surface did not settle in %ld of %ld passes; the mass is kept all the same\n"
                  "  help: a smaller time step, or larger sisph.newton.max and sisph.cg.max",
                  report.unsettled, report.passes));
  return lines;
}

void StabilityWatch::save(Values& values) const {
  values["strain"] = {begun_, steps_, iterations_, rebuilds_, spans_};
  values["strain_kinds"] = {labour_.spans,   labour_.first,   labour_.worst,
                            outgrown_.spans, outgrown_.first, outgrown_.worst};
}

void StabilityWatch::restore(const Values& values, const Clock&) {
  const auto& s = values.at("strain");
  begun_ = s.at(0), steps_ = s.at(1), iterations_ = s.at(2), rebuilds_ = s.at(3), spans_ = s.at(4);
  const auto& k = values.at("strain_kinds");
  labour_ = {k.at(0), k.at(1), k.at(2)};
  outgrown_ = {k.at(3), k.at(4), k.at(5)};
}

void StabilityWatch::report(const Method& method, const Clock&, Report& report) const {
  for (const auto& line : warnings(method.report())) report.warnings.push_back(line);
}

}  // namespace freshet
