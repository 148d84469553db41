// Smoothing kernels W(r, h) = w(r / h) / h^D, as w and dw/dq of q = r/h without branches: both vanish outside the support
// by construction. Norms are part of w.
#pragma once
#include <variant>

#include "cellgrid/lanes.hpp"
#include "kernels/smoothing/kernel_name.hpp"

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

// The kernels as data: a sum of truncated powers p = (knot - q)+, or the Gaussian cut at its support. One type for all of
// them keeps the compiled kernels few; the cubic spline has its own above because it is the default.
template <int D>
struct GeneralKernel {
  struct Term {
    double knot, p3, p4, p5;  // p3 p^3 + p4 p^4 + p5 p^5
  };
  double support = 2;
  double gaussian = 0;  // factor of exp(-q^2); 0 = the terms count
  Term term[3] = {};

  template <class V>
  KOKKOS_FORCEINLINE_FUNCTION KernelValue<V> at(V q) const {
    if (gaussian > 0) return bell(q);
    KernelValue<V> k{V(0.0), V(0.0)};
    for (const Term& t : term) {
      const V p = larger(V(t.knot) - q, V(0.0)), p2 = p * p;
      k.w += p2 * p * (t.p3 + p * (t.p4 + p * t.p5));
      k.dw -= p2 * (3 * t.p3 + p * (4 * t.p4 + p * (5 * t.p5)));
    }
    return k;
  }
  template <class V>
  KOKKOS_FORCEINLINE_FUNCTION V slope(V q) const {
    return at(q).dw;
  }

 private:
  // exp(-s) = (exp(-s/64))^64, its argument below 0.15: eight terms of the series are exact to round-off.
  template <class V>
  KOKKOS_FORCEINLINE_FUNCTION KernelValue<V> bell(V q) const {
    const V s = (-1.0 / 64) * (q * q);
    V e = 1.0 + s * (1.0 / 8);
    for (int n = 7; n > 0; --n) e = 1.0 + (1.0 / n) * s * e;
    for (int n = 0; n < 6; ++n) e = e * e;
    const V w = select(q < V(support), gaussian * e, V(0.0));
    return {w, -2.0 * q * w};
  }
};

// The named kernel, its norm times kappa. Quartic and quintic spline: supports 2.5h and 3h; Wendland C2: 2h; Gaussian: cut
// at 3h (where it is 1.2e-4 of its peak).
template <int D>
GeneralKernel<D> general_kernel(KernelName name, double kappa = 1);

// What the pair loops are compiled for.
template <int D>
using AnyKernel = std::variant<CubicSpline<D>, GeneralKernel<D>>;

// With the lattice correction the norm is such that the sum over a lattice of spacing h/eta is one (SWE-FORMULAS 1.7).
template <int D>
AnyKernel<D> make_kernel(KernelName name, double eta, bool lattice_correction);

// h^D and 1/h^D of a smoothing length.
template <int D, class V>
KOKKOS_FORCEINLINE_FUNCTION V power(V h) {
  if constexpr (D == 1)
    return h;
  else
    return h * h;
}

}  // namespace freshet
