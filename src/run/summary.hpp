// summary.json and the tables at the end of a run. SI units; NaN = not known (null in the file).
#pragma once
#include <cstdio>
#include <string>

#include "src/methods/method.hpp"
#include "src/run/observe/report.hpp"

namespace freshet {

struct Summary {
  std::string scene_case, method, backend, registers, version;
  int threads = 0;
  int initial_particles = 0, final_particles = 0;
  long steps = 0;
  StepReport last;                 // of the last step
  double simulated = 0, wall = 0;  // s, without comparisons with an exact solution
  double particle_steps_per_s = 0;
  Report report;  // of the observers
};

std::string json(const Summary& summary);
void print_tables(std::FILE* out, const Summary& summary);

}  // namespace freshet
