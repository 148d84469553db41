#include "src/run/timing/profile.hpp"

#include <algorithm>
#include <map>

#include "cellgrid/parallel/runtime.hpp"
#include "src/run/timing/launch_times.hpp"

namespace freshet {
namespace {

constexpr long warm_up = 20;  // steps: fields have grown, the first lists are made

using Works = std::map<std::string, Work>;

Work scaled(const Work& w, double s) {
  return {s * w.particles, s * w.pairs, s * w.listed, s * w.flops, s * w.bytes};
}
Work sum(const Work& a, const Work& b) {
  return {a.particles + b.particles, a.pairs + b.pairs, a.listed + b.listed, a.flops + b.flops,
          a.bytes + b.bytes};
}

Works mean(const Works& a, const Works& b) {
  Works m;
  for (const auto& [label, work] : a)
    if (const auto other = b.find(label); other != b.end()) m[label] = scaled(sum(work, other->second), 0.5);
  return m;
}

std::vector<PassProfile> passes_of(const LaunchTimes::Spans& launches, const Works& works) {
  std::vector<PassProfile> passes;
  for (const auto& [label, span] : launches) {
    passes.push_back({label, span.calls, span.seconds, {}});
    if (const auto work = works.find(label); work != works.end())
      passes.back().work = scaled(work->second, static_cast<double>(span.calls));
  }
  std::sort(passes.begin(), passes.end(), [](const auto& a, const auto& b) { return a.seconds > b.seconds; });
  return passes;
}

// Watches a run step by step; everything between first and last step is counted.
class Watch {
 public:
  Watch(const Method& method, long steps, std::atomic<bool>& stop)
      : method_(method), steps_(steps), stop_(stop) {}

  void operator()(const Clock& clock) {
    if (!begun_ && clock.step >= warm_up) return begin(clock);
    if (!begun_ || stop_) return;
    count(clock);
    if (profile_.steps == steps_) stop_ = true;
    if (stop_) end();
  }

  RunProfile finish() {
    if (!stop_) end();  // the scene was over before
    return profile_;
  }

 private:
  using Time = std::chrono::steady_clock;

  void begin(const Clock& clock) {
    begun_ = true;
    at_start_ = method_.work();
    if (const auto& out = times_.regions(); out.count("run::output"))
      profile_.per_output = out.at("run::output").seconds / static_cast<double>(out.at("run::output").calls);
    profile_.first_step = clock.step;
    before_ = method_.report();
    t_ = clock.t;
    times_.clear();
    start_ = Time::now();
  }

  void count(const Clock& clock) {
    const StepReport report = method_.report();
    ++profile_.steps;
    profile_.particle_steps += method_.fields().size();
    profile_.newton_mean += report.newton_mean;
    profile_.newton_max = std::max(profile_.newton_max, report.newton_max);
    profile_.rebuilds = report.rebuilds - before_.rebuilds;
    profile_.surface_passes = static_cast<double>(report.passes - before_.passes);
    profile_.solves = static_cast<double>(report.solves - before_.solves);
    profile_.iterations = static_cast<double>(report.iterations - before_.iterations);
    pressure_iterations_ += report.pressure_iterations;
    profile_.simulated = clock.t - t_;
    profile_.wall = std::chrono::duration<double>(Time::now() - start_).count();
  }

  void end() {
    profile_.iterations += static_cast<double>(pressure_iterations_);  // a method has these or those
    if (profile_.steps > 0) profile_.newton_mean /= static_cast<double>(profile_.steps);
    profile_.launched = times_.launched();
    profile_.step = times_.in("run::step");
    profile_.launched_in_step = times_.launched_in("run::step");
    profile_.sort = times_.in("cellgrid::sort");
    profile_.check = times_.in("run::check");
    profile_.observe = times_.in("run::observe") - profile_.check;
    profile_.output = times_.in("run::output");
    const LaunchTimes::Spans launches = times_.launches();  // asking for the work launches something too
    profile_.passes = passes_of(launches, mean(at_start_, method_.work()));
  }

  const Method& method_;
  long steps_;
  std::atomic<bool>& stop_;
  LaunchTimes times_;
  RunProfile profile_;
  Works at_start_;
  bool begun_ = false;
  StepReport before_;
  long pressure_iterations_ = 0;
  double t_ = 0;
  Time::time_point start_;
};

}  // namespace

double RunProfile::output_share() const {
  if (output_every <= 0 || simulated <= 0) return 0;
  const double between = wall / simulated * output_every;  // s, the other work from one output to the next
  return per_output / (per_output + between);
}

RunProfile profile_run(const Scene& scene, Method& method, const std::string& directory, int steps) {
  const Peaks peaks = measure_peaks();
  std::atomic<bool> stop{false};
  Watch watch(method, steps, stop);
  RunOptions options{directory, nullptr, false, &stop};
  options.each_step = [&watch](const Clock& clock) { watch(clock); };
  Driver driver(scene, method, options);
  driver.begin();
  driver.run();
  RunProfile profile = watch.finish();
  profile.scene = scene.name;
  profile.method = method.name();
  profile.backend = backend_name();
  profile.registers = registers_name();
  profile.better = better_registers();
  profile.threads = thread_count();
  profile.output_every = scene.output.every;
  profile.peaks = peaks;
  return profile;
}

}  // namespace freshet
