// The read-back of a scene for `freshet check`.
#include <algorithm>
#include <cstdio>

#include "src/scene/names.hpp"
#include "src/scene/diagnostics.hpp"
#include "src/scene/read.hpp"

namespace freshet {
namespace {

using input::counted;

// Six digits, for people.
std::string brief(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", number);
  return text;
}

std::string extent(const Domain& domain) {
  const std::string x = "x " + brief(domain.low[0]) + " to " + brief(domain.high[0]);
  if (domain.dimension == 1) return "1-D, " + x + " m";
  return "2-D, " + x + ", y " + brief(domain.low[1]) + " to " + brief(domain.high[1]) + " m";
}

std::string point(const Point& p, const Domain& domain) {
  return domain.dimension == 1 ? "x = " + brief(p[0]) : '(' + brief(p[0]) + ", " + brief(p[1]) + ')';
}

std::string bed(const Scene& scene) {
  const Bed& bed = scene.bed;
  if (!bed.elevation) return "flat at 0";
  std::string out = bed.description + ", " + brief(bed.range[0]) + " to " + brief(bed.range[1]) + " m";
  if (bed.nodata > 0) out += ", " + counted(bed.nodata, "node") + " without a value filled";
  out += ", lattice " + brief(bed.spacing) + " m";
  return out + (bed.filter > 0 ? ", smoothed with standard deviation " + brief(bed.filter) + " m"
                               : ", not smoothed");
}

std::string water(const Scene& scene) {
  const Water& water = scene.water;
  const bool equal_mass = water.start == Water::Start::equal_mass;
  std::string out =
      "spacing " + brief(water.spacing) + (equal_mass ? " m in the deepest water, equal masses" : " m");
  if (water.surface) out += ", from its surface";
  return out + (water.velocity[0] ? ", moving" : ", at rest");
}

std::string boundary(const OpenBoundary& boundary, const Domain& domain) {
  const bool wave = boundary.kind == OpenBoundary::Kind::wave;
  std::string out = boundary.name + ": " + (wave ? "incoming wave" : "imposed elevation") + ", ";
  out += domain.dimension == 1 ? point(boundary.line[0], domain)
                               : point(boundary.line[0], domain) + " to " + point(boundary.line[1], domain);
  const Series& level = boundary.level;
  if (level.t.size() == 1) return out + ", level " + brief(level.value[0]) + " m";
  const auto range = std::minmax_element(level.value.begin(), level.value.end());
  return out + ", " + counted(level.t.size(), "row") + ", t " + brief(level.t.front()) + " to " +
         brief(level.t.back()) + " s, level " + brief(*range.first) + " to " + brief(*range.second) + " m";
}

std::string gauge(const Gauge& gauge, const Domain& domain) {
  std::string out = gauge.name + " at " + point(gauge.at, domain);
  if (!gauge.measured) return out;
  const Series& measured = *gauge.measured;
  return out + ", measured " + counted(measured.t.size(), "row") + ", t " + brief(measured.t.front()) +
         " to " + brief(measured.t.back()) + " s";
}

std::string run_up(const RunUp& run_up, const Domain& domain) {
  std::string out =
      run_up.name + " at " + point(run_up.at, domain) + ", radius " + brief(run_up.radius) + " m";
  if (!run_up.measured) return out;
  return out + ", measured " + brief((*run_up.measured)[0]) + " to " + brief((*run_up.measured)[1]) + " m";
}

std::string numerics(const Scene& scene) {
  const Sph& sph = scene.sph;
  std::string out = scene.method + ", " + name_in(kernel_names(), sph.kernel) + " kernel" +
                    (sph.lattice_correction ? " (lattice correction)" : "") + ", h/dx " + brief(sph.eta) + ", CFL " +
                    brief(scene.cfl) + ", " + name_of(sph.stabilisation);
  if (sph.stabilisation == Stabilisation::artificial_viscosity)
    out += " a = " + brief(sph.viscosity[0]) + ", b = " + brief(sph.viscosity[1]);
  if (sph.strength != 1) out += " x " + brief(sph.strength);
  return out + (sph.acceleration == Acceleration::classical ? ", classical acceleration"
                                                            : ", variational acceleration");
}

std::string area(const AreaLimit& limit) {
  std::string out = limit.elsewhere ? brief(*limit.elsewhere) + " spacing^D" : "";
  if (!limit.regions.empty()) out += (out.empty() ? "" : ", ") + counted(limit.regions.size(), "region");
  return out;
}

std::string output(const Scene& scene) {
  const Output& output = scene.output;
  std::string out =
      output.every > 0 ? "particles every " + brief(output.every) + " s" : "first and last state";
  if (!scene.gauges.empty() && output.gauges_every > 0)
    out += ", gauges every " + brief(output.gauges_every) + " s";
  return out;
}

std::string compare(const Compare& compare) {
  std::string out = compare.description + ", depths above " + brief(compare.threshold) + " m";
  for (const double t : compare.times) out += (t == compare.times.front() ? ", also at " : ", ") + brief(t);
  if (!compare.times.empty()) out += " s";
  if (compare.where) out += ", in a part of the domain";
  if (compare.samples == 1) return out;
  return out + ", median of " + std::to_string(compare.samples) + " times in the last " +
         brief(compare.window) + " s";
}

}  // namespace

std::vector<std::string> describe(const Scene& scene) {
  std::vector<std::string> lines;
  const auto add = [&lines](const std::string& label, const std::string& text) {
    lines.push_back(label + std::string(label.size() < 12 ? 12 - label.size() : 1, ' ') + text);
  };
  add("scene", scene.name + " (" + scene.file + ")");
  add("domain", extent(scene.domain));
  add("bed", bed(scene));
  add("friction", scene.manning ? "Manning n = " + brief(*scene.manning) + " s/m^(1/3)" : "none");
  add("water", water(scene));
  add("walls", counted(scene.walls.size(), "line"));
  for (const OpenBoundary& b : scene.boundaries) add("boundary", boundary(b, scene.domain));
  for (const Gauge& g : scene.gauges) add("gauge", gauge(g, scene.domain));
  for (const RunUp& r : scene.run_ups) add("run-up", run_up(r, scene.domain));
  add("time", "0 to " + brief(scene.end_time) + " s");
  add("method", numerics(scene));
  if (scene.split) add("split", "into " + std::to_string(scene.split->into) + " from " + area(scene.split->area));
  if (scene.merge) add("merge", "below " + area(scene.merge->area));
  add("output", output(scene));
  if (scene.compare.exact) add("compare", compare(scene.compare));
  for (const std::string& note : scene.notes) add("note", note);
  return lines;
}

}  // namespace freshet
