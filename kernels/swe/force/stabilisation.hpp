// What a pair's pressures become under each stabilisation (thesis 2.7; docs/formulas/swe.md (S15) to (S20)).
// To add one, write its struct and name it in the variant: name and title are what a scene says and what the
// program shows, keys(k) the keys of its own (kernels/choice.hpp), flops what it adds to a pair
// (cellgrid/parallel/work.hpp). Of those with the same name the first that fits the key 'muscl' is taken.
#pragma once
#include <variant>

#include "cellgrid/simd/lanes.hpp"

namespace freshet::swe {

template <class V>
KOKKOS_FORCEINLINE_FUNCTION V minmod(V a, V b) {
  return larger(V(0.0), smaller(a, b)) + smaller(V(0.0), larger(a, b));
}

// What a pair knows of both its ends, x_ij = x_i - x_j; what a choice does not use is not computed.
template <class V>
struct PairState {
  V jump;                          // m2/s, v_ij . x_ij
  V slope_i, slope_j;              // m2/s, x_ij . grad v . x_ij: what linear fields would give for the jump
  V celerities;                    // m/s, c_i + c_j
  V inv;                           // 1/m2, 1 / ((rho_i + rho_j) r)
  V r2;                            // m2
  V lengths;                       // m, h_i + h_j
  V rho_i, rho_j;                  // m
  V depth_slope_i, depth_slope_j;  // m, x_ij . grad rho
  V pressure_i, pressure_j;        // m/s2, p / (rho^2 alpha) of (2.22)
};

// What multiplies m_j G_ij(h_i) and m_j G_ij(h_j).
template <class V>
struct PairPressure {
  V i, j;
};

// Pi in m^4/(kg s^2) like p / rho^2, half of it in each bracket (corrected (2.52)).
template <class V>
KOKKOS_FORCEINLINE_FUNCTION PairPressure<V> with_viscosity(const PairState<V>& p, V half_pi) {
  return {p.pressure_i + half_pi, p.pressure_j + half_pi};
}

// v_r - v_l along x_ij (times r) of the velocities reconstructed from both ends (MUSCL, corrected (2.57)).
// Turned so that the jump is positive, minmod(jump, slope) is one clamp; the sign is put back at the end.
template <class V>
KOKKOS_FORCEINLINE_FUNCTION V reconstructed_jump(const PairState<V>& p) {
  const V size = size_of(p.jump), zero(0.0);
  const V taken = larger(zero, smaller(size, turned_by(p.slope_i, p.jump))) +
                  larger(zero, smaller(size, turned_by(p.slope_j, p.jump)));
  return turned_by(size - 0.5 * taken, p.jump);
}

struct NoStabilisation {
  static constexpr const char *name = "none", *title = "not stabilised";
  static constexpr bool velocity_gradient = false, depth_gradient = false, muscl = false;
  static constexpr double flops = 0;
  template <class V>
  KOKKOS_FORCEINLINE_FUNCTION PairPressure<V> operator()(const PairState<V>& p) const {
    return {p.pressure_i, p.pressure_j};
  }
};

// Artificial viscosity, corrected (2.53): Pi = (-a c mu + b mu^2)/rho with mu = h v.x/(r^2 + 0.01 h^2),
// approaching pairs only.
struct ArtificialViscosity {
  static constexpr const char *name = "artificial-viscosity", *title = "artificial viscosity";
  static constexpr bool velocity_gradient = false, depth_gradient = false, muscl = false;
  static constexpr double flops = 15;
  double a = 1, b = 0;
  template <class Keys>
  void keys(Keys& k) {
    k.pair("viscosity", {"a", "b"}, a, b);
  }
  template <class V>
  KOKKOS_FORCEINLINE_FUNCTION PairPressure<V> operator()(const PairState<V>& p) const {
    const V h = 0.5 * p.lengths, closing = smaller(p.jump, V(0.0));
    const V mu = h * closing / (p.r2 + 0.01 * h * h);
    return with_viscosity<V>(p, (b * mu * mu - 0.5 * a * p.celerities * mu) / (p.rho_i + p.rho_j));
  }
};

// Lax-Friedrichs flux, corrected (2.54): Pi = -c v_ij.x_ij / (rho r) with mean c and rho; always on.
// Reconstructed: on the normal velocities of the linear fields midway.
template <bool Reconstructed>
struct LaxFriedrichsFlux {
  static constexpr const char *name = "lax-friedrichs",
                              *title = Reconstructed ? "Lax-Friedrichs with MUSCL" : "Lax-Friedrichs";
  static constexpr bool velocity_gradient = Reconstructed, depth_gradient = false, muscl = Reconstructed;
  static constexpr double flops = Reconstructed ? 24 : 6;
  double strength = 1;
  template <class Keys>
  void keys(Keys& k) {
    k.factor("strength", strength);
  }
  template <class V>
  KOKKOS_FORCEINLINE_FUNCTION PairPressure<V> operator()(const PairState<V>& p) const {
    if constexpr (Reconstructed)
      return with_viscosity<V>(p, (-0.5 * strength) * p.celerities * reconstructed_jump(p) * p.inv);
    else return with_viscosity<V>(p, (-0.5 * strength) * p.celerities * p.jump * p.inv);
  }
};
using LaxFriedrichs = LaxFriedrichsFlux<false>;
using LaxFriedrichsMuscl = LaxFriedrichsFlux<true>;

// Depth between two states in contact, two-shock approximation on the two-rarefaction estimate (Toro; thesis
// (2.56)): left = j, right = i; closing = u_l - u_r along x_ij. Zero where the states part so fast that the
// bed falls dry.
template <class V>
KOKKOS_FORCEINLINE_FUNCTION V two_shock_depth(V left, V right, V closing, double gravity) {
  const V c = 0.5 * root(gravity * left) + 0.5 * root(gravity * right) + 0.25 * closing;
  const V d0 = larger(c, V(0.0)) * larger(c, V(0.0)) / gravity, least = 1e-12 * (left + right);
  const V base = larger(d0, least);
  const V g_l = root(0.5 * gravity * (base + left) / (base * left)),
          g_r = root(0.5 * gravity * (base + right) / (base * right));
  const V depth = larger((g_l * left + g_r * right + closing) / (g_l + g_r), V(0.0));
  return select(least < d0, depth, V(0.0));
}

// Both ends feel p* = g d*^2 / 2 (corrected (2.55)): p / (rho^2 alpha) grows by (d*/rho)^2. Reconstructed:
// depths and normal velocities are those of the linear fields midway, limited by minmod.
template <bool Reconstructed>
struct TwoShockFlux {
  static constexpr const char *name = "two-shock",
                              *title = Reconstructed ? "two-shock with MUSCL" : "two-shock";
  static constexpr bool velocity_gradient = Reconstructed, depth_gradient = Reconstructed,
                        muscl = Reconstructed;
  static constexpr double flops = Reconstructed ? 76 : 33;
  double gravity = 9.81;  // m/s2
  template <class V>
  KOKKOS_FORCEINLINE_FUNCTION PairPressure<V> operator()(const PairState<V>& p) const {
    const V inv_r = p.inv * (p.rho_i + p.rho_j), difference = p.rho_i - p.rho_j;
    V left = p.rho_j, right = p.rho_i, jump = p.jump;
    if constexpr (Reconstructed) {
      left += 0.5 * minmod(difference, p.depth_slope_j);
      right -= 0.5 * minmod(difference, p.depth_slope_i);
      jump = reconstructed_jump(p);
    }
    const V depth = two_shock_depth(left, right, -jump * inv_r, gravity);
    const V in_i = depth / p.rho_i, in_j = depth / p.rho_j;
    return {p.pressure_i * in_i * in_i, p.pressure_j * in_j * in_j};
  }
};
using TwoShock = TwoShockFlux<false>;
using TwoShockMuscl = TwoShockFlux<true>;

using AnyStabilisation = std::variant<NoStabilisation, ArtificialViscosity, LaxFriedrichsMuscl, LaxFriedrichs,
                                      TwoShockMuscl, TwoShock>;

}  // namespace freshet::swe
