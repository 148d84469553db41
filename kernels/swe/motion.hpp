// The O(N) passes of a step: kick and drift, and acceleration with bed, friction and the second kick
// (KDK leap-frog with variable dt, SWE-FORMULAS section 5).
#pragma once
#include <optional>

#include "kernels/bed_spline.hpp"
#include "kernels/swe/particles.hpp"

namespace freshet::swe {

struct Friction {
  double gravity, manning;  // m/s2, s/m^(1/3)

  // K = g n^2 / d^(4/3) [1/m]: deceleration K |v| v (corrected (2.47)).
  KOKKOS_FORCEINLINE_FUNCTION double drag(double depth) const {
    const double root = ::cbrt(depth);
    return gravity * manning * manning / (depth * root);
  }
};

// v after dt of drag K |v| v, backward Euler: keeps the steady state exactly and cannot turn v round.
template <int D>
KOKKOS_FORCEINLINE_FUNCTION Vec<double, D> slowed(const Vec<double, D>& v, double drag, double dt) {
  return (2 / (1 + root(1 + 4 * drag * dt * root(dot(v, v))))) * v;
}

// The bed's part in a step: where it is absent no pass, no field.
template <int D>
struct Bed {
  BedSpline<D> spline;
  bool variational;           // corrected (2.23) with curvature; else classical a = -t - g grad b
  Field<double> level;        // m, b under each particle
};

template <int D>
struct MotionOptions {
  double gravity;
  LengthBounds bounds;
  std::optional<Bed<D>> bed;
  std::optional<Friction> friction;
  Field<double> drag;   // 1/m, with friction
  Field<int> kind;      // where `imposed`: particles with kind != 0 move at their imposed velocity
  bool imposed;
};

// v(t) -> v(t + dt/2), x -> x(t + dt); predicts v, rho, h at t + dt.
template <int D>
void kick_and_drift(const Particles<D>& p, const MotionOptions<D>& options, int n, double dt);

// a from t and the bed; v -> v + a kick_dt; returns min h / (c + signal) [s], the time a signal takes to cross h.
template <int D>
double accelerate_and_kick(const Particles<D>& p, const MotionOptions<D>& options, int n, double kick_dt);

}  // namespace freshet::swe
