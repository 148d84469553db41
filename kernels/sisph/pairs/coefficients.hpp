// The coefficients of the free surface's matrix, a_ij = g theta^2 dt^2 A_ij H_ij / d_ij (with friction / (1 +
// dt gamma_ij)), as passes over pairs ask for them: stored, one value per pair (linear::StoredPairs), or
// found anew from places, areas and depths. The latter read no value per pair, 4 bytes for the neighbour (8
// beside walls) instead of 12, and keep none: for machines whose cores wait for memory, or scenes that it is
// short for.
#pragma once
#include <variant>

#include "kernels/linear/pair_product.hpp"
#include "kernels/sisph/pairs/geometry.hpp"

namespace freshet::sisph {

// Of the water of one, how much the other must hold for the two to count as wet alike: 0 where one is dry
// ... 1. Continuous, so that what rounding leaves of a film, or not, is the same to its neighbours. (A
// solitary wave runs up 5.6 % too low with 0.2, 5.1 with 0.1, 4.7 with 0.05; of a change of the bed by
// rounding a quarter period of Thacker's bowl makes 2e-7 m with 0.2, 1.2e-6 m with 0.05.)
template <class V>
KOKKOS_FORCEINLINE_FUNCTION V wetness(V thinner, V deeper) {
  constexpr double alike = 0.05;
  return smaller(thinner / (alike * deeper + 1e-300), V(1.0));
}

// Depth between two particles: their mean where both are wet, the water above the higher bed where one is
// dry, and a mean of the two where one holds little.
template <bool drying, class V>
KOKKOS_FORCEINLINE_FUNCTION V face_depth(V depth_i, V depth_j, V bed_i, V bed_j) {
  const V mean = 0.5 * (depth_i + depth_j);
  if constexpr (!drying) return mean;
  const V above = larger(larger(bed_i + depth_i, bed_j + depth_j) - larger(bed_i, bed_j), V(0.0));
  return above + wetness(smaller(depth_i, depth_j), larger(depth_i, depth_j)) * (mean - above);
}

// What a particle brings to a_ij: its depths at n and of the Picard pass before (>= 0), its bed, dt gamma.
struct Holding {
  Lane depth, last, bed, drag;  // m, m, m, 1
};

// H_ij: the mean of the face depths at n and of the pass before.
template <bool drying>
KOKKOS_FORCEINLINE_FUNCTION Lane mean_face(const Holding& i, const Holding& j) {
  return 0.5 * (face_depth<drying>(i.depth, j.depth, i.bed, j.bed) +
                face_depth<drying>(i.last, j.last, i.bed, j.bed));
}

template <bool drying>
KOKKOS_FORCEINLINE_FUNCTION Lane coefficient(double stiffness, Lane area, Lane distance, const Holding& i,
                                             const Holding& j, bool dragged) {
  const Lane a = stiffness * area * mean_face<drying>(i, j) / distance;
  if (!dragged) return a;
  return a / (1.0 + 0.5 * (i.drag + j.drag));
}

// Where the holdings stand. Where all is wet the mean of both depths stands for each: H_ij is the same.
template <bool drying>
struct Holdings {
  Field<double> depth, last, bed, drag;
  bool dragged;  // else drag is empty

  // value(field): that of the lanes in question
  template <class Value>
  KOKKOS_FORCEINLINE_FUNCTION Holding with(const Value& value) const {
    const Lane now = value(depth);
    return {now, drying ? value(last) : now, drying ? value(bed) : Lane(0.0),
            dragged ? value(drag) : Lane(0.0)};
  }
  KOKKOS_FORCEINLINE_FUNCTION Holding of(const Lanes& me) const {
    return with([&](const Field<double>& f) { return me.load(f); });
  }
  KOKKOS_FORCEINLINE_FUNCTION Holding of(const int* particles) const {
    return with([&](const Field<double>& f) { return load_each(f.data(), particles); });
  }
};

// Values at the slots of an entry.
using freshet::load_each;
KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 1> load_each(const VecField<double, 1>& f, const int* slot) {
  return {load_each(f.x.data(), slot)};
}
KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 2> load_each(const VecField<double, 2>& f, const int* slot) {
  return {load_each(f.x.data(), slot), load_each(f.y.data(), slot)};
}

// What A_ij follows from; particles at rest have one smoothing length.
template <int D>
struct Places {
  double inv_h = 0;                 // 1/m
  VecField<double, D> x, lambda;    // m; multipliers of the closure, zero without; images included
  Field<double> omega, per_moment;  // m^D; 1 / s_i
};

template <int D, class Kernel, bool drying>
struct RecomputedPairs {
  Kernel kernel;
  Places<D> at;
  Holdings<drying> water;
  double stiffness;  // g theta^2 dt^2

  // pair(entry, j, a_ij) for the entries of a slice.
  template <class Pair>
  KOKKOS_FORCEINLINE_FUNCTION void for_each(const PairView& pairs, int slice, const Pair& pair) const {
    const Lanes me = pairs(slice);
    const Vec<Lane, D> xi = me.load(at.x), lambda = me.load(at.lambda);
    const Lane omega = me.load(at.omega), per = me.load(at.per_moment), inv_h(at.inv_h);
    const Holding mine = water.of(me);
    pairs.for_each(slice, [&](int e, PairIndex j) {
      const int *other = pairs.j.data() + PairView::at(e), *slot = pairs.slot.data() + PairView::at(e);
      const PairShape<D> shape = pair_shape<D>(kernel, load_each(at.x, slot) - xi, inv_h);
      const Lane open = pair_area(omega, load_each(at.omega.data(), other), shape.slope, per,
                                  load_each(at.per_moment.data(), other));
      const Lane area = open * closing<D>(lambda, load_each(at.lambda, slot), shape.n);
      pair(e, j, coefficient<drying>(stiffness, area, shape.distance, mine, water.of(other), water.dragged));
    });
  }
  KOKKOS_FORCEINLINE_FUNCTION Lane weighted_sum(const PairView& pairs, int slice,
                                                const Field<double>& x) const {
    Lane sum(0.0);
    for_each(pairs, slice, [&](int e, PairIndex, Lane a) {
      sum += a * load_each(x.data(), pairs.j.data() + PairView::at(e));
    });
    return sum;
  }
};

template <int D>
using AnyPairs =
    std::variant<linear::StoredPairs, RecomputedPairs<D, CubicSpline<D>, false>,
                 RecomputedPairs<D, CubicSpline<D>, true>, RecomputedPairs<D, GeneralKernel<D>, false>,
                 RecomputedPairs<D, GeneralKernel<D>, true>>;

}  // namespace freshet::sisph
