#include "src/run/summary.hpp"

namespace freshet {
namespace {

// Work of an implicit method; no passes = an explicit one.
void write_solver(JsonWriter& out, const StepReport& w) {
  if (w.passes == 0) return;
  out.begin("solver")
      .value("passes", w.passes)
      .value("linear_solves", w.solves)
      .value("iterations", w.iterations);
  out.value("most_solves_in_a_pass", w.newton_max).value("unsettled_passes", w.unsettled).end();
}

}  // namespace

std::string json(const Summary& s) {
  JsonWriter out;
  out.begin().value("case", s.scene_case).value("method", s.method).value("version", s.version);
  out.value("backend", s.backend).value("registers", s.registers).value("threads", s.threads);
  out.begin("particles").value("initial", s.initial_particles).value("final", s.final_particles).end();
  out.value("steps", s.steps).value("list_rebuilds", s.last.rebuilds).value("simulated_s", s.simulated);
  out.value("wall_s", s.wall).value("particle_steps_per_s", s.particle_steps_per_s);
  write_solver(out, s.last);
  return out.members(s.report.members()).end().text() + "\n";
}

void print_tables(std::FILE* out, const Summary& s) {
  std::fprintf(out,
               "%s\n%ld steps, %d particles, %.2f s of water in %.2f s: %.2f M particle-steps/s on %d "
               "thread%s (%s)\n%s",
               s.report.tables.c_str(), s.steps, s.final_particles, s.simulated, s.wall,
               s.particle_steps_per_s / 1e6, s.threads, s.threads == 1 ? "" : "s", s.backend.c_str(),
               s.report.balance.c_str());
  for (const auto& warning : s.report.warnings) std::fprintf(out, "warning: %s\n", warning.c_str());
}

}  // namespace freshet
