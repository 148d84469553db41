#include "src/run/commands/signals.hpp"

#include <ctime>

namespace freshet {

std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

namespace {

std::atomic<long> first_at{0};  // s
static_assert(std::atomic<long>::is_always_lock_free);

long seconds() {  // clock_gettime is among the calls that a handler may make
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<long>(now.tv_sec);
}

void ask_to_stop(int signal) {
  if (!stop_requested.exchange(true)) {
    first_at = seconds();
  } else if (seconds() - first_at > 1) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

}  // namespace

SignalGuard::SignalGuard() {
  stop_requested = false;
  struct sigaction action {};
  action.sa_handler = ask_to_stop;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, &interrupt_);
  sigaction(SIGTERM, &action, &terminate_);
}

SignalGuard::~SignalGuard() {
  sigaction(SIGINT, &interrupt_, nullptr);
  sigaction(SIGTERM, &terminate_, nullptr);
}

}  // namespace freshet
