#include "src/run/driver.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>

#include "src/errors.hpp"
#include "src/io/files.hpp"
#include "src/io/fluid.hpp"
#include "src/run/build.hpp"
#include "src/run/compare.hpp"

namespace freshet {
namespace {

std::string inside(const std::string& directory, const char* name) {
  return (std::filesystem::path(directory) / name).string();
}

bool finished(const Clock& clock, const Scene& scene) { return clock.t >= scene.end_time; }

// One row for each: the time, then the norms in the order of norm_names.
std::vector<double> flat(const std::vector<ErrorsAt>& rows) {
  std::vector<double> numbers;
  for (const ErrorsAt& row : rows) {
    numbers.push_back(row.t);
    for (const NormName& norm : norm_names) numbers.push_back(row.errors.*norm.value);
  }
  return numbers;
}

std::vector<ErrorsAt> errors_from(const std::vector<double>& numbers) {
  std::vector<ErrorsAt> rows;
  for (std::size_t k = 0; k < numbers.size(); k += 1 + std::size(norm_names)) {
    rows.push_back({numbers[k], {}});
    for (std::size_t n = 0; n < std::size(norm_names); ++n) rows.back().errors.*norm_names[n].value = numbers[k + 1 + n];
  }
  return rows;
}

}  // namespace

Driver::Driver(const Scene& scene, Method& method, RunOptions options)
    : scene_(scene),
      method_(method),
      options_(std::move(options)),
      events_(scene),
      monitor_(scene),
      gauges_(scene, inside(options_.directory, "gauges.csv")),
      run_ups_(scene.run_ups),
      profiles_(scene, inside(options_.directory, "profiles.csv")),
      steady_(scene),
      rasters_(scene, options_.directory),
      particles_(inside(options_.directory, "particles.h5part"), scene.output.fields,
                 scene.fpm ? scene.water.spacing : 0),
      progress_(options_.progress, options_.terminal, 0, scene.end_time) {}

Driver::~Driver() = default;

void Driver::begin() {
  initial_particles_ = fluid_count(method_.fields());
  initial_mechanics_ = method_.mechanics();
  energy_watch_.start(initial_mechanics_);
  monitor_.start(method_.totals().mass);
  particles_.create(scene_.text, build::version, method_.fields());
  gauges_.begin(method_);
  run_ups_.record(method_);
  steady_.begin(method_);
  rasters_.begin(method_);
}

bool Driver::run() {
  try {
    fire_events();  // those at t = 0; after a resume none is due
    while (!finished(clock_, scene_)) {
      if (options_.stop && *options_.stop) break;
      step();
      check();
      observe();
      fire_events();
      if (progress_.due(clock_.t)) show_progress();
      if (options_.each_step) options_.each_step(clock_);
    }
    monitor_.check_all(method_, clock_);
    if (finished(clock_, scene_) && scene_.fpm) energy_watch_.record(method_.mechanics(), clock_);  // steps are few and long
  } catch (const Diverged& why) {
    give_up(why);
  }
  rasters_.finish();
  write_state("state.h5");
  progress_.end_line();
  return finished(clock_, scene_);
}

void Driver::step() {
  const double stable = method_.stable_dt();
  monitor_.check_dt(stable, clock_);
  const Stride stride = events_.shorten(clock_, stable, rasters_.times().next());
  gauges_.watch(method_, clock_.t, stride.until);
  {
    const Region region("run::step");
    method_.step(clock_.t, stride.dt);
  }
  clock_ = {stride.until, clock_.step + 1};
  dt_ = stride.dt;
  strain_.record(method_.report(), clock_);
  progress_.count(method_.fields().size());
}

// What looks at every step.
void Driver::observe() {
  const Region region("run::observe");
  gauges_.record(method_, clock_.t);
  run_ups_.record(method_);
  steady_.record(method_);
  rasters_.record(method_, clock_.t);
}

void Driver::check() {
  const Region region("run::check");
  monitor_.check(method_, clock_);
  if (clock_.step % 100 != 0) return;
  monitor_.check_all(method_, clock_);
  if (scene_.boundaries.empty()) energy_watch_.record(method_.mechanics(), clock_);
}

void Driver::compare() {
  const double begun = progress_.elapsed();
  for (; events_.comparisons.due(clock_.t); events_.comparisons.advance()) {
    l1_samples_.push_back(depth_l1(scene_, fluid_on_host(method_.fields()), clock_.t));
  }
  for (; events_.snapshots.due(clock_.t); events_.snapshots.advance()) {
    errors_at_.push_back({clock_.t, errors()});
  }
  comparing_ += progress_.elapsed() - begun;
}

void Driver::fire_events() {
  compare();
  for (; events_.profiles.due(clock_.t); events_.profiles.advance()) profiles_.record(method_, clock_.t);
  if (events_.outputs.due(clock_.t)) {
    monitor_.check_all(method_, clock_);
    write_particles();
  }
  if (rasters_.times().due(clock_.t)) {
    const Region region("run::output");
    rasters_.write(method_, clock_.t);
  }
  const bool periodic = scene_.output.checkpoint_every > 0 && !finished(clock_, scene_);
  if (periodic && progress_.elapsed() - last_checkpoint_ >= scene_.output.checkpoint_every)
    write_state("state.h5");
}

void Driver::write_particles() {
  const Region region("run::output");
  particles_.append(static_cast<int>(events_.outputs.done()), clock_.t, method_.fields());
  events_.outputs.advance();
}

// The other files first: a checkpoint must not count rows that are not on the disk yet.
void Driver::write_state(const std::string& name) {
  const Region region("run::output");
  if (!scene_.gauges.empty()) sync_file(inside(options_.directory, "gauges.csv"));
  sync_file(inside(options_.directory, "particles.h5part"));
  const std::string scene_file = scene_.file.empty() ? "" : std::filesystem::absolute(scene_.file).string();
  write_checkpoint(inside(options_.directory, name.c_str()),
                   {scene_file, scene_.text, run_values(), method_.scalars()}, method_.fields());
  last_checkpoint_ = progress_.elapsed();
}

void Driver::give_up(const Diverged& why) {
  progress_.end_line();
  std::string text = why.what();
  try {
    particles_.append(static_cast<int>(events_.outputs.done()), clock_.t, method_.fields());
    write_state("diverged.h5");
    text += "\n  its state: " + inside(options_.directory, "diverged.h5") +
            ", and the last step of particles.h5part";
  } catch (const IoError& also) {
    text += "\n  its state could not be written: " + std::string(also.what());
  }
  throw Diverged(text);
}

void Driver::show_progress() {
  progress_.show({clock_, dt_, method_.fields().size(), monitor_.mass_error(method_.totals())});
}

Values Driver::run_values() const {
  Values values;
  values["clock"] = {clock_.t, static_cast<double>(clock_.step)};
  values["events_done"] = {static_cast<double>(events_.outputs.done()),
                           static_cast<double>(events_.comparisons.done()),
                           static_cast<double>(events_.snapshots.done())};
  values["initial"] = {monitor_.initial_mass(), static_cast<double>(initial_particles_)};
  const Mechanics& m = initial_mechanics_;
  values["mechanics"] = {m.momentum[0], m.momentum[1], m.kinetic, m.potential};
  values["depth_l1_rel"] = l1_samples_;
  values["errors_at"] = flat(errors_at_);
  values["dt"] = {dt_};
  values["effort"] = {wall(), earlier_particle_steps_ + progress_.particle_steps()};
  strain_.save(values);
  energy_watch_.save(values);
  gauges_.save(values);
  run_ups_.save(values);
  profiles_.save(values);
  steady_.save(values);
  rasters_.save(values);
  return values;
}

void Driver::restore(const Checkpoint& checkpoint) {
  const Values& run = checkpoint.run;
  clock_ = {run.at("clock").at(0), std::lround(run.at("clock").at(1))};
  events_.outputs.skip_to(static_cast<std::size_t>(run.at("events_done").at(0)));
  events_.comparisons.skip_to(static_cast<std::size_t>(run.at("events_done").at(1)));
  events_.snapshots.skip_to(static_cast<std::size_t>(run.at("events_done").at(2)));
  monitor_.start(run.at("initial").at(0));
  initial_particles_ = static_cast<int>(run.at("initial").at(1));
  const std::vector<double>& m = run.at("mechanics");
  initial_mechanics_ = {{m.at(0), m.at(1)}, m.at(2), m.at(3)};
  l1_samples_ = run.at("depth_l1_rel");
  errors_at_ = errors_from(run.at("errors_at"));
  dt_ = run.at("dt").at(0);
  earlier_wall_ = run.at("effort").at(0);
  earlier_particle_steps_ = run.at("effort").at(1);
  strain_.restore(run);
  energy_watch_.restore(run);
  gauges_.restore(run);
  run_ups_.restore(run);
  profiles_.restore(run);
  while (events_.profiles.due(clock_.t)) events_.profiles.advance();
  steady_.restore(run);
  rasters_.restore(run);
  if (std::filesystem::exists(inside(options_.directory, "particles.h5part"))) {
    particles_.truncate(static_cast<int>(events_.outputs.done()));
  } else {
    particles_.create(scene_.text, build::version, method_.fields());
  }
  progress_ = Progress(options_.progress, options_.terminal, clock_.t, scene_.end_time);
}

}  // namespace freshet
