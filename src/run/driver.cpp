#include "src/run/driver.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "cellgrid/parallel/runtime.hpp"
#include "src/io/build.hpp"
#include "src/io/files.hpp"
#include "src/io/fluid.hpp"
#include "src/run/watch/monitor.hpp"

namespace freshet {
namespace {

constexpr const char *state_file = "state.h5", *diverged_file = "diverged.h5";

}  // namespace

Driver::Driver(const Scene& scene, Method& method, RunOptions options)
    : scene_(scene), method_(method), options_(std::move(options)),
      observers_(make_observers(scene, options_.directory)),
      progress_(options_.progress, options_.terminal, 0, scene.end_time) {}

std::vector<std::string> Driver::files() {
  auto all = observed_files();
  all.insert(all.end(), {state_file, diverged_file});
  return all;
}

void Driver::begin() {
  for (const auto& one : observers_) one->begin(method_);
}

bool Driver::run() {
  try {
    take();  // at t = 0; after a resume nothing is due
    while (!finished()) {
      if (options_.stop && *options_.stop) break;
      step();
      observe();
      take();
      if (progress_.due(clock_.t)) show_progress();
      if (options_.each_step) options_.each_step(clock_);
    }
    for (const auto& one : observers_) one->finish(method_, clock_);
  } catch (const Diverged& why) { report_divergence(why); }
  write_state(state_file);
  progress_.end_line();
  return finished();
}

void Driver::step() {
  const double stable = method_.stable_dt();
  Monitor::check_dt(stable, clock_);
  double event = scene_.end_time;
  for (const auto& one : observers_) event = std::min(event, one->times.next());
  const Stride stride = stride_towards(event, clock_, stable);
  for (const auto& one : observers_) one->before_step(method_, clock_, stride);
  {
    const TimedRegion region("run::step");
    method_.step(clock_.t, stride.dt);
  }
  clock_ = {stride.until, clock_.step + 1, stride.dt};
  progress_.count(method_.fields().size());
}

void Driver::observe() {
  const TimedRegion region("run::observe");
  for (const auto& one : observers_) one->after_step(method_, clock_);
}

void Driver::take() {
  for (const auto& one : observers_) {
    if (!one->times.due(clock_.t)) continue;
    one->take(method_, clock_);
    one->times.skip_past(clock_.t);
  }
  const bool periodic = scene_.output.checkpoint_every > 0 && !finished();
  if (periodic && progress_.elapsed() - last_checkpoint_ >= scene_.output.checkpoint_every)
    write_state(state_file);
}

void Driver::write_state(const std::string& name) {
  const TimedRegion region("run::output");
  const std::string scene_file = scene_.file.empty() ? "" : std::filesystem::absolute(scene_.file).string();
  write_checkpoint(path_in(options_.directory, name),
                   {scene_file, scene_.text, run_values(), method_.scalars()}, method_.fields());
  last_checkpoint_ = progress_.elapsed();
}

void Driver::report_divergence(const Diverged& why) {
  progress_.end_line();
  std::string text = why.what();
  try {
    for (const auto& one : observers_) one->diverged(method_, clock_);
    write_state(diverged_file);
    text += "\n  its state: " + path_in(options_.directory, diverged_file) +
            ", and the last step of particles.h5part";
  } catch (const IoError& also) { text += "\n  its state could not be written: " + std::string(also.what()); }
  throw Diverged(text);
}

void Driver::show_progress() {
  const MassBalance mass = find<Monitor>(observers_)->balance(method_.totals());
  progress_.show(clock_, method_.fields().size(), mass.relative_error);
}

double Driver::wall() const {
  double seconds = earlier_wall_ + progress_.elapsed();
  for (const auto& one : observers_) seconds -= one->seconds_apart();
  return seconds;
}

Values Driver::run_values() const {
  Values values;
  values["clock"] = {clock_.t, static_cast<double>(clock_.step)};
  values["dt"] = {clock_.dt};
  values["effort"] = {wall(), particle_steps()};
  for (const auto& one : observers_) one->save(values);
  return values;
}

void Driver::restore(const Checkpoint& checkpoint) {
  const Values& run = checkpoint.run;
  look_at_checkpoint(path_in(options_.directory, state_file), [&] {
    clock_ = {run.at("clock").at(0), std::lround(run.at("clock").at(1)), run.at("dt").at(0)};
    earlier_wall_ = run.at("effort").at(0);
    earlier_particle_steps_ = run.at("effort").at(1);
    for (const auto& one : observers_) {
      one->times.skip_past(clock_.t);
      one->restore(run, clock_);
    }
  });
  progress_ = Progress(options_.progress, options_.terminal, clock_.t, scene_.end_time);
}

Summary Driver::summary() const {
  Summary s;
  s.scene_case = scene_.name;
  s.method = method_.name();
  s.backend = backend_name();
  s.registers = registers_name();
  s.version = build::version;
  s.threads = thread_count();
  s.initial_particles = find<Monitor>(observers_)->initial_particles();
  s.final_particles = fluid_count(method_.fields());
  s.steps = clock_.step;
  s.last = method_.report();
  s.simulated = clock_.t;
  s.wall = wall();
  s.particle_steps_per_s = particle_steps() / std::max(s.wall, 1e-9);
  for (const auto& one : observers_) one->report(method_, clock_, s.report);
  for (const auto& line : method_.notes()) s.report.warnings.push_back(line);
  return s;
}

}  // namespace freshet
