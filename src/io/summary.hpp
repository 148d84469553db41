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
  double highest = unknown;                              // m; unknown: nothing was wet
  std::pair<double, double> measured{unknown, unknown};  // m, lowest and highest
};

struct ErrorNorms {
  double depth_l1_rel = unknown, depth_l2_rel = unknown, grid_l2_rel = unknown;
  double depth_linf = unknown;   // m
  double velocity_l2 = unknown;  // m/s
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

struct Summary {
  std::string scene_case, method, backend, version;
  int threads = 0;
  int initial_particles = 0, final_particles = 0;
  long steps = 0, list_rebuilds = 0;
  double simulated = 0, wall = 0;  // s
  double particle_steps_per_s = 0;
  MassBalance mass;
  EnergyBalance energy;
  std::vector<std::string> warnings;  // what the run noticed about itself
  std::vector<GaugeResult> gauges;
  std::vector<RunUpResult> run_ups;
  bool compared = false;  // the scene names an exact solution
  ErrorNorms errors;
};

std::string json(const Summary& summary);
void print_tables(std::FILE* out, const Summary& summary);

}  // namespace freshet
