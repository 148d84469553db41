// Normal equations of quadratic fits in a plane (docs/formulas/fpm.md (F8)), solved so that what the
// neighbours hardly determine stays small. In layers of two rows of points second derivatives across are as
// good as free: a gradient there may take any share of them, and a projection with such gradients multiplies
// errors by 1e3 to 1e5 in a step. The unknowns are turned to the principal axes of the neighbours' spread,
// the long one first, and second derivatives whose pivots are below 0.03 of their diagonal entries (0.042
// where neighbours lie in a band) are drawn towards zero, the more the lower these are. Clouds off jets
// hardly have such (jitter 0.3 dx: least 0.06 inside and on straight edges); in two ragged rows a step
// multiplies errors by up to 1.2 then (3.8 with pivots of at least 0.01).
#pragma once
#include "kernels/linear/small_dense.hpp"

namespace freshet::fpm {

constexpr double stiffness = 20;

// The long axis (c, s) of a spread with the moments xx, xy, yy; x where none is longer.
template <class V>
struct Axes {
  V c, s;
  V roundness;  // the short axis' moment over the long one's

  KOKKOS_FORCEINLINE_FUNCTION Axes(const V& xx, const V& xy, const V& yy) {
    const V a = xx - yy, b = 2.0 * xy, r2 = a * a + b * b, sum = xx + yy;
    const auto clear = V(1e-12) * sum * sum < r2;
    const V r = root(select(clear, r2, V(1.0)));
    const V cos2 = select(clear, a / r, V(1.0)), sin2 = select(clear, b / r, V(0.0));
    const V major = root(0.5 * (1.0 + larger(cos2, -1.0 * cos2))), minor = sin2 / (2.0 * major);
    roundness = select(clear, (sum - r) / (sum + r), V(1.0));
    const auto along_x = cos2 < V(0.0);
    c = select(along_x, minor, major);
    s = select(along_x, major, minor);
  }

  // Slopes and second derivatives from entry `first` on: X, Y, XX/2, XY, YY/2 of the turned axes from those
  // of the others.
  template <int First, int N>
  KOKKOS_FORCEINLINE_FUNCTION Column<V, N> turned(Column<V, N> v) const {
    const V x = v[First], y = v[First + 1], p = v[First + 2], q = v[First + 3], r = v[First + 4], cc = c * c,
            cs = c * s, ss = s * s;
    v[First] = c * x + s * y;
    v[First + 1] = c * y - s * x;
    v[First + 2] = cc * p + cs * q + ss * r;
    v[First + 3] = 2.0 * cs * (r - p) + (cc - ss) * q;
    v[First + 4] = ss * p - cs * q + cc * r;
    return v;
  }
  // The transpose.
  template <int First, int N>
  KOKKOS_FORCEINLINE_FUNCTION Column<V, N> back(Column<V, N> v) const {
    const V x = v[First], y = v[First + 1], p = v[First + 2], q = v[First + 3], r = v[First + 4], cc = c * c,
            cs = c * s, ss = s * s;
    v[First] = c * x - s * y;
    v[First + 1] = s * x + c * y;
    v[First + 2] = cc * p - 2.0 * cs * q + ss * r;
    v[First + 3] = cs * (p - r) + (cc - ss) * q;
    v[First + 4] = ss * p + 2.0 * cs * q + cc * r;
    return v;
  }
};

// Of N unknowns those from First on are slopes and second derivatives in a plane.
template <class V, int First, int N>
class SoftFactored {
  static_assert(N - First == 5, "slopes and second derivatives in a plane");

 public:
  explicit KOKKOS_FORCEINLINE_FUNCTION SoftFactored(const Symmetric<V, N>& g)
      : axes_(g(First, First), g(First + 1, First), g(First + 1, First + 1)),
        factored_(turned(g), {1e-10, First + 2, stiffness, soft_pivot()}) {}

  KOKKOS_FORCEINLINE_FUNCTION Column<V, N> solve(const Column<V, N>& b) const {
    return axes_.template back<First>(factored_.solve(axes_.template turned<First>(b)));
  }
  KOKKOS_FORCEINLINE_FUNCTION const V& complete() const { return factored_.complete(); }

 private:
  KOKKOS_FORCEINLINE_FUNCTION V soft_pivot() const {
    return 0.03 + 0.012 * larger(V(0.0), smaller(V(1.0), 5.0 * (0.6 - axes_.roundness)));
  }

  // T g T^T
  KOKKOS_FORCEINLINE_FUNCTION Symmetric<V, N> turned(const Symmetric<V, N>& g) const {
    Column<V, N> columns[N];
    unroll<N>([&](auto j) {
      Column<V, N> column;
      unroll<N>([&](auto i) { column[i] = i < j ? g(j, i) : g(i, j); });
      columns[j] = axes_.template turned<First>(column);
    });
    Symmetric<V, N> result;
    unroll<N>([&](auto i) {
      Column<V, N> row;
      unroll<N>([&](auto j) { row[j] = columns[j][i]; });
      row = axes_.template turned<First>(row);
      unroll<i + 1>([&](auto j) { result(i, j) = row[j]; });
    });
    return result;
  }

  Axes<V> axes_;
  Factored<V, N> factored_;
};

}  // namespace freshet::fpm
