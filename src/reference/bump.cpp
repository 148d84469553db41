#include "src/reference/bump.hpp"

#include <algorithm>
#include <cmath>

namespace freshet {
namespace {

// The root of a function that is negative at low and positive at high.
template <class F>
double root_between(double low, double high, const F& f) {
  for (int n = 0; n < 200; ++n) {
    const double middle = 0.5 * (low + high);
    (f(middle) < 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double critical_depth(double discharge, double gravity) { return std::cbrt(discharge * discharge / gravity); }

}  // namespace

double Bump::level(double x) const {
  const double r = (x - centre) / half_width;
  return std::max(0.0, height * (1 - r * r));
}

SteadyBumpFlow::SteadyBumpFlow(const Bump& bump, const BumpFlow& flow, double gravity)
    : bump_(bump), gravity_(gravity), supercritical_(flow.inflow_depth.has_value()) {
  const double u = flow.velocity, velocity_head = u * u / (2 * gravity);
  double inflow = flow.inflow_depth.value_or(0);
  if (!supercritical_)  // the depth whose energy is just enough for the crest
    inflow = root_between(u * u / gravity, 100 * (bump.height + u * u / gravity), [&](double d) {
      return d + velocity_head - bump.height - 1.5 * critical_depth(u * d, gravity);
    });
  discharge_ = u * inflow;
  head_ = inflow + velocity_head;
  if (!flow.outflow_depth) return;
  head_behind_ = *flow.outflow_depth + std::pow(discharge_ / *flow.outflow_depth, 2) / (2 * gravity);
  find_jump();
}

// m: d + q^2/(2 g d^2) = head - b. Newton falls on to either root from outside; below the critical energy
// both are critical.
double SteadyBumpFlow::depth(double x, double head, bool supercritical) const {
  const double critical = critical_depth(discharge_, gravity_), energy = head - bump_.level(x);
  if (energy <= 1.5 * critical * (1 + 1e-12)) return critical;
  const double k = discharge_ * discharge_ / (2 * gravity_);
  double d = supercritical ? std::sqrt(k / energy) : energy;
  for (int n = 0; n < 100; ++n) d -= (d + k / (d * d) - energy) / (1 - 2 * k / (d * d * d));
  return d;
}

// m2: what a jump keeps.
double SteadyBumpFlow::momentum(double depth) const {
  return discharge_ * discharge_ / (gravity_ * depth) + 0.5 * depth * depth;
}

void SteadyBumpFlow::find_jump() {
  const auto excess = [&](double x) {
    return momentum(depth(x, head_behind_, false)) - momentum(depth(x, head_, true));
  };
  const double foot = bump_.centre + bump_.half_width;
  if (head_behind_ >= head_ || excess(foot) <= 0) return;  // drowned, or swept off the bump
  // The subcritical side exists where its energy reaches over the bed.
  const double critical_energy = 1.5 * critical_depth(discharge_, gravity_);
  const double first = head_behind_ - bump_.height >= critical_energy
                           ? bump_.centre
                           : root_between(bump_.centre, foot, [&](double x) {
                               return head_behind_ - bump_.level(x) - critical_energy;
                             });
  jump_ = root_between(first, foot, excess);
}

FlowState SteadyBumpFlow::at(double x, double, double) const {
  const bool behind = jump_ && x > *jump_;
  const bool fast = !behind && (supercritical_ || x > bump_.centre);
  const double d = depth(x, behind ? head_behind_ : head_, fast);
  return {d, discharge_ / d, 0};
}

}  // namespace freshet
