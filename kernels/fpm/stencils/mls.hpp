// Moving least squares over the neighbours of a place (docs/formulas/fpm.md (F4) to (F7)): basis m = [1, X,
// Y, X^2/2, XY, Y^2/2], X = x / h (1-D: 3 terms, 3-D: 10), weight exp(-7 R^2) for R = r / h < 1 (printed:
// 6.25). With G = sum w m m^T a linear functional of the fitted polynomial is sum_j w_j (m_j . beta) f_j, G
// beta = the functional's values on the basis: beta are its factors. Values V: double or pack.
#pragma once
#include <type_traits>

#include "cellgrid/simd/vec.hpp"
#include "kernels/fpm/stencils/soft_pivots.hpp"

namespace freshet::fpm {

template <int D>
inline constexpr int terms = (D + 1) * (D + 2) / 2;

template <class V, int D>
using Terms = Column<V, terms<D>>;
template <class V, int D>
using Slopes = Column<V, terms<D> - 1>;  // without the constant

template <class V>
KOKKOS_FORCEINLINE_FUNCTION Terms<V, 1> basis(const Vec<V, 1>& s) {
  return {{V(1.0), s.x, 0.5 * s.x * s.x}};
}
template <class V>
KOKKOS_FORCEINLINE_FUNCTION Terms<V, 2> basis(const Vec<V, 2>& s) {
  return {{V(1.0), s.x, s.y, 0.5 * s.x * s.x, s.x * s.y, 0.5 * s.y * s.y}};
}
template <class V>
KOKKOS_FORCEINLINE_FUNCTION Terms<V, 3> basis(const Vec<V, 3>& s) {
  return {{V(1.0), s.x, s.y, s.z, 0.5 * s.x * s.x, s.x * s.y, 0.5 * s.y * s.y, s.x * s.z, s.y * s.z,
           0.5 * s.z * s.z}};
}

// The terms whose coefficients add up to the Laplacian.
template <int D>
KOKKOS_FORCEINLINE_FUNCTION constexpr bool is_pure_second(int term) {
  return D == 1 ? term == 2 : D == 2 ? term == 3 || term == 5 : term == 4 || term == 6 || term == 9;
}

// The wider the weight, the less a gradient sees of waves of two spacings, up to seeing them reversed where
// stencils are one-sided: in rows next to walls and surfaces a step then multiplies them by more than one.
constexpr double steepness = 7;

// exp(-steepness s) for s = R^2 < 1, else 0; relative error 2e-13. (exp(-t/128))^128 by its series.
template <class V>
KOKKOS_FORCEINLINE_FUNCTION V weight(const V& s) {
  const V t = (-steepness / 128) * smaller(s, V(1.0));
  V e = 1.0 +
        t * (1.0 + t * (1.0 / 2 +
                        t * (1.0 / 6 +
                             t * (1.0 / 24 + t * (1.0 / 120 +
                                                  t * (1.0 / 720 + t * (1.0 / 5040 + t * (1.0 / 40320))))))));
  unroll<7>([&](auto) { e *= e; });
  return select(s < V(1.0), e, V(0.0));
}

// sum w m m^T
template <class V, int D>
struct Moments {
  Symmetric<V, terms<D>> g;

  KOKKOS_FORCEINLINE_FUNCTION Moments() {
    unroll<terms<D>*(terms<D> + 1) / 2>([&](auto k) { g.a[k] = V(0.0); });
  }
  KOKKOS_FORCEINLINE_FUNCTION void add(const V& w, const Terms<V, D>& m) { g.add_square(w, m); }

  // The part without the constant: that of fits which pass through the value at the centre.
  KOKKOS_FORCEINLINE_FUNCTION Symmetric<V, terms<D> - 1> slopes() const {
    Symmetric<V, terms<D> - 1> s;
    unroll<terms<D> - 1>([&](auto i) { unroll<i + 1>([&](auto j) { s(i, j) = g(i + 1, j + 1); }); });
    return s;
  }
};

// Of fits with (1) or without (0) a constant.
template <class V, int D, int Constants>
using FitSolver = std::conditional_t<D == 2, SoftFactored<V, Constants, Constants + terms<D> - 1>,
                                     Factored<V, Constants + terms<D> - 1>>;

// m . beta for factors without the constant.
template <class V, int D>
KOKKOS_FORCEINLINE_FUNCTION V of_slopes(const Terms<V, D>& m, const Slopes<V, D>& beta) {
  V sum = m[1] * beta[0];
  unroll<terms<D> - 2>([&](auto k) { sum += m[k + 2] * beta[k + 1]; });
  return sum;
}

// Factors of the derivatives at the centre, on differences f_j - f_centre (exact for constants): 1/m, of the
// Laplacian 1/m2.
template <class V, int D>
struct Derivatives {
  Slopes<V, D> gradient[D], laplacian;
  V complete;  // share of the unknowns that the neighbours determine; below 1 the others count as zero

  KOKKOS_FORCEINLINE_FUNCTION Derivatives(const Moments<V, D>& moments, const V& per_h) {
    const FitSolver<V, D, 0> factored(moments.slopes());
    complete = factored.complete();
    unroll<D>([&](auto axis) {
      Slopes<V, D> e;
      unroll<terms<D> - 1>([&](auto k) { e[k] = k == axis ? per_h : V(0.0); });
      gradient[axis] = factored.solve(e);
    });
    Slopes<V, D> e;
    unroll<terms<D> - 1>([&](auto k) { e[k] = is_pure_second<D>(k + 1) ? per_h * per_h : V(0.0); });
    laplacian = factored.solve(e);
  }
};

// Factors of the fitted value at the origin of the basis. Few neighbours: the terms that they do not
// determine count as zero.
template <class Solver, class V, int D>
KOKKOS_FORCEINLINE_FUNCTION Terms<V, D> value_factors_by(const Moments<V, D>& moments) {
  Terms<V, D> e;
  unroll<terms<D>>([&](auto k) { e[k] = V(k == 0 ? 1.0 : 0.0); });
  return Solver(moments.g).solve(e);
}
template <class V, int D>
KOKKOS_FORCEINLINE_FUNCTION Terms<V, D> value_factors(const Moments<V, D>& moments) {
  return value_factors_by<Factored<V, terms<D>>>(moments);
}
template <class V, int D>
KOKKOS_FORCEINLINE_FUNCTION Terms<V, D> soft_value_factors(const Moments<V, D>& moments) {
  return value_factors_by<FitSolver<V, D, 1>>(moments);
}

}  // namespace freshet::fpm
