// The time loop of one run. What looks at the run are its observers (src/run/observers.hpp). Results go to
// one directory.
#pragma once
#include <atomic>
#include <cstdio>
#include <functional>
#include <string>

#include "src/errors.hpp"
#include "src/run/observers.hpp"
#include "src/run/summary.hpp"
#include "src/run/watch/progress.hpp"

namespace freshet {

struct RunOptions {
  std::string directory;                             // exists
  std::FILE* progress = nullptr;                     // nullptr: no progress lines
  bool terminal = false;                             // progress goes to a terminal
  const std::atomic<bool>* stop = nullptr;           // finish the step and leave when it becomes true
  std::function<void(const Clock&)> each_step = {};  // called after every step and what it brought
};

class Driver {
 public:
  // Keeps references to the scene and the method.
  Driver(const Scene& scene, Method& method, RunOptions options);

  // The files that a run may leave in its directory, whatever the scene; folders too.
  static std::vector<std::string> files();

  void begin();  // a new run: files, first looks
  // Goes on; the method has its fields and scalars already. IoError where the checkpoint lacks something.
  void restore(const Checkpoint& checkpoint);
  // To the end of the scene (true) or until the stop flag (false); the state is written either way. If the
  // run diverges the state goes to diverged.h5, the last good state.h5 stays, and Diverged is thrown.
  bool run();
  const Clock& clock() const { return clock_; }
  const Observers& observers() const { return observers_; }
  Summary summary() const;

 private:
  bool finished() const { return clock_.t >= scene_.end_time; }
  void step();
  void observe();
  void take();
  void write_state(const std::string& name);
  [[noreturn]] void report_divergence(const Diverged& why);
  void show_progress();
  Values run_values() const;
  double wall() const;  // s
  double particle_steps() const { return earlier_particle_steps_ + progress_.particle_steps(); }

  const Scene& scene_;
  Method& method_;
  RunOptions options_;
  Clock clock_;
  Observers observers_;
  Progress progress_;
  double earlier_wall_ = 0, earlier_particle_steps_ = 0;  // of the processes before a resume
  double last_checkpoint_ = 0;                            // s, progress_.elapsed() then
};

}  // namespace freshet
