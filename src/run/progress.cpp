#include "src/run/progress.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace freshet {
namespace {

constexpr double pause = 0.2;  // s between lines on a terminal

std::string duration(double seconds) {
  char text[32];
  const long s = std::lround(std::min(seconds, 3.6e8));
  if (s < 3600) std::snprintf(text, sizeof text, "%ld:%02ld", s / 60, s % 60);
  else std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
  return text;
}

double percent(double t, double end) { return end > 0 ? 100 * t / end : 100; }

}  // namespace

Progress::Progress(std::FILE* out, bool terminal, double start, double end)
    : out_(out), terminal_(terminal), start_(start), end_(end) {
  while (next_percent_ <= percent(start, end)) next_percent_ += 10;
}

double Progress::elapsed() const { return std::chrono::duration<double>(Time::now() - begun_).count(); }

bool Progress::due(double t) const {
  if (!out_) return false;
  if (!terminal_) return percent(t, end_) >= next_percent_;
  return last_ < 0 || elapsed() - last_ >= pause || t >= end_;
}

void Progress::show(const ProgressState& state) {
  last_ = elapsed();
  while (next_percent_ <= percent(state.clock.t, end_)) next_percent_ += 10;
  const double done = state.clock.t - start_;
  const double left = done > 0 ? last_ * (end_ - state.clock.t) / done : 0;
  std::fprintf(out_, "%s%5.1f %%  t %.6g s  dt %.3g s  step %ld  %d particles  %.2f M particle-steps/s  mass error %.1e"
               "  %s left%s", terminal_ ? "\r" : "", percent(state.clock.t, end_), state.clock.t, state.dt,
               state.clock.step, state.particles, particle_steps_ / std::max(last_, 1e-9) / 1e6, state.mass_error,
               duration(left).c_str(), terminal_ ? "\033[K" : "\n");
  std::fflush(out_);
  shown_ = true;
}

void Progress::end_line() {
  if (out_ && terminal_ && shown_) std::fputc('\n', out_);
  shown_ = false;
}

}  // namespace freshet
