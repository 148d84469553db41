// The read-back of a scene for `freshet check`.
#include <algorithm>

#include "src/scene/read.hpp"
#include "src/scene/toml/choices.hpp"
#include "src/scene/toml/diagnostics.hpp"
#include "src/text.hpp"

namespace freshet {
namespace {

using input::counted;

// Northings have seven digits before the point.
std::string place(double coordinate) { return brief(coordinate, 9); }

std::string extent(const Domain& domain) {
  const std::string x = "x " + place(domain.low[0]) + " to " + place(domain.high[0]);
  if (domain.dimension == 1) return "1-D, " + x + " m";
  return "2-D, " + x + ", y " + place(domain.low[1]) + " to " + place(domain.high[1]) + " m";
}

std::string point(const Point& p, const Domain& domain) {
  return domain.dimension == 1 ? "x = " + place(p[0]) : '(' + place(p[0]) + ", " + place(p[1]) + ')';
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

std::string friction(const std::optional<Manning>& manning) {
  if (!manning) return "none";
  if (!manning->map) return "Manning n = " + brief(manning->n) + " s/m^(1/3)";
  return "Manning n: " + manning->description + ", the nearest of a lattice of " + brief(manning->step[0]) +
         " m";
}

std::string water(const Scene& scene) {
  const Water& water = scene.water;
  const bool equal_mass = water.start == Water::Start::equal_mass;
  std::string out =
      "spacing " + brief(water.spacing) + (equal_mass ? " m in the deepest water, equal masses" : " m");
  if (water.surface) out += ", from its surface";
  if (water.disorder > 0)
    out += ", disorder " + brief(water.disorder) + " of it (seed " + std::to_string(water.seed) + ")";
  return out + (water.velocity[0] ? ", moving" : ", at rest");
}

std::string imposed(const std::string& what, const Series& series, const std::string& unit) {
  if (series.t.empty()) return "";
  if (series.t.size() == 1) return ", " + what + ' ' + brief(series.value[0]) + ' ' + unit;
  const auto range = std::minmax_element(series.value.begin(), series.value.end());
  return ", " + counted(series.t.size(), "row") + ", t " + brief(series.t.front()) + " to " +
         brief(series.t.back()) + " s, " + what + ' ' + brief(*range.first) + " to " + brief(*range.second) +
         ' ' + unit;
}

std::string boundary(const OpenBoundary& boundary, const Domain& domain) {
  std::string out = boundary.name + ": " + input::titled(boundary.law) + ", ";
  const std::size_t points = domain.dimension == 1 ? 1 : boundary.line.size();
  for (std::size_t k = 0; k < points; ++k) out += (k > 0 ? " to " : "") + point(boundary.line[k], domain);
  for (const OpenBoundary::Imposed& i : boundary.imposed)
    out += imposed(i.what, i.series, domain.dimension == 1 && i.unit == "m3/s" ? "m2/s" : i.unit);
  return boundary.spacing > 0 ? out + ", spacing " + brief(boundary.spacing) + " m" : out;
}

std::string gauge(const Gauge& gauge, const Domain& domain) {
  const bool level = gauge.what == Gauge::What::elevation, front = gauge.what == Gauge::What::front;
  std::string out = gauge.name + (level ? "" : std::string(", ") + gauge.measurand().name) +
                    (front ? ": largest x of the water" : " at " + point(gauge.at, domain));
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

std::string transect(const Transect& line, const Domain& domain) {
  std::string out = line.name + " from " + point(line.line[0], domain) + " to " + point(line.line[1], domain);
  out += " at t = " + brief(line.time) + " s";
  if (!line.measured) return out;
  const Series& measured = *line.measured;
  return out + ", measured " + counted(measured.t.size(), "row") + " from " + brief(measured.t.front()) +
         " to " + brief(measured.t.back()) + " m";
}

std::string sisph_numerics(const Scene& scene) {
  const Sisph& sisph = scene.sisph;
  const std::string step = scene.time_step > 0 ? "time step " + brief(scene.time_step) + " s"
                                               : "celerity Courant number " + brief(sisph.courant);
  return (sisph.moving ? "sisph, moving, " : "sisph, ") + name_of(sisph.kernel) + " kernel, l/dx " +
         brief(sisph.smoothing) + ", theta " + brief(sisph.theta) + ", Picard " +
         std::to_string(sisph.picard) + ", " + step;
}

std::string fpm_numerics(const Scene& scene) {
  const Fpm& fpm = *scene.fpm;
  return scene.method + ", support " + brief(fpm.support) + " dx, CFL " + brief(scene.cfl) + ", density " +
         brief(fpm.density) + " kg/m3, viscosity " + brief(fpm.viscosity) + " m2/s, " +
         (fpm.slip ? "slip" : "no slip") + " at walls";
}

std::string numerics(const Scene& scene) {
  if (scene.method == "sisph") return sisph_numerics(scene);
  if (scene.fpm) return fpm_numerics(scene);
  const Sph& sph = scene.sph;
  return scene.method + ", " + name_of(sph.kernel) + " kernel" +
         (sph.lattice_correction ? " (lattice correction)" : "") + ", h/dx " + brief(sph.eta) + ", CFL " +
         brief(scene.cfl) + ", " + input::titled(sph.stabilisation) +
         (sph.acceleration == Acceleration::classical ? ", classical acceleration"
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

std::string rasters(const Rasters& rasters) {
  std::string out = "cells of " + brief(rasters.spacing) + " m, ";
  out += rasters.what.empty() ? "no maps in time" : counted(rasters.what.size(), "map") + ' ';
  if (!rasters.what.empty())
    out += rasters.every > 0 ? "every " + brief(rasters.every) + " s" : "first and last";
  if (rasters.maxima) out += ", maxima and arrival above " + brief(rasters.arrival) + " m in every step";
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
  if (scene.fpm) {
    add("bodies",
        counted(scene.fpm->bodies.size(), "piece") + " of water, dx " + brief(scene.water.spacing) + " m");
  } else {
    add("bed", bed(scene));
    add("friction", friction(scene.manning));
    add("water", water(scene));
  }
  add("walls", counted(scene.walls.size(), "line"));
  for (const OpenBoundary& b : scene.boundaries) add("boundary", boundary(b, scene.domain));
  for (const Gauge& g : scene.gauges) add("gauge", gauge(g, scene.domain));
  for (const RunUp& r : scene.run_ups) add("run-up", run_up(r, scene.domain));
  for (const Transect& p : scene.profiles) add("profile", transect(p, scene.domain));
  add("time", "0 to " + brief(scene.end_time) + " s");
  add("method", numerics(scene));
  if (scene.split)
    add("split", "into " + std::to_string(scene.split->into) + " from " + area(scene.split->area));
  if (scene.merge) add("merge", "below " + area(scene.merge->area));
  add("output", output(scene));
  if (scene.rasters) add("raster", rasters(*scene.rasters));
  if (scene.compare.exact) add("compare", compare(scene.compare));
  for (const std::string& note : scene.notes) add("note", note);
  return lines;
}

}  // namespace freshet
