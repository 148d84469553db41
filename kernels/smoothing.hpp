// Smoothing kernels W(r, h) = w(r / h) / h^D, as w and dw/dq of q = r/h without branches: both vanish outside the support
// by construction. Norms are part of w.
#pragma once
#include "cellgrid/pack.hpp"

namespace freshet {

template <class V>
struct KernelValue {
  V w;   // w(q)
  V dw;  // dw/dq
};

// Cubic spline (Monaghan 1992; thesis 1.5): (2/3)[(2-q)^3/4 - (1-q)^3] with negative brackets cut to zero, times
// 1 (1-D) or 15/(7 pi) (2-D). Support 2h.
template <int D>
struct CubicSpline {
  static constexpr double support = 2.0;
  static constexpr double norm = (D == 1 ? 1.0 : 15.0 / (7.0 * 3.14159265358979323846)) * 2.0 / 3.0;

  template <class V>
  static KOKKOS_FORCEINLINE_FUNCTION KernelValue<V> at(V q) {
    const V outer = larger(V(2.0) - q, V(0.0)), inner = larger(V(1.0) - q, V(0.0));
    const V outer2 = outer * outer, inner2 = inner * inner;
    return {norm * (0.25 * outer2 * outer - inner2 * inner), norm * (3.0 * inner2 - 0.75 * outer2)};
  }

  template <class V>
  static KOKKOS_FORCEINLINE_FUNCTION V slope(V q) {
    return at(q).dw;
  }
};

// h^D and 1/h^D of a smoothing length.
template <int D, class V>
KOKKOS_FORCEINLINE_FUNCTION V power(V h) {
  if constexpr (D == 1)
    return h;
  else
    return h * h;
}

}  // namespace freshet
