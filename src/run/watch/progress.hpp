// The progress line: %, t, dt, step, particles, particle-steps per second, mass error, time left. On a
// terminal it is rewritten in place at most five times a second, elsewhere a plain line appears at every 10
// %.
#pragma once
#include <chrono>
#include <cstdio>

#include "src/run/observe/events.hpp"

namespace freshet {

class Progress {
 public:
  // out = nullptr prints nothing. start: the simulated time at which this process begins or goes on [s].
  Progress(std::FILE* out, bool terminal, double start, double end);

  void count(int particles) { particle_steps_ += particles; }       // once per step
  bool due(double t) const;                                         // asks the clock; cheap
  void show(const Clock& clock, int particles, double mass_error);  // relative
  void end_line();  // leaves the line on the terminal as it is

  double elapsed() const;                                    // s of wall clock since construction
  double particle_steps() const { return particle_steps_; }  // of this process

 private:
  using Time = std::chrono::steady_clock;

  std::FILE* out_;
  bool terminal_, shown_ = false;
  double start_, end_;  // s
  double particle_steps_ = 0;
  double next_percent_ = 10;
  double last_ = -1;  // s, elapsed() at the last line
  Time::time_point begun_ = Time::now();
};

}  // namespace freshet
