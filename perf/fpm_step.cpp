// perf_fpm_step SCENE STEPS [key=value ...]: runs an incompressible scene for some steps after two that warm
// up and prints, per step and point, the time of every launch by its label, the split in points, stencils
// (with lists and prediction) and pressure, and iterations.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "cellgrid/parallel/runtime.hpp"
#include "src/methods/fpm/solver.hpp"
#include "src/scene/read.hpp"

namespace {

using namespace freshet;
using Clock = std::chrono::steady_clock;

std::map<std::string, double> spent;  // s, by label, and by the innermost region outside of launches
std::vector<std::string> regions;
std::string label;
Clock::time_point begun, marked;

double since(Clock::time_point t) { return std::chrono::duration<double>(Clock::now() - t).count(); }

void begin(const char* name, const uint32_t, uint64_t*) {
  label = name;
  begun = Clock::now();
}
void end(const uint64_t) { spent[(regions.empty() ? "" : regions.front() + "/") + label] += since(begun); }

void watch() {
  namespace tools = Kokkos::Tools::Experimental;
  tools::set_begin_parallel_for_callback(begin);
  tools::set_begin_parallel_reduce_callback(begin);
  tools::set_begin_parallel_scan_callback(begin);
  tools::set_end_parallel_for_callback(end);
  tools::set_end_parallel_reduce_callback(end);
  tools::set_end_parallel_scan_callback(end);
  tools::set_push_region_callback([](const char* name) {
    if (regions.empty()) marked = Clock::now();
    regions.push_back(name);
  });
  tools::set_pop_region_callback([] {
    if (regions.size() == 1) spent["total of " + regions.front()] += since(marked);
    regions.pop_back();
  });
}

void run(const std::string& file, int steps, const std::vector<std::string>& overrides) {
  const Scene scene = read_scene(file, overrides);
  fpm::FinitePointset solver(scene);
  for (int k = 0; k < 2; ++k) solver.step(0, solver.stable_dt());
  watch();
  long iterations = 0;
  double points = 0;
  const Clock::time_point start = Clock::now();
  for (int k = 0; k < steps; ++k) {
    solver.step(0, solver.stable_dt());
    iterations += solver.pressure_report().solve.iterations;
    points += solver.fields().size();
  }
  const double total = since(start);
  std::printf("%d points, %d threads: %.4g s per step, %.3f us per point and step, %.1f iterations\n",
              solver.fields().size(), thread_count(), total / steps, 1e6 * total / points,
              static_cast<double>(iterations) / steps);
  for (const auto& [name, seconds] : spent)
    std::printf("%8.4f us  %5.1f %%  %s\n", 1e6 * seconds / points, 100 * seconds / total, name.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return std::fprintf(stderr, "usage: perf_fpm_step SCENE STEPS [key=value ...]\n"), 2;
  const char* threads = std::getenv("OMP_NUM_THREADS");
  const Runtime runtime(threads ? std::atoi(threads) : 0);
  run(argv[1], std::atoi(argv[2]), std::vector<std::string>(argv + 3, argv + argc));
}
