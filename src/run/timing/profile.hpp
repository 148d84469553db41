// Where the time of a run goes: by launch and by part of the loop, and how near each launch comes to the
// machine's limits.
#pragma once
#include <string>
#include <vector>

#include "cellgrid/parallel/work.hpp"
#include "src/run/driver.hpp"
#include "src/run/timing/peaks.hpp"

namespace freshet {

struct PassProfile {
  std::string label;
  long calls = 0;
  double seconds = 0;
  Work work;  // of all calls; zero where the method does not model it
};

struct RunProfile {
  std::string scene, method, backend, registers;
  // what to do for wider registers, where the machine has them (cellgrid/parallel/runtime.hpp)
  std::string better;
  int threads = 0;
  long first_step = 0, steps = 0;
  double particle_steps = 0;
  double wall = 0, simulated = 0;  // s, of these steps
  // Explicit SPH: density evaluations per cluster, and how often neighbour lists were made again.
  double newton_mean = 0;
  int newton_max = 0;
  long rebuilds = 0;
  // The implicit methods, all steps: passes for the surface, linear solves in them, iterations of those or of
  // the pressure's.
  double surface_passes = 0, solves = 0, iterations = 0;
  double launched = 0;                                                                  // s, inside launches
  double step = 0, launched_in_step = 0, sort = 0, observe = 0, check = 0, output = 0;  // s
  double per_output = 0;    // s, one output of particles
  double output_every = 0;  // s of simulated time; 0 = none in the run
  Peaks peaks;
  std::vector<PassProfile> passes;  // longest first

  double of_wall(double seconds) const { return wall > 0 ? seconds / wall : 0; }
  // Share of the particles' output in a whole run, at the scene's interval.
  double output_share() const;
};

// Runs the scene for `steps` steps after some twenty that are not counted (fewer where the scene ends
// before); results go to the directory. Uses Kokkos' tool callbacks.
RunProfile profile_run(const Scene& scene, Method& method, const std::string& directory, int steps);

std::string table(const RunProfile& profile);
std::string json(const RunProfile& profile);

}  // namespace freshet
