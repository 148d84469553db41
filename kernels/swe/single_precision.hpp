// The neighbours' side of a pair in single precision (`sph.precision = "mixed"`): records filled once a pass
// and read once a pair. Sums over a cluster's neighbours then carry relative errors of some 1e-7; what is
// made of the sums is double.
#pragma once
#include "kernels/swe/particles.hpp"

namespace freshet::swe {

// Where a number stands in SingleCopies::state; in 1-D the y parts are not used.
struct StateSlot {
  static constexpr int v = 0, m = 2, rho = 3, h = 4, inv_h = 5, pressure = 6, celerity = 7, weight = 8,
                       strain = 9, depth_slope = 12;
};

// Of the particles 0 ... size - 1. Reads v_pred, m; writes single.motion.
template <int D>
void copy_motion(const Particles<D>& p, int size);

// Reads v_pred, m, rho, h, inv_h, pressure, celerity, weight and, where they exist, strain and depth_slope;
// writes single.state.
template <int D>
void copy_state(const Particles<D>& p, int size);

template <int k, int D, int N>
KOKKOS_FORCEINLINE_FUNCTION Vec<Twin, D> two_vectors(const TwinRecord<N>& r) {
  if constexpr (D == 1) return {r.template get<k>()};
  else return {r.template get<k>(), r.template get<k + 1>()};
}
template <int k, int D>
KOKKOS_FORCEINLINE_FUNCTION Sym<Twin, D> two_matrices(const TwinRecord<16>& r) {
  if constexpr (D == 1) return {r.get<k>()};
  else return {r.get<k>(), r.get<k + 1>(), r.get<k + 2>()};
}

}  // namespace freshet::swe
