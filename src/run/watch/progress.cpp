#include "src/run/watch/progress.hpp"

#include <sys/ioctl.h>

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

int columns(std::FILE* terminal) {
  winsize size{};
  return ioctl(fileno(terminal), TIOCGWINSZ, &size) == 0 && size.ws_col > 1 ? size.ws_col : 80;
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

void Progress::show(const Clock& clock, int particles, double mass_error) {
  last_ = elapsed();
  while (next_percent_ <= percent(clock.t, end_)) next_percent_ += 10;
  const double done = clock.t - start_;
  const double left = done > 0 ? last_ * (end_ - clock.t) / done : 0;
  char line[256];
  std::snprintf(line, sizeof line,
                "%5.1f %%  %s left  t %.6g s  dt %.3g s  step %ld  %d particles  mass error %.0e  "
                "%.2f M particle-steps/s",
                percent(clock.t, end_), duration(left).c_str(), clock.t, clock.dt, clock.step, particles,
                mass_error, particle_steps_ / std::max(last_, 1e-9) / 1e6);
  // A line that wraps could not be rewritten in place.
  if (terminal_) std::fprintf(out_, "\r%.*s\033[K", columns(out_) - 1, line);
  else std::fprintf(out_, "%s\n", line);
  std::fflush(out_);
  shown_ = true;
}

void Progress::end_line() {
  if (out_ && terminal_ && shown_) std::fputc('\n', out_);
  shown_ = false;
}

}  // namespace freshet
