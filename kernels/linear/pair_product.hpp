// The product with a matrix of pairs: y_i = mask_i (diagonal_i x_i - sum_j a_ij x_j), one slice of lanes at a
// time. The operator is one struct: weighted_sum(pairs, slice, x) is sum_j a_ij x_j, for_each(pairs, slice,
// pair) calls pair(entry, j, a_ij). Bytes from memory per row, x in cache: 12 per stored entry (a and j,
// padding included), 40 for diagonal, mask, x and y with the load before its store.
#pragma once
#include "cellgrid/particles/pairs.hpp"
#include "cellgrid/particles/sums.hpp"

namespace freshet::linear {

struct StoredPairs {
  Field<double> a;  // one value per entry and lane, zero in padding

  template <class Pair>
  KOKKOS_FORCEINLINE_FUNCTION void for_each(const PairView& pairs, int slice, const Pair& pair) const {
    pairs.for_each(slice, [&](int e, PairIndex j) { pair(e, j, PairView::load(a, e)); });
  }
  KOKKOS_FORCEINLINE_FUNCTION Lane weighted_sum(const PairView& pairs, int slice,
                                                const Field<double>& x) const {
    return pairs.weighted_sum(slice, a, x);
  }
};

// slices(k): the k-th slice to visit. Returns the terms of x . y.
template <class Slices, class Coefficients = StoredPairs>
struct PairProduct {
  PairView pairs;
  Slices slices;
  Coefficients a;
  Field<double> diagonal, mask, x, y;

  KOKKOS_FUNCTION LaneAddends<1> operator()(int k) const {
    const int s = slices(k);
    const Lanes me = pairs(s);
    const Lane xi = me.load(x), row = me.load(mask) * (me.load(diagonal) * xi - a.weighted_sum(pairs, s, x)),
               product = xi * row;
    me.store(y, row);
    return {{counted(me, product)}};
  }
};

// Reads diagonal, mask, x and what y was, writes y.
inline constexpr Cost product_cost{2, 5, 5};

// Of a pass over the entries of some slices: for measurements. Padding, whose slot is the particle's own, is
// no pair.
template <class Slices>
Work work_of_slices(const Cost& cost, const PairView& view, const Slices& slices) {
  double particles = 0, entries = 0, pairs = 0;
  Kokkos::parallel_reduce(
      "linear::count_entries", Range(0, slices.count),
      KOKKOS_LAMBDA(int k, double& p, double& all, double& own) {
        const int s = slices(k);
        const Lanes me = view(s);
        p += me.count;
        for (int e = view.start(s); e < view.start(s + 1); ++e)
          for (int l = 0; l < me.count; ++l) {
            all += 1;
            own += view.slot(PairView::at(e, l)) != me.particle(l);
          }
      },
      particles, entries, pairs);
  Work work = work_of_entries(cost, particles, entries);
  work.pairs = pairs;
  return work;
}

}  // namespace freshet::linear
