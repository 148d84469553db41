// Smoothing kernels W(r, h) = w(r / h) / h^D, as w and dw/dq of q = r/h without branches: both vanish outside
// the support by construction. Norms are part of w.
#pragma once
#include <cmath>
#include <variant>

#include "cellgrid/simd/lanes.hpp"

namespace freshet {

template <class V>
struct KernelValue {
  V w;   // w(q)
  V dw;  // dw/dq
};

// Cubic spline (Monaghan 1992; thesis 1.5): (2/3)[(2-q)^3/4 - (1-q)^3] with negative brackets cut to zero,
// times 1 (1-D) or 15/(7 pi) (2-D). Support 2h.
template <int D>
struct CubicSpline {
  static constexpr double support = 2.0;
  static constexpr double norm = (D == 1 ? 1.0 : 15.0 / (7.0 * pi)) * 2.0 / 3.0;

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

// The kernels as data: a sum of truncated powers p = (knot - q)+, or the Gaussian cut at its support. One
// type for all of them keeps the compiled kernels few; the cubic spline has its own above because it is the
// default.
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

// The kernels that a scene may name (kernels/choice.hpp), their norms times kappa; one struct each.
namespace kernel {

struct Cubic {
  static constexpr const char* name = "cubic";
  template <int D>
  static GeneralKernel<D> shape(double kappa) {
    const double n = kappa * CubicSpline<D>::norm;
    return {2, 0, {{2, 0.25 * n, 0, 0}, {1, -n, 0, 0}}};
  }
};

// Spline of fourth order, support 2.5h.
struct Quartic {
  static constexpr const char* name = "quartic";
  template <int D>
  static GeneralKernel<D> shape(double kappa) {
    const double n = kappa * (D == 1 ? 1.0 / 24 : 96 / (1199 * pi));
    return {2.5, 0, {{2.5, 0, n, 0}, {1.5, 0, -5 * n, 0}, {0.5, 0, 10 * n, 0}}};
  }
};

// Spline of fifth order, support 3h.
struct Quintic {
  static constexpr const char* name = "quintic";
  template <int D>
  static GeneralKernel<D> shape(double kappa) {
    const double n = kappa * (D == 1 ? 1.0 / 120 : 7 / (478 * pi));
    return {3, 0, {{3, 0, 0, n}, {2, 0, 0, -6 * n}, {1, 0, 0, 15 * n}}};
  }
};

// Cut at 3h, where it is 1.2e-4 of its peak.
struct Gaussian {
  static constexpr const char* name = "gaussian";
  template <int D>
  static GeneralKernel<D> shape(double kappa) {
    return {3, kappa * (D == 1 ? 1 / std::sqrt(pi) : 1 / pi), {}};
  }
};

// Wendland's C2 function, support 2h: (1 - q/2)^3 (1 + 3q/2) in 1-D, (1 - q/2)^4 (1 + 2q) in 2-D; with p = 2
// - q both are two powers.
struct Wendland {
  static constexpr const char* name = "wendland";
  template <int D>
  static GeneralKernel<D> shape(double kappa) {
    if (D == 1) return {2, 0, {{2, kappa * 5.0 / 8 * 0.5, -kappa * 5.0 / 8 * 1.5 / 8, 0}}};
    return {2, 0, {{2, 0, kappa * 7 / (4 * pi) * 5.0 / 16, -kappa * 7 / (4 * pi) * 2.0 / 16}}};
  }
};

}  // namespace kernel

using KernelChoice =
    std::variant<kernel::Cubic, kernel::Quartic, kernel::Quintic, kernel::Gaussian, kernel::Wendland>;

template <int D>
GeneralKernel<D> general_kernel(const KernelChoice& choice, double kappa = 1) {
  return std::visit([&](const auto& k) { return k.template shape<D>(kappa); }, choice);
}

// What the pair loops are compiled for.
template <int D>
using AnyKernel = std::variant<CubicSpline<D>, GeneralKernel<D>>;

// With the lattice correction the norm is such that the sum over a lattice of spacing h/eta is one:
// docs/formulas/swe.md (S6).
template <int D>
AnyKernel<D> make_kernel(const KernelChoice& choice, double eta, bool lattice_correction);

// h^D and 1/h^D of a smoothing length.
template <int D, class V>
KOKKOS_FORCEINLINE_FUNCTION V power(V h) {
  if constexpr (D == 1) return h;
  else return h * h;
}

}  // namespace freshet
