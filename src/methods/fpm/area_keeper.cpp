#include "src/methods/fpm/area_keeper.hpp"

#include <cmath>
#include <cstdio>

namespace freshet::fpm {

void AreaKeeper::look(double area, double dt) {
  const double off = start_ > 0 ? area / start_ - 1 : 0, beyond = std::abs(off) - band;
  rate_ = beyond > 0 ? (off > 0 ? -beyond : beyond) / (steps * dt) : 0;
  if (rate_ != 0 && first_ < 0) first_ = t_;
}

void AreaKeeper::pass(double dt) {
  (rate_ < 0 ? shrunk_ : grown_) += std::abs(rate_) * dt;
  t_ += dt;
  ++count_;
}

std::vector<std::string> AreaKeeper::notes() const {
  if (first_ < 0) return {};
  char text[400];
  std::snprintf(text, sizeof text,
                "water closed over air or ran into threads: %.2g %% of its area was taken off again and %.2g "
                "%% put on, spread over all of it, first at "
                "t = %.6g s\n  help: a finer water.spacing leaves less to give back",
                100 * shrunk_, 100 * grown_, first_);
  return {text};
}

void AreaKeeper::restore(const std::vector<double>& state) {
  start_ = state.at(0), rate_ = state.at(1), count_ = std::lround(state.at(2));
  shrunk_ = state.at(3), grown_ = state.at(4), first_ = state.at(5), t_ = state.at(6);
}

}  // namespace freshet::fpm
