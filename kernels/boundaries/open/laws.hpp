// The laws of states.hpp, for host and device.
#pragma once
#include "cellgrid/parallel/types.hpp"
#include "kernels/boundaries/open/states.hpp"

namespace freshet {
namespace open_states {

KOKKOS_INLINE_FUNCTION double celerity(double depth, const OpenStrip& strip) {
  return ::sqrt(strip.gravity * larger(0.0, depth));
}

// R, the invariant that leaves; a dry row has none, and 0 leads to critical inflow.
KOKKOS_INLINE_FUNCTION double leaving(const InnerState& inner, const OpenStrip& strip) {
  return 2 * celerity(inner.depth, strip) - inner.inward;
}

KOKKOS_INLINE_FUNCTION bool leaves_supercritically(const InnerState& inner, const OpenStrip& strip) {
  return inner.depth > 0 && -inner.inward > celerity(inner.depth, strip);
}

KOKKOS_INLINE_FUNCTION ExteriorState copied(const InnerState& inner) {
  return {inner.depth, inner.inward, false};
}

// From the celerity instead of the depth.
KOKKOS_INLINE_FUNCTION ExteriorState state(double c, double inward, const OpenStrip& strip) {
  return {c * c / strip.gravity, inward, false};
}

// The most that can leave: u = -c with R kept.
KOKKOS_INLINE_FUNCTION ExteriorState critical_outflow(double r, const OpenStrip& strip) {
  const double c = larger(0.0, r / 3);
  return state(c, -c, strip);
}

KOKKOS_INLINE_FUNCTION ExteriorState wall(double r, const OpenStrip& strip) {
  const double c = larger(0.0, r / 2);
  return {c * c / strip.gravity, 0, true};
}

// The state at the line between an outer state with the invariant `entering` = u + 2 c and the inner one:
// where the rarefaction between them would be transonic, the line sees its critical point.
KOKKOS_INLINE_FUNCTION ExteriorState between(double entering, double r, const OpenStrip& strip) {
  const double c = (entering + r) / 4, u = (entering - r) / 2;
  if (u < -c) return critical_outflow(r, strip);
  if (u > c) {
    const double critical = larger(0.0, entering / 3);
    return state(critical, critical, strip);
  }
  return state(c, u, strip);
}

// The root of 2 c^3 - r c^2 = gq right of the minimum of the left side, from a start above it: Newton falls
// on to it.
KOKKOS_INLINE_FUNCTION double cubic_root(double r, double gq, double start) {
  double c = start;
  for (int n = 0; n < 50; ++n) {
    const double slope = 6 * c * c - 2 * r * c;
    if (slope <= 0) break;
    const double step = (2 * c * c * c - r * c * c - gq) / slope;
    c -= step;
    if (::fabs(step) <= 1e-15 * c) break;
  }
  return c;
}

}  // namespace open_states

KOKKOS_INLINE_FUNCTION
ExteriorState ImposedLevel::operator()(const InnerState& inner, const OpenStrip& strip) const {
  using namespace open_states;
  if (leaves_supercritically(inner, strip)) return copied(inner);
  const double r = leaving(inner, strip), c = celerity(level - strip.bed, strip);
  if (c <= r / 3) return critical_outflow(r, strip);  // a free fall: the level outside is not felt
  return state(c, smaller(2 * c - r, c), strip);
}

KOKKOS_INLINE_FUNCTION
ExteriorState IncomingWave::operator()(const InnerState& inner, const OpenStrip& strip) const {
  using namespace open_states;
  if (leaves_supercritically(inner, strip)) return copied(inner);
  const double entering = 4 * celerity(level - strip.bed, strip) - 2 * celerity(strip.still, strip);
  return between(entering, leaving(inner, strip), strip);
}

KOKKOS_INLINE_FUNCTION
ExteriorState ImposedVelocity::operator()(const InnerState& inner, const OpenStrip& strip) const {
  using namespace open_states;
  const double r = leaving(inner, strip);
  if (inward == 0) return wall(r, strip);  // also before water that arrives supercritically
  if (inward < 0 && leaves_supercritically(inner, strip)) return copied(inner);
  const double c = (r + inward) / 2;
  if (inward < 0 && c < -inward) return critical_outflow(r, strip);
  return state(larger(c, inward), inward, strip);
}

KOKKOS_INLINE_FUNCTION
ExteriorState ImposedDischarge::operator()(const InnerState& inner, const OpenStrip& strip) const {
  using namespace open_states;
  const double r = leaving(inner, strip), gq = strip.gravity * total * strip.share;
  if (gq == 0) return wall(r, strip);
  if (gq > 0) {
    const double critical = ::cbrt(gq);
    const double c = inner.depth > 0 ? cubic_root(r, gq, larger(r, 0.0) / 2 + ::cbrt(gq / 2)) : critical;
    return state(larger(c, critical), gq / (larger(c, critical) * larger(c, critical)), strip);
  }
  if (inner.depth <= 0) return wall(0, strip);
  if (leaves_supercritically(inner, strip)) return copied(inner);
  if (r * r * r <= -27 * gq) return critical_outflow(r, strip);
  const double c = cubic_root(r, gq, r / 2);
  return state(c, gq / (c * c), strip);
}

KOKKOS_INLINE_FUNCTION
ExteriorState ImposedState::operator()(const InnerState& inner, const OpenStrip& strip) const {
  using namespace open_states;
  const double outer = celerity(above_bed ? stage : stage - strip.bed, strip);
  if (outer > 0 && inward > outer) return state(outer, inward, strip);
  if (leaves_supercritically(inner, strip)) return copied(inner);
  return between((outer > 0 ? inward : 0) + 2 * outer, leaving(inner, strip), strip);
}

// By a law of one kind, the same bits wherever it is used.
template <class Law>
KOKKOS_FUNCTION FRESHET_OUT_OF_LINE ExteriorState imposed(const Law& law, const InnerState& inner,
                                                          const OpenStrip& strip) {
  return law(inner, strip);
}

KOKKOS_INLINE_FUNCTION
ExteriorState Transmissive::operator()(const InnerState& inner, const OpenStrip& strip) const {
  using namespace open_states;
  if (levelled) return imposed(ImposedState{level}, inner, strip);
  if (inner.depth <= 0 || leaves_supercritically(inner, strip)) return copied(inner);
  return between(inner.arriving, leaving(inner, strip), strip);
}

}  // namespace freshet
