// The water near a place of an open boundary, fitted to the particles there.
#pragma once
#include "kernels/linear/small_dense.hpp"
#include "kernels/sisph/open/open.hpp"

namespace freshet::sisph {
namespace {

template <int D>
struct Found {
  double level = 0, bed = 0;  // m
  Vec<double, D> v;           // m/s
  bool wet = false;
};

// Quadratic least squares over the wet particles near a place; their mean beside dry ones.
template <int D>
struct OpenFit {
  TracedWater<D> w;
  static constexpr int terms = D == 1 ? 3 : 6;
  using Terms = Column<double, terms>;

  static KOKKOS_FORCEINLINE_FUNCTION Terms monomials(const Vec<double, 1>& a) {
    return {{1, a.x, a.x * a.x}};
  }
  static KOKKOS_FORCEINLINE_FUNCTION Terms monomials(const Vec<double, 2>& a) {
    return {{1, a.x, a.y, a.x * a.x, a.x * a.y, a.y * a.y}};
  }

  // visit(j, weight, offset in spacings)
  template <class Visit>
  KOKKOS_FUNCTION void for_each(const Vec<double, D>& place, const Visit& visit) const {
    constexpr double reach = 2.6;
    const double far = reach * w.spacing, per = 1 / w.spacing;
    w.rows.for_each_run(place.x, place.x, y_of(place), y_of(place), far, [&](int begin, int end) {
      for (int j = begin; j < end; ++j) {
        const Vec<double, D> d = per * (at(w.x, j) - place);
        const double left = 1 - dot(d, d) / (reach * reach);
        if (left > 0) visit(j, left * left, d);
      }
    });
  }

  KOKKOS_FUNCTION Found<D> operator()(const Vec<double, D>& place) const {
    constexpr double least = 1e-4;  // of a pivot: directions that the particles do not span are left out
    Symmetric<double, terms> m{};
    bool beside_dry = false;
    for_each(place, [&](int j, double weight, const Vec<double, D>& d) {
      if (w.water.depth(j) > 0) m.add_square(weight, monomials(d));
      else beside_dry = true;
    });
    Found<D> found;
    found.wet = m(0, 0) > 0;
    if (!found.wet) return found;
    Terms first{};
    first[0] = 1;
    first =
        beside_dry ? Terms{{1 / m(0, 0)}} : Factored<double, terms>(m, Pivots<double>{least}).solve(first);
    for_each(place, [&](int j, double weight, const Vec<double, D>& d) {
      if (!(w.water.depth(j) > 0)) return;
      const double share = weight * dot(first, monomials(d));
      found.level += share * (w.water.bed(j) + w.water.depth(j));
      found.bed += share * w.water.bed(j);
      found.v += share * at(w.water.v, j);
    });
    return found;
  }
};

KOKKOS_FORCEINLINE_FUNCTION Vec<double, 1> solved(const Sym<double, 1>& m, const Vec<double, 1>& a) {
  return {m.xx > 0 ? a.x / m.xx : 0.0};
}
KOKKOS_FORCEINLINE_FUNCTION Vec<double, 2> solved(const Sym<double, 2>& m, const Vec<double, 2>& a) {
  const double det = m.xx * m.yy - m.xy * m.xy, half = 0.5 * (m.xx + m.yy),
               per = det > 0.01 * half * half ? 1 / det : 0.0;
  return {per * (m.yy * a.x - m.xy * a.y), per * (m.xx * a.y - m.xy * a.x)};
}

}  // namespace
}  // namespace freshet::sisph
