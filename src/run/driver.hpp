// The time loop of one run, and everything that happens around a step. Results go to one directory.
#pragma once
#include <atomic>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "src/errors.hpp"
#include "src/io/h5part.hpp"
#include "src/io/summary.hpp"
#include "src/run/monitor.hpp"
#include "src/run/profiles.hpp"
#include "src/run/progress.hpp"
#include "src/run/rasters.hpp"
#include "src/run/stations.hpp"
#include "src/run/steady.hpp"
#include "src/run/strain.hpp"

namespace freshet {

struct RunOptions {
  std::string directory;                    // exists
  std::FILE* progress = nullptr;            // nullptr: no progress lines
  bool terminal = false;                    // progress goes to a terminal
  const std::atomic<bool>* stop = nullptr;  // finish the step and leave when it becomes true
  std::function<void(const Clock&)> each_step = {};  // called after every step and what it brought
};

class Driver {
 public:
  // Keeps references to the scene and the method.
  Driver(const Scene& scene, Method& method, RunOptions options);
  ~Driver();

  void begin();                                // a new run: files, first output, mass at the start
  void restore(const Checkpoint& checkpoint);  // goes on; the method has its fields and scalars already
  // To the end of the scene (true) or until the stop flag (false); the state is written either way. If the
  // run diverges the state goes to diverged.h5, the last good state.h5 stays, and Diverged is thrown.
  bool run();
  const Clock& clock() const { return clock_; }
  Summary summary() const;
  const std::vector<GaugeRow>& gauge_rows() const { return gauges_.rows(); }

 private:
  void step();
  void observe();
  void check();
  void compare();
  void fire_events();
  void write_particles();
  void write_state(const std::string& name);
  [[noreturn]] void give_up(const Diverged& why);
  void show_progress();
  Values run_values() const;
  MassBalance mass_balance() const;
  EnergyBalance energy_balance() const;
  std::vector<std::string> warnings() const;
  std::vector<GaugeResult> gauge_results() const;
  std::vector<RunUpResult> run_up_results() const;
  ErrorNorms errors() const;
  double wall() const { return earlier_wall_ + progress_.elapsed() - comparing_; }

  const Scene& scene_;
  Method& method_;
  RunOptions options_;
  Clock clock_;
  Events events_;
  Monitor monitor_;
  GaugeRecorder gauges_;
  RunUpRecorder run_ups_;
  ProfileRecorder profiles_;
  SteadyRecorder steady_;
  RasterRecorder rasters_;
  Strain strain_;
  EnergyWatch energy_watch_;
  ParticleFile particles_;
  Progress progress_;
  std::vector<double> l1_samples_;  // depth_l1_rel at the comparison times
  std::vector<ErrorsAt> errors_at_;
  double dt_ = 0;                   // s, of the last step
  int initial_particles_ = 0;
  Mechanics initial_mechanics_;
  double comparing_ = 0;            // s, spent on the exact solution: no part of the run
  double earlier_wall_ = 0, earlier_particle_steps_ = 0;  // of the processes before a resume
  double last_checkpoint_ = 0;                            // s, progress_.elapsed() then
};

}  // namespace freshet
