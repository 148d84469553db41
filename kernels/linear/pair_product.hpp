// The product with a matrix of stored pairs: y_i = mask_i (diagonal_i x_i - sum_j a_ij x_j), one slice of lanes at a time.
// Bytes from memory per row, x in cache: 12 per stored entry (a and j, padding included), 40 for diagonal, mask, x and y with
// the load before its store.
#pragma once
#include "cellgrid/pairs.hpp"

namespace freshet::linear {

// slices(k): the k-th slice to visit. Returns the slice's part of x . y (OrderedSums adds them).
template <class Slices>
struct PairProduct {
  PairView pairs;
  Slices slices;
  Field<double> a, diagonal, mask, x, y;

  KOKKOS_FUNCTION Kokkos::Array<double, 1> operator()(int k) const {
    const int s = slices(k);
    const Lanes me = pairs(s);
    const Lane xi = me.load(x), row = me.load(mask) * (me.load(diagonal) * xi - pairs.weighted_sum(s, a, x)), product = xi * row;
    me.store(y, row);
    double total = 0;
    for (int l = 0; l < me.count; ++l) total += lane_of(product, l);
    return {{total}};
  }
};

}  // namespace freshet::linear
