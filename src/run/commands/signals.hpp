// SIGINT and SIGTERM ask the run to stop after the step at hand. One that comes more than a second after the
// first ends the program at once; sooner ones are echoes (timeout(1) and batch systems signal a process and
// then its group).
#pragma once
#include <atomic>
#include <csignal>

namespace freshet {

extern std::atomic<bool> stop_requested;  // set by the handler, cleared by SignalGuard

// Installs the handlers for the length of a scope.
class SignalGuard {
 public:
  SignalGuard();
  ~SignalGuard();
  SignalGuard(const SignalGuard&) = delete;
  SignalGuard& operator=(const SignalGuard&) = delete;

 private:
  struct sigaction interrupt_, terminate_;  // what was installed before
};

}  // namespace freshet
