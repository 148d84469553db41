#include "src/io/summary.hpp"

#include <cmath>

#include "src/io/json.hpp"

namespace freshet {
namespace {

void write(JsonWriter& out, const MassBalance& mass) {
  out.begin("mass")
      .value("initial_m3", mass.initial)
      .value("inflow_m3", mass.inflow)
      .value("outflow_m3", mass.outflow)
      .value("final_m3", mass.final)
      .value("relative_error", mass.relative_error)
      .value("flux_error", mass.flux_error)
      .end();
}

void write(JsonWriter& out, const EnergyBalance& energy) {
  out.begin("energy")
      .value("kinetic_start_m5_s2", energy.kinetic_start)
      .value("potential_start_m5_s2", energy.potential_start)
      .value("kinetic_end_m5_s2", energy.kinetic_end)
      .value("potential_end_m5_s2", energy.potential_end)
      .end();
  out.begin("momentum")
      .value("x_start_m4_s", energy.momentum_start.first)
      .value("y_start_m4_s", energy.momentum_start.second)
      .value("x_end_m4_s", energy.momentum_end.first)
      .value("y_end_m4_s", energy.momentum_end.second)
      .end();
}

void write(JsonWriter& out, const GaugeResult& gauge) {
  out.begin(gauge.name)
      .value("rmse", gauge.rmse)
      .value("rmse_window", gauge.rmse_window)
      .value("window_start", gauge.window.first)
      .value("window_end", gauge.window.second)
      .value("max_abs_error", gauge.max_abs_error)
      .value("peak", gauge.peak)
      .value("peak_time", gauge.peak_time)
      .value("measured_peak", gauge.measured_peak)
      .value("measured_peak_time", gauge.measured_peak_time)
      .value("arrival", gauge.arrival)
      .value("measured_arrival", gauge.measured_arrival)
      .value("dry_fraction", gauge.dry)
      .end();
}

void write(JsonWriter& out, const ErrorNorms& errors) {
  out.begin("errors")
      .value("depth_l1_rel", errors.depth_l1_rel)
      .value("depth_l2_rel", errors.depth_l2_rel)
      .value("depth_linf", errors.depth_linf)
      .value("velocity_l2", errors.velocity_l2)
      .value("grid_l2_rel", errors.grid_l2_rel)
      .end();
}

// A number of the tables in the given unit, "-" where it is not known.
std::string cell(double value, double unit, const char* format) {
  if (!std::isfinite(value)) return "-";
  char text[32];
  std::snprintf(text, sizeof text, format, value / unit);
  return text;
}

void print_gauges(std::FILE* out, const std::vector<GaugeResult>& gauges) {
  std::fprintf(out,
               "\n%-12s %8s %8s %8s   %15s   %15s   %15s\n%-12s %8s %8s %8s   %7s %7s   %7s %7s   %7s %7s\n",
               "gauge", "rmse", "in wave", "max", "peak [cm]", "at [s]", "arrival [s]", "", "[mm]", "[mm]",
               "[mm]", "run", "meas.", "run", "meas.", "run", "meas.");
  for (const auto& g : gauges) {
    const auto mm = [](double m) { return cell(m, 1e-3, "%.2f"); };
    const auto cm = [](double m) { return cell(m, 1e-2, "%.2f"); };
    const auto s = [](double t) { return cell(t, 1, "%.2f"); };
    std::fprintf(out, "%-12s %8s %8s %8s   %7s %7s   %7s %7s   %7s %7s\n", g.name.c_str(), mm(g.rmse).c_str(),
                 mm(g.rmse_window).c_str(), mm(g.max_abs_error).c_str(), cm(g.peak).c_str(),
                 cm(g.measured_peak).c_str(), s(g.peak_time).c_str(), s(g.measured_peak_time).c_str(),
                 s(g.arrival).c_str(), s(g.measured_arrival).c_str());
  }
}

void print_run_ups(std::FILE* out, const std::vector<RunUpResult>& run_ups) {
  std::fprintf(out, "\n%-12s %12s   %s\n", "run-up", "highest [m]", "measured [m]");
  for (const auto& r : run_ups) {
    const bool known = std::isfinite(r.measured.first);
    std::fprintf(
        out, "%-12s %12s   %s\n", r.name.c_str(), cell(r.highest, 1, "%.4f").c_str(),
        known ? (cell(r.measured.first, 1, "%.4f") + " ... " + cell(r.measured.second, 1, "%.4f")).c_str()
              : "-");
  }
}

void print_errors(std::FILE* out, const ErrorNorms& e) {
  std::fprintf(
      out,
      "\nagainst the exact solution: depth l2 %s, l1 %s, on a grid l2 %s, max %s m; velocity rms %s m/s\n",
      cell(e.depth_l2_rel, 1, "%.3e").c_str(), cell(e.depth_l1_rel, 1, "%.3e").c_str(),
      cell(e.grid_l2_rel, 1, "%.3e").c_str(), cell(e.depth_linf, 1, "%.3e").c_str(),
      cell(e.velocity_l2, 1, "%.3e").c_str());
}

}  // namespace

std::string json(const Summary& s) {
  JsonWriter out;
  out.begin().value("case", s.scene_case).value("method", s.method).value("version", s.version);
  out.value("backend", s.backend).value("threads", s.threads);
  out.begin("particles").value("initial", s.initial_particles).value("final", s.final_particles).end();
  out.value("steps", s.steps).value("list_rebuilds", s.list_rebuilds).value("simulated_s", s.simulated);
  out.value("wall_s", s.wall).value("particle_steps_per_s", s.particle_steps_per_s);
  write(out, s.mass);
  write(out, s.energy);
  out.array("warnings");
  for (const auto& warning : s.warnings) out.value("", warning);
  out.end_array().begin("gauges");
  for (const auto& gauge : s.gauges) write(out, gauge);
  out.end().begin("runup");
  for (const auto& run_up : s.run_ups) out.value(run_up.name, run_up.highest);
  out.end();
  if (s.compared) write(out, s.errors);
  return out.end().text() + "\n";
}

void print_tables(std::FILE* out, const Summary& s) {
  if (!s.gauges.empty()) print_gauges(out, s.gauges);
  if (!s.run_ups.empty()) print_run_ups(out, s.run_ups);
  if (s.compared) print_errors(out, s.errors);
  std::fprintf(
      out,
      "\n%ld steps, %d particles, %.2f s of water in %.2f s: %.2f M particle-steps/s on %d thread%s (%s)\n",
      s.steps, s.final_particles, s.simulated, s.wall, s.particle_steps_per_s / 1e6, s.threads,
      s.threads == 1 ? "" : "s", s.backend.c_str());
  std::fprintf(out, "mass: relative error %.1e", s.mass.relative_error);
  if (std::isfinite(s.mass.flux_error)) std::fprintf(out, ", flux error %.2e", s.mass.flux_error);
  std::fputc('\n', out);
  for (const auto& warning : s.warnings) std::fprintf(out, "warning: %s\n", warning.c_str());
}

}  // namespace freshet
