// Stabilisation of the pair force: Pi in m^4/(kg s^2) like p/rho^2 (SWE-FORMULAS section 6; thesis 2.5). One struct per
// choice; to add one, write its struct, name it in the variant, in Stabilisation (src/scene/scene.hpp) and in the reader.
#pragma once
#include <variant>

#include "cellgrid/pack.hpp"

namespace freshet::swe {

template <class V>
KOKKOS_FORCEINLINE_FUNCTION V minmod(V a, V b) {
  return larger(V(0.0), smaller(a, b)) + smaller(V(0.0), larger(a, b));
}

// What a pair knows: jump = v_ij . x_ij; slope_i, slope_j = x_ij . grad v . x_ij at both ends (what linear fields would
// give for the jump); celerities = c_i + c_j; inv = 1 / ((rho_i + rho_j) r). Each returns Pi / 2.
template <class V>
struct PairJump {
  V jump, slope_i, slope_j, celerities, inv;
};

struct NoStabilisation {
  static constexpr bool gradient = false;
  template <class V>
  KOKKOS_FORCEINLINE_FUNCTION V operator()(const PairJump<V>&) const {
    return V(0.0);
  }
};

// Lax-Friedrichs flux, corrected (2.54): Pi = -c v_ij.x_ij / (rho r) with mean c and rho; always on.
struct LaxFriedrichs {
  static constexpr bool gradient = false;
  double strength;
  template <class V>
  KOKKOS_FORCEINLINE_FUNCTION V operator()(const PairJump<V>& p) const {
    return (-0.5 * strength) * p.celerities * p.jump * p.inv;
  }
};

// The same on the normal velocity reconstructed from both ends (MUSCL, corrected (2.57)): what remains of the jump.
struct LaxFriedrichsMuscl {
  static constexpr bool gradient = true;
  double strength;
  template <class V>
  KOKKOS_FORCEINLINE_FUNCTION V operator()(const PairJump<V>& p) const {
    const V remaining = p.jump - 0.5 * (minmod(p.jump, p.slope_i) + minmod(p.jump, p.slope_j));
    return (-0.5 * strength) * p.celerities * remaining * p.inv;
  }
};

using AnyStabilisation = std::variant<NoStabilisation, LaxFriedrichs, LaxFriedrichsMuscl>;

}  // namespace freshet::swe
