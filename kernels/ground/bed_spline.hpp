// The bed between its bottom particles: a tensor-product cubic B-spline through their (filtered) levels, so
// that b, grad b and the curvature are consistent derivatives of one function: docs/formulas/swe.md (S21),
// (S22). Tabulated once; 4^D points per sample.
#pragma once
#include <array>
#include <functional>

#include "cellgrid/simd/lanes.hpp"
#include "cellgrid/simd/vec.hpp"

namespace freshet {

template <class V, int D>
struct BedPoint {
  V b{0.0};             // m, upwards
  Vec<V, D> slope;      // grad b
  Sym<V, D> curvature;  // 1/m
};

// Cubic B-spline weights of the four nodes around a fraction f in [0, 1) of a cell, and their first and
// second derivatives.
template <class V>
struct SplineWeights {
  V w[4], d[4], dd[4];
  explicit KOKKOS_FORCEINLINE_FUNCTION SplineWeights(V f) {
    const V g = 1.0 - f, f2 = f * f, g2 = g * g;
    w[0] = (1.0 / 6) * g2 * g, w[3] = (1.0 / 6) * f2 * f;
    w[1] = 2.0 / 3 - f2 + 3.0 * w[3], w[2] = 2.0 / 3 - g2 + 3.0 * w[0];
    d[0] = -0.5 * g2, d[3] = 0.5 * f2;
    d[1] = 1.5 * f2 - 2.0 * f, d[2] = 2.0 * g - 1.5 * g2;
    dd[0] = g, dd[3] = f;
    dd[1] = 3.0 * f - 2.0, dd[2] = 3.0 * g - 2.0;
  }
};

// Where the samples of a cluster's particles begin in the table, and their values at an offset from there:
// loads put together, as sixteen gathers take twice the time (Zen 5).
KOKKOS_FORCEINLINE_FUNCTION const double* corners_of(const double* table, int first) { return table + first; }
KOKKOS_FORCEINLINE_FUNCTION double value_at(const double* corner, int offset) { return corner[offset]; }
#ifndef FRESHET_ONE_LANE
struct Corners {
  const double* p[lanes];
};
KOKKOS_FORCEINLINE_FUNCTION Corners corners_of(const double* table, LaneIndex first) {
  Corners c;
  for_each_lane(first, [&](int lane, int index) { c.p[lane] = table + index; });
  return c;
}
KOKKOS_FORCEINLINE_FUNCTION Lane value_at(const Corners& c, int k) {
  return Lane::of([&](int lane) { return c.p[lane][k]; });
}
#endif

template <int D>
class BedSpline {
 public:
  struct Lattice {
    std::array<double, 2> low, high;  // m, the region to cover (margins are added here)
    double spacing;                   // m, of the bottom particles
    double filter;  // m, standard deviation of the smoothing applied to the levels; 0 = none
  };

  // Samples level(x, y) [m] on the lattice.
  BedSpline(const std::function<double(double, double)>& level, const Lattice& lattice);

  // V: double, or a pack for the particles of a cluster.
  template <class V, int Dim>
  KOKKOS_INLINE_FUNCTION BedPoint<V, Dim> at(const Vec<V, Dim>& p) const {
    return sample<true>(p);
  }
  // Level and slope alone; the curvature is left at zero.
  template <class V, int Dim>
  KOKKOS_INLINE_FUNCTION BedPoint<V, Dim> sloped_at(const Vec<V, Dim>& p) const {
    return sample<false>(p);
  }

  std::array<double, 2> range() const { return range_; }  // m, lowest and highest level on the lattice
  double steepest() const { return steepest_; }           // a bound of |grad b| on the lattice
  int points() const { return nx_ * ny_; }

 private:
  template <bool curved, class V>
  KOKKOS_FORCEINLINE_FUNCTION BedPoint<V, 1> sample(const Vec<V, 1>& p) const {
    const auto i = first_node((p.x - x0_) * inv_spacing_, nx_);
    const SplineWeights<V> a((p.x - x0_) * inv_spacing_ - to_real(i) - 1.0);
    BedPoint<V, 1> s;
    const auto corners = corners_of(level_.data(), i);
    for (int k = 0; k < 4; ++k) {
      const V c = value_at(corners, k);
      s.b += a.w[k] * c;
      s.slope.x += a.d[k] * c;
      if constexpr (curved) s.curvature.xx += a.dd[k] * c;
    }
    s.slope.x *= inv_spacing_;
    if constexpr (curved) s.curvature.xx *= inv_spacing_ * inv_spacing_;
    return s;
  }

  template <bool curved, class V>
  KOKKOS_FORCEINLINE_FUNCTION BedPoint<V, 2> sample(const Vec<V, 2>& p) const {
    const auto i = first_node((p.x - x0_) * inv_spacing_, nx_),
               j = first_node((p.y - y0_) * inv_spacing_, ny_);
    const SplineWeights<V> a((p.x - x0_) * inv_spacing_ - to_real(i) - 1.0),
        b((p.y - y0_) * inv_spacing_ - to_real(j) - 1.0);
    const auto corners = corners_of(level_.data(), j * nx_ + i);
    BedPoint<V, 2> s;
    for (int l = 0; l < 4; ++l) {
      V row(0.0), row_d(0.0), row_dd(0.0);
      for (int k = 0; k < 4; ++k) {
        const V c = value_at(corners, l * nx_ + k);
        row += a.w[k] * c;
        row_d += a.d[k] * c;
        if constexpr (curved) row_dd += a.dd[k] * c;
      }
      s.b += b.w[l] * row;
      s.slope.x += b.w[l] * row_d;
      s.slope.y += b.d[l] * row;
      if constexpr (curved) {
        s.curvature.xx += b.w[l] * row_dd;
        s.curvature.xy += b.d[l] * row_d;
        s.curvature.yy += b.dd[l] * row;
      }
    }
    const double per = inv_spacing_, per2 = per * per;
    s.slope = V(per) * s.slope;
    if constexpr (curved) s.curvature.xx *= per2, s.curvature.xy *= per2, s.curvature.yy *= per2;
    return s;
  }

  // First of the four nodes around the coordinate s (in spacings); beyond the lattice the rim's cubic goes
  // on.
  template <class V>
  static KOKKOS_FORCEINLINE_FUNCTION auto first_node(V s, int n) {
    return to_index(clamp(s - 1.0, V(0.0), V(n - 4.0)));
  }

  double x0_ = 0, y0_ = 0, inv_spacing_ = 1;
  int nx_ = 0, ny_ = 1;
  std::array<double, 2> range_{};
  double steepest_ = 0;
  Field<double> level_;  // spline coefficients, x fastest
};

}  // namespace freshet
