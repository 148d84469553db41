// summary.json and the tables at the end of a run. SI units; NaN = not known (null in the file).
#pragma once
#include <cstdio>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace freshet {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

struct GaugeResult {
  std::string name;
  double rmse = unknown, max_abs_error = unknown;      // m, over the measured times that lie in the run
  double rmse_window = unknown;                        // m, the same over the window of the main wave
  std::pair<double, double> window{unknown, unknown};  // s
  double peak = unknown, peak_time = unknown;          // m, s, after Gauge::peak_after
  double measured_peak = unknown, measured_peak_time = unknown;  // m, s
  double arrival = unknown, measured_arrival = unknown;          // s, first crossing of Gauge::arrival_level
  double dry = 0;                                                // fraction of the rows
};

struct RunUpResult {
  std::string name;
  double highest = unknown, waterline = unknown;         // m, of kernels/water/wet_levels.hpp bed and line; unknown: nothing was wet
  std::pair<double, double> measured{unknown, unknown};  // m, lowest and highest
};

struct ProfileResult {
  std::string name;
  double time = unknown;                               // s
  double rmse = unknown, max_abs_error = unknown;      // m, over the measured points on the line
  double measured_range = unknown;                     // m, highest less lowest of them
  int points = 0;
};

struct ErrorNorms {
  double depth_l1_rel = unknown, depth_l2_rel = unknown, grid_l2_rel = unknown;
  double depth_linf = unknown;         // m
  double velocity_l2 = unknown;        // m/s
  double depth_l2_mean_rel = unknown;  // thesis (2.58): rms of (d - d_e) / d_e
  double velocity_l2_x = unknown, velocity_l2_y = unknown;  // thesis (2.59): rms of (v_k - v_k,e) / sqrt(g d_e)
};

// Every norm under its name in summary.json.
struct NormName {
  const char* key;
  double ErrorNorms::*value;
};
inline constexpr NormName norm_names[] = {
    {"depth_l1_rel", &ErrorNorms::depth_l1_rel},   {"depth_l2_rel", &ErrorNorms::depth_l2_rel},
    {"depth_linf", &ErrorNorms::depth_linf},       {"velocity_l2", &ErrorNorms::velocity_l2},
    {"grid_l2_rel", &ErrorNorms::grid_l2_rel},     {"depth_l2_mean_rel", &ErrorNorms::depth_l2_mean_rel},
    {"velocity_l2_x", &ErrorNorms::velocity_l2_x}, {"velocity_l2_y", &ErrorNorms::velocity_l2_y}};

struct ErrorsAt {
  double t = 0;  // s
  ErrorNorms errors;
};

// How still a steady flow stands.
struct Steadiness {
  double max_speed_rel = unknown;   // largest speed of any particle at any step / sqrt(g d_max), d_max of the start
  double end_speed_rel = unknown;   // the same at the end alone
  double rate = unknown;            // 1/s, rms over the particles of the relative change of depth at the end
  double thesis_ls = unknown;       // the same as thesis (1.12), a sum over N particles of one step: sqrt(N) rate dt
};

struct MassBalance {
  double initial = unknown, inflow = 0, outflow = 0, final = unknown;  // m3
  double relative_error = unknown;  // |final - initial - inflow + outflow| / initial
  double flux_error =
      unknown;  // |inflow - outflow - straddle - flux| / gross flux; unknown without open boundaries
};

// Per unit density of water; see Mechanics in src/method.hpp.
struct EnergyBalance {
  double kinetic_start = unknown, potential_start = unknown, kinetic_end = unknown, potential_end = unknown;  // m5/s2
  std::pair<double, double> momentum_start{unknown, unknown}, momentum_end{unknown, unknown};                 // m4/s
};

// Work of an implicit method; no passes = an explicit one.
struct SolverWork {
  long passes = 0, solves = 0, iterations = 0, unsettled = 0;  // for the surface, linear, theirs, without convergence
  int most_solves = 0;                                         // in one pass
};

struct Summary {
  std::string scene_case, method, backend, registers, version;
  int threads = 0;
  int initial_particles = 0, final_particles = 0;
  long steps = 0, list_rebuilds = 0;
  double simulated = 0, wall = 0;  // s, without comparisons with an exact solution
  double particle_steps_per_s = 0;
  SolverWork solver;
  MassBalance mass;
  EnergyBalance energy;
  std::vector<std::string> warnings;  // what the run noticed about itself
  std::vector<GaugeResult> gauges;
  std::vector<RunUpResult> run_ups;
  std::vector<ProfileResult> profiles;
  bool compared = false;  // the scene names an exact solution
  ErrorNorms errors;
  std::vector<ErrorsAt> errors_at;  // at the times that [compare] names
  bool watched = false;             // [compare] steady
  Steadiness steady;
};

std::string json(const Summary& summary);
void print_tables(std::FILE* out, const Summary& summary);

}  // namespace freshet
