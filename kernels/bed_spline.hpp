// The bed between its bottom particles: a tensor-product cubic B-spline through their (filtered) levels, so that b, grad b
// and the curvature are consistent derivatives of one function (SWE-FORMULAS 3.4). Tabulated once; 4^D points per sample.
#pragma once
#include <array>
#include <functional>

#include "cellgrid/pack.hpp"
#include "cellgrid/vec.hpp"

namespace freshet {

template <int D>
struct BedPoint {
  double b;                   // m, upwards
  Vec<double, D> slope;       // grad b
  Sym<double, D> curvature;   // 1/m
};

// Cubic B-spline weights of the four nodes around a fraction f in [0, 1) of a cell, and their first and second derivatives.
struct SplineWeights {
  double w[4], d[4], dd[4];
  explicit KOKKOS_FORCEINLINE_FUNCTION SplineWeights(double f) {
    const double g = 1 - f, f2 = f * f, g2 = g * g;
    w[0] = g2 * g / 6, w[3] = f2 * f / 6;
    w[1] = 2.0 / 3 - f2 + 0.5 * f2 * f, w[2] = 2.0 / 3 - g2 + 0.5 * g2 * g;
    d[0] = -0.5 * g2, d[3] = 0.5 * f2;
    d[1] = -2 * f + 1.5 * f2, d[2] = 2 * g - 1.5 * g2;
    dd[0] = g, dd[3] = f;
    dd[1] = -2 + 3 * f, dd[2] = -2 + 3 * g;
  }
};

template <int D>
class BedSpline {
 public:
  struct Lattice {
    std::array<double, 2> low, high;  // m, the region to cover (margins are added here)
    double spacing;                   // m, of the bottom particles
    double filter;                    // m, standard deviation of the smoothing applied to the levels; 0 = none
  };

  // Samples level(x, y) [m] on the lattice.
  BedSpline(const std::function<double(double, double)>& level, const Lattice& lattice);

  KOKKOS_INLINE_FUNCTION BedPoint<D> at(const Vec<double, D>& p) const {
    int i = 0, j = 0;
    const SplineWeights a(locate((p.x - x0_) * inv_spacing_, nx_, i));
    BedPoint<D> s{};
    if constexpr (D == 1) {
      for (int k = 0; k < 4; ++k) {
        const double c = level_(i + k);
        s.b += a.w[k] * c;
        s.slope.x += a.d[k] * c;
        s.curvature.xx += a.dd[k] * c;
      }
    } else {
      const SplineWeights b(locate((p.y - y0_) * inv_spacing_, ny_, j));
      for (int l = 0; l < 4; ++l) {
        double row = 0, row_d = 0, row_dd = 0;
        for (int k = 0; k < 4; ++k) {
          const double c = level_((j + l) * nx_ + i + k);
          row += a.w[k] * c;
          row_d += a.d[k] * c;
          row_dd += a.dd[k] * c;
        }
        s.b += b.w[l] * row;
        s.slope.x += b.w[l] * row_d;
        s.slope.y += b.d[l] * row;
        s.curvature.xx += b.w[l] * row_dd;
        s.curvature.xy += b.d[l] * row_d;
        s.curvature.yy += b.dd[l] * row;
      }
      s.slope.y *= inv_spacing_;
      s.curvature.xy *= inv_spacing_ * inv_spacing_;
      s.curvature.yy *= inv_spacing_ * inv_spacing_;
    }
    s.slope.x *= inv_spacing_;
    s.curvature.xx *= inv_spacing_ * inv_spacing_;
    return s;
  }

  std::array<double, 2> range() const { return range_; }  // m, lowest and highest level on the lattice
  int points() const { return nx_ * ny_; }

 private:
  // First of the four nodes and the fraction between the middle two; beyond the lattice the rim's cubic goes on.
  static KOKKOS_FORCEINLINE_FUNCTION double locate(double s, int n, int& first) {
    const double cell = s > 1 ? (s < n - 3 ? floor(s) : n - 3) : 1;
    first = static_cast<int>(cell) - 1;
    return clamp(s - cell, -1.0, 2.0);
  }

  double x0_ = 0, y0_ = 0, inv_spacing_ = 1;
  int nx_ = 0, ny_ = 1;
  std::array<double, 2> range_{};
  Field<double> level_;  // spline coefficients, x fastest
};

}  // namespace freshet
