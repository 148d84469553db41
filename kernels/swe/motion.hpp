// The O(N) passes of a step: kick and drift, and acceleration with bed, friction and the second kick
// (KDK leap-frog with variable dt): docs/formulas/swe.md (S13), (S23) to (S29).
#pragma once
#include <optional>

#include "kernels/ground/bed_spline.hpp"
#include "kernels/ground/nearest_table.hpp"
#include "kernels/swe/particles.hpp"

namespace freshet::swe {

struct Friction {
  double gravity, manning;  // m/s2, s/m^(1/3)
  // n^2 [s2/m^(2/3)] by place; empty: `manning` everywhere, nothing is looked up
  NearestTable roughness2 = {};

  // K = g n^2 / d^(4/3) [1/m]: deceleration K |v| v (corrected (2.47)).
  template <class V>
  KOKKOS_FORCEINLINE_FUNCTION V drag(V depth) const {
    return (gravity * manning * manning) * per_depth(depth);
  }
  template <int D, class V>
  KOKKOS_FORCEINLINE_FUNCTION V drag(V depth, const Vec<V, D>& x) const {
    return roughness2.given() ? gravity * roughness2.at(x) * per_depth(depth) : drag(depth);
  }

 private:
  template <class V>
  static KOKKOS_FORCEINLINE_FUNCTION V per_depth(V depth) {  // d^(-4/3)
    const V per_root = inverse_cbrt(depth);
    return (per_root * per_root) * (per_root * per_root);
  }
};

// v after dt of drag K |v| v, backward Euler: keeps the steady state exactly and cannot turn v round.
template <int D, class V>
KOKKOS_FORCEINLINE_FUNCTION Vec<V, D> slowed(const Vec<V, D>& v, V drag, V dt) {
  return (2.0 / (1.0 + root(1.0 + 4.0 * drag * dt * root(dot(v, v))))) * v;
}

// The bed's part in a step: where it is absent no pass, no field.
template <int D>
struct BedTerm {
  BedSpline<D> spline;
  bool variational;     // corrected (2.23) with curvature; else classical a = -t - g grad b
  Field<double> level;  // m, b under each particle
};

template <int D>
struct MotionOptions {
  double gravity;
  LengthBounds bounds;
  std::optional<BedTerm<D>> bed;
  std::optional<Friction> friction;
  Field<double> drag;    // 1/m, with friction
  ImposedLanes imposed;  // these move at their imposed velocity
  bool walled = false;   // a step may not carry a particle past the walls that it has not met yet
};

// 2-D. Bed: with curvature; its table stays in the cache.
inline constexpr Cost kick_and_drift_cost{0, 27, 18}, accelerate_cost{0, 7, 11}, bed_cost{0, 217, 5},
    bed_slope_cost{0, 150, 3}, friction_cost{0, 40, 1};

// v(t) -> v(t + dt/2), x -> x(t + dt); predicts v, rho, h at t + dt.
template <int D>
void kick_and_drift(const Particles<D>& p, const MotionOptions<D>& options, int n, double dt);

// a from t and the bed; v -> v + a kick_dt; returns min h / (c + signal) [s], the time a signal takes to
// cross h, between walls also the time in which a particle moves by 2 h, so that it does not jump past a wall
// that it has not met: at CFL 0.4 this shortens the steps of thin water with a Froude number above 2.
template <int D>
double accelerate_and_kick(const Particles<D>& p, const MotionOptions<D>& options, int n, double kick_dt);

}  // namespace freshet::swe
