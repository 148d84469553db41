// Weighted sums of least-squares gradients: A = sum w x_ji (x) x_ji, and its inverse where the neighbours
// span the space.
#pragma once
#include "cellgrid/particles/clusters.hpp"

namespace freshet::swe {

template <class V>
KOKKOS_FORCEINLINE_FUNCTION void add_square(Sym<V, 1>& m, const Vec<V, 1>& fd, const Vec<V, 1>& d) {
  m.xx += fd.x * d.x;
}
template <class V>
KOKKOS_FORCEINLINE_FUNCTION void add_square(Sym<V, 2>& m, const Vec<V, 2>& fd, const Vec<V, 2>& d) {
  m.xx += fd.x * d.x;
  m.xy += fd.x * d.y;
  m.yy += fd.y * d.y;
}

// A^-1; zero where the neighbours are (nearly) collinear.
KOKKOS_FORCEINLINE_FUNCTION Sym<Lane, 1> usable_inverse(const Sym<Lane, 1>& a) {
  return {1.0 / larger(a.xx, Lane(1e-300))};
}
KOKKOS_FORCEINLINE_FUNCTION Sym<Lane, 2> usable_inverse(const Sym<Lane, 2>& a) {
  constexpr double least_spread = 0.15;  // det against (trace/2)^2: 1 isotropic, 0 collinear
  const Lane det = a.xx * a.yy - a.xy * a.xy, half = 0.5 * trace(a);
  const Lane usable = select(least_spread * half * half < det, Lane(1.0), Lane(0.0));
  const Lane scale = usable / larger(det, Lane(1e-300));
  return {scale * a.yy, -scale * a.xy, scale * a.xx};
}

}  // namespace freshet::swe
