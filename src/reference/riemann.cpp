#include "src/reference/riemann.hpp"

#include <algorithm>
#include <cmath>

namespace freshet {
namespace {

// What a wave to depth h adds to the velocity of the state beside it, and its derivative (Toro 5.2).
struct Jump {
  double value, slope;
};
Jump jump_to(double h, const RiemannState& beside, double g) {
  const double h0 = beside.depth;
  if (h <= h0) return {2 * (std::sqrt(g * h) - std::sqrt(g * h0)), std::sqrt(g / h)};
  const double q = std::sqrt(0.5 * g * (h + h0) / (h * h0));
  return {(h - h0) * q, q - g * (h - h0) / (4 * h * h * q)};
}

// The wave on the left; one on the right is its mirror image. s: place / time.
FlowState left_wave(double s, const RiemannState& left, const RiemannMiddle& middle, double g) {
  const double c = std::sqrt(g * left.depth);
  if (middle.depth > left.depth) {
    const double q = std::sqrt(0.5 * g * middle.depth * (middle.depth + left.depth) / left.depth);
    return s < left.u - q ? FlowState{left.depth, left.u, 0} : FlowState{middle.depth, middle.u, 0};
  }
  const double tail = middle.depth > 0 ? middle.u - std::sqrt(g * middle.depth) : left.u + 2 * c;
  if (s <= left.u - c) return {left.depth, left.u, 0};
  if (s >= tail) return {middle.depth, middle.u, 0};
  const double fan = (left.u + 2 * c - s) / 3;
  return {fan * fan / g, (left.u + 2 * c + 2 * s) / 3, 0};
}

class Riemann : public Exact {
 public:
  Riemann(const RiemannState& left, const RiemannState& right, double at, double gravity)
      : left_(left), right_(right), at_(at), gravity_(gravity),
        middle_(riemann_middle(left, right, gravity)) {}

  FlowState at(double x, double, double t) const override {
    if (t <= 0) return x < at_ ? FlowState{left_.depth, left_.u, 0} : FlowState{right_.depth, right_.u, 0};
    const double s = (x - at_) / t;
    if (s < middle_.u) return left_wave(s, left_, middle_, gravity_);
    FlowState state = left_wave(-s, {right_.depth, -right_.u}, {middle_.depth, -middle_.u}, gravity_);
    state.u = -state.u;
    return state;
  }

 private:
  RiemannState left_, right_;
  double at_, gravity_;
  RiemannMiddle middle_;
};

}  // namespace

RiemannMiddle riemann_middle(const RiemannState& left, const RiemannState& right, double gravity) {
  const double cl = std::sqrt(gravity * left.depth), cr = std::sqrt(gravity * right.depth),
               gap = right.u - left.u;
  const double both = 0.5 * (cl + cr) - 0.25 * gap;  // the celerity between two rarefactions
  if (both <= 0) return {0, 0.5 * (left.u + 2 * cl + right.u - 2 * cr)};
  double h = both * both / gravity;
  for (int n = 0; n < 100; ++n) {
    const Jump l = jump_to(h, left, gravity), r = jump_to(h, right, gravity);
    const double next = std::max(0.1 * h, h - (l.value + r.value + gap) / (l.slope + r.slope));
    const bool settled = std::abs(next - h) <= 1e-15 * h;
    h = next;
    if (settled) break;
  }
  return {h, 0.5 * (left.u + right.u + jump_to(h, right, gravity).value - jump_to(h, left, gravity).value)};
}

std::unique_ptr<Exact> riemann(const RiemannState& left, const RiemannState& right, double at,
                               double gravity) {
  return std::make_unique<Riemann>(left, right, at, gravity);
}

}  // namespace freshet
