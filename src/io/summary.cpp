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

void write(JsonWriter& out, const ProfileResult& profile) {
  out.begin(profile.name)
      .value("time", profile.time)
      .value("rmse", profile.rmse)
      .value("max_abs_error", profile.max_abs_error)
      .value("measured_range", profile.measured_range)
      .value("points", profile.points)
      .end();
}

void write(JsonWriter& out, const ErrorNorms& errors) {
  for (const NormName& norm : norm_names) out.value(norm.key, errors.*norm.value);
}

void write(JsonWriter& out, const std::vector<ErrorsAt>& errors_at) {
  out.array("errors_at");
  for (const ErrorsAt& at : errors_at) {
    write(out.begin().value("t", at.t), at.errors);
    out.end();
  }
  out.end_array();
}

void write(JsonWriter& out, const Steadiness& steady) {
  out.begin("steady")
      .value("max_speed_rel", steady.max_speed_rel)
      .value("end_speed_rel", steady.end_speed_rel)
      .value("rate", steady.rate)
      .value("thesis_ls", steady.thesis_ls)
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
  std::fprintf(out, "\n%-12s %12s %13s   %s\n", "run-up", "highest [m]", "waterline [m]", "measured [m]");
  for (const auto& r : run_ups) {
    const bool known = std::isfinite(r.measured.first);
    std::fprintf(
        out, "%-12s %12s %13s   %s\n", r.name.c_str(), cell(r.highest, 1, "%.4f").c_str(), cell(r.waterline, 1, "%.4f").c_str(),
        known ? (cell(r.measured.first, 1, "%.4f") + " ... " + cell(r.measured.second, 1, "%.4f")).c_str()
              : "-");
  }
}

void print_profiles(std::FILE* out, const std::vector<ProfileResult>& profiles) {
  std::fprintf(out, "\n%-12s %8s %8s %8s %12s %7s\n", "profile", "at [s]", "rmse", "max", "range [mm]", "points");
  for (const auto& p : profiles)
    std::fprintf(out, "%-12s %8s %8s %8s %12s %7d\n", p.name.c_str(), cell(p.time, 1, "%.2f").c_str(),
                 cell(p.rmse, 1e-3, "%.2f").c_str(), cell(p.max_abs_error, 1e-3, "%.2f").c_str(),
                 cell(p.measured_range, 1e-3, "%.2f").c_str(), p.points);
}

void print_errors(std::FILE* out, const ErrorNorms& e) {
  std::fprintf(
      out,
      "\nagainst the exact solution: depth l2 %s, l1 %s, on a grid l2 %s, max %s m; velocity rms %s m/s\n",
      cell(e.depth_l2_rel, 1, "%.3e").c_str(), cell(e.depth_l1_rel, 1, "%.3e").c_str(),
      cell(e.grid_l2_rel, 1, "%.3e").c_str(), cell(e.depth_linf, 1, "%.3e").c_str(),
      cell(e.velocity_l2, 1, "%.3e").c_str());
}

void print_errors_at(std::FILE* out, const std::vector<ErrorsAt>& errors_at) {
  std::fprintf(out, "\n%10s %12s %12s %12s %12s\n%10s %12s %12s %12s %12s\n", "time", "depth l2", "(2.58)", "vx (2.59)",
               "vy (2.59)", "[s]", "", "", "", "");
  for (const auto& [t, e] : errors_at)
    std::fprintf(out, "%10.4g %12s %12s %12s %12s\n", t, cell(e.depth_l2_rel, 1, "%.3e").c_str(),
                 cell(e.depth_l2_mean_rel, 1, "%.3e").c_str(), cell(e.velocity_l2_x, 1, "%.3e").c_str(),
                 cell(e.velocity_l2_y, 1, "%.3e").c_str());
}

void print_steadiness(std::FILE* out, const Steadiness& s) {
  std::fprintf(out, "largest speed %s of sqrt(g d_max), at the end %s; depths change by %s per second (rms), L_s of the thesis %s\n",
               cell(s.max_speed_rel, 1, "%.3e").c_str(), cell(s.end_speed_rel, 1, "%.3e").c_str(), cell(s.rate, 1, "%.2e").c_str(),
               cell(s.thesis_ls, 1, "%.2e").c_str());
}

void write(JsonWriter& out, const SolverWork& w) {
  out.begin("solver").value("passes", w.passes).value("linear_solves", w.solves).value("iterations", w.iterations);
  out.value("most_solves_in_a_pass", w.most_solves).value("unsettled_passes", w.unsettled).end();
}

}  // namespace

std::string json(const Summary& s) {
  JsonWriter out;
  out.begin().value("case", s.scene_case).value("method", s.method).value("version", s.version);
  out.value("backend", s.backend).value("registers", s.registers).value("threads", s.threads);
  out.begin("particles").value("initial", s.initial_particles).value("final", s.final_particles).end();
  out.value("steps", s.steps).value("list_rebuilds", s.list_rebuilds).value("simulated_s", s.simulated);
  out.value("wall_s", s.wall).value("particle_steps_per_s", s.particle_steps_per_s);
  if (s.solver.passes > 0) write(out, s.solver);
  write(out, s.mass);
  write(out, s.energy);
  out.array("warnings");
  for (const auto& warning : s.warnings) out.value("", warning);
  out.end_array().begin("gauges");
  for (const auto& gauge : s.gauges) write(out, gauge);
  out.end().begin("runup");
  for (const auto& run_up : s.run_ups) out.value(run_up.name, run_up.highest);
  out.end().begin("waterline");
  for (const auto& run_up : s.run_ups) out.value(run_up.name, run_up.waterline);
  out.end();
  if (!s.profiles.empty()) {
    out.begin("profiles");
    for (const auto& profile : s.profiles) write(out, profile);
    out.end();
  }
  if (s.compared) {
    write(out.begin("errors"), s.errors);
    out.end();
  }
  if (!s.errors_at.empty()) write(out, s.errors_at);
  if (s.watched) write(out, s.steady);
  return out.end().text() + "\n";
}

void print_tables(std::FILE* out, const Summary& s) {
  if (!s.gauges.empty()) print_gauges(out, s.gauges);
  if (!s.run_ups.empty()) print_run_ups(out, s.run_ups);
  if (!s.profiles.empty()) print_profiles(out, s.profiles);
  if (s.compared) print_errors(out, s.errors);
  if (!s.errors_at.empty()) print_errors_at(out, s.errors_at);
  if (s.watched) print_steadiness(out, s.steady);
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
