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

}  // namespace freshet::linear
