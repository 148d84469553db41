// A profile as a table and as JSON.
#include <cmath>

#include "src/io/json.hpp"
#include "src/run/timing/profile.hpp"
#include "src/text.hpp"

namespace freshet {
namespace {

// A column of a rate; a dash where there is nothing to say.
std::string rate(double value, int width, const char* format = "%.3g") {
  const std::string number = value > 0 && std::isfinite(value) ? formatted(format, value) : "-";
  return std::string(static_cast<std::size_t>(std::max<int>(1, width - static_cast<int>(number.size()))),
                     ' ') +
         number;
}

double per(double amount, double seconds) { return seconds > 0 ? amount / seconds : 0; }

std::string row(const RunProfile& p, const PassProfile& pass) {
  const double s = pass.seconds, flops = per(pass.work.flops, s), bytes = per(pass.work.bytes, s);
  return formatted("%-26s %7ld %8.3f %5.1f %9.1f %8.2f", pass.label.c_str(), pass.calls, s,
                   100 * p.of_wall(s), 1e6 * s / static_cast<double>(pass.calls),
                   1e9 * s / p.particle_steps) +
         rate(1e-6 * per(pass.work.particles, s), 8) + rate(1e-6 * per(pass.work.pairs, s), 8) +
         rate(1e-9 * flops, 9) + rate(1e-9 * bytes, 7) +
         rate(100 * roof_fraction(flops, bytes, p.peaks), 7, "%.0f") + "\n";
}

std::string shares(const RunProfile& p) {
  std::string lines = formatted(
      "share of the wall time [%%]: step %.1f (sort %.1f; host and launch, outside kernels, %.1f), gauges "
      "and rasters "
      "%.1f, checks %.1f, output %.1f, the rest %.1f\n",
      100 * p.of_wall(p.step), 100 * p.of_wall(p.sort), 100 * p.of_wall(p.step - p.launched_in_step),
      100 * p.of_wall(p.observe), 100 * p.of_wall(p.check), 100 * p.of_wall(p.output),
      100 * p.of_wall(p.wall - p.step - p.observe - p.check - p.output));
  if (p.output_every > 0)
    lines += formatted("one output takes %.3g s: at one every %g s, %.2g %% of a run\n", p.per_output,
                       p.output_every, 100 * p.output_share());
  return lines;
}

void put_pass(JsonWriter& out, const RunProfile& p, const PassProfile& pass) {
  const double s = pass.seconds, flops = per(pass.work.flops, s), bytes = per(pass.work.bytes, s);
  out.begin()
      .value("label", pass.label)
      .value("calls", pass.calls)
      .value("seconds", s)
      .value("share", p.of_wall(s))
      .value("us_per_call", 1e6 * s / static_cast<double>(pass.calls))
      .value("ns_per_particle_step", 1e9 * s / p.particle_steps)
      .value("particles_per_s", per(pass.work.particles, s))
      .value("pairs_per_s", per(pass.work.pairs, s))
      .value("pairs_per_listed", per(pass.work.pairs, pass.work.listed))
      .value("flops_per_s", flops)
      .value("bytes_per_s", bytes)
      .value("of_roof", roof_fraction(flops, bytes, p.peaks))
      .end();
}

// What the solver of the method went through.
std::string solver(const RunProfile& p) {
  const double n = static_cast<double>(p.steps);
  if (p.newton_mean > 0)
    return formatted("density: %.2f evaluations per cluster, at most %d; lists made again %ld times\n",
                     p.newton_mean, p.newton_max, p.rebuilds);
  if (p.surface_passes > 0)
    return formatted("surface: %.2f passes, %.2f linear solves and %.1f iterations a step\n",
                     p.surface_passes / n, p.solves / n, p.iterations / n);
  return formatted("pressure: %.1f iterations a step\n", p.iterations / n);
}

}  // namespace

std::string table(const RunProfile& p) {
  std::string lines =
      formatted(
          "%s, %s: steps %ld to %ld, %.0f particles, %d thread%s (%s, %s); peaks %.1f GFLOP/s, triad %.1f "
          "GB/s\n",
          p.scene.c_str(), p.method.c_str(), p.first_step + 1, p.first_step + p.steps,
          per(p.particle_steps, static_cast<double>(p.steps)), p.threads, p.threads == 1 ? "" : "s",
          p.backend.c_str(), p.registers.c_str(), 1e-9 * p.peaks.flops, 1e-9 * p.peaks.bytes) +
      formatted("%-26s %7s %8s %5s %9s %8s %7s %7s %8s %6s %6s\n", "launch", "calls", "s", "%", "us/call",
                "ns/part.", "M p./s", "M pairs", "GFLOP/s", "GB/s", "%roof");
  if (!p.better.empty()) lines = "built for " + p.registers + ", while " + p.better + "\n" + lines;
  for (const PassProfile& pass : p.passes) lines += row(p, pass);
  lines += shares(p);
  lines += solver(p);
  lines += formatted(
      "%.3f s wall: %.3f million particle-steps/s, %.1f ns per particle-step, %.4g s per simulated second\n",
      p.wall, 1e-6 * per(p.particle_steps, p.wall), per(1e9 * p.wall, p.particle_steps),
      per(p.wall, p.simulated));
  return lines;
}

std::string json(const RunProfile& p) {
  JsonWriter out;
  out.begin().value("scene", p.scene).value("method", p.method);
  out.value("backend", p.backend).value("registers", p.registers).value("threads", p.threads);
  out.value("first_step", p.first_step)
      .value("steps", p.steps)
      .value("particles", per(p.particle_steps, static_cast<double>(p.steps)));
  out.value("wall", p.wall)
      .value("simulated", p.simulated)
      .value("particle_steps_per_s", per(p.particle_steps, p.wall));
  out.value("seconds_per_simulated_second", per(p.wall, p.simulated));
  if (p.newton_mean > 0)
    out.value("newton_mean", p.newton_mean)
        .value("newton_max", p.newton_max)
        .value("list_rebuilds", p.rebuilds);
  else
    out.begin("solver")
        .value("passes", p.surface_passes)
        .value("solves", p.solves)
        .value("iterations", p.iterations)
        .end();
  out.begin("peaks").value("flops_per_s", p.peaks.flops).value("bytes_per_s", p.peaks.bytes).end();
  out.begin("share")
      .value("launches", p.of_wall(p.launched))
      .value("step", p.of_wall(p.step))
      .value("sort", p.of_wall(p.sort));
  out.value("outside_kernels", p.of_wall(p.step - p.launched_in_step)).value("observe", p.of_wall(p.observe));
  out.value("check", p.of_wall(p.check))
      .value("output", p.of_wall(p.output))
      .value("output_in_whole_run", p.output_share())
      .end();
  out.value("seconds_per_output", p.per_output).array("launches");
  for (const PassProfile& pass : p.passes) put_pass(out, p, pass);
  out.end_array().end();
  return out.text() + "\n";
}

}  // namespace freshet
