// How far the two ends of a pair are apart: r and 1/r of r^2 as each instruction set has them soonest.
#pragma once
#include <cstdint>

#include "cellgrid/simd/lanes.hpp"
#include "cellgrid/simd/vec.hpp"

namespace freshet {

// Added to r^2 so that a particle's pair with itself has a finite 1/r (and no effect, since x_ij = 0). Large
// enough that rsqrt's intermediate squares stay finite when r^2 is multiplied by small densities squared. In
// single precision as large as that needs.
inline constexpr double tiny_square = 1e-200;  // m2
template <class V>
inline constexpr double least_square = tiny_square;
#ifndef FRESHET_DEVICE
template <int W, int B>
inline constexpr double least_square<pack<float, W, B>> = 1e-24;  // m2
#endif

// Whether the set has an estimate of 1/sqrt in double precision: 1/r first, r from it. Where not, a root and
// a quotient are as fast as a series and leave more room for other work (docs/log/performance.md): r first,
// and taken ahead, as it takes twenty cycles.
template <class V>
inline constexpr bool estimates_rsqrt = std::is_same_v<V, double>;
#ifndef FRESHET_DEVICE
template <class T, int W, int B>
inline constexpr bool estimates_rsqrt<pack<T, W, B>> = B == 64 && register_bytes == 64;
#endif

template <class V, int D>
struct Distance {
  Vec<V, D> x;  // m
  V square;     // m2
  V root;       // m, where roots are taken ahead
};
template <class V, int D>
KOKKOS_FORCEINLINE_FUNCTION Distance<V, D> distance(const Vec<V, D>& x) {
  const V square = dot(x, x) + least_square<V>;
  return {x, square, estimates_rsqrt<V> ? square : root(square)};
}

// 1/(factor r), 1/r and r
template <class V>
struct PairLength {
  V per_factor, per_r, r;
};
template <class V, int D>
KOKKOS_FORCEINLINE_FUNCTION PairLength<V> length(const Distance<V, D>& apart, V factor) {
  if constexpr (estimates_rsqrt<V>) {
    const V per = rsqrt(factor * factor * apart.square), per_r = per * factor;
    return {per, per_r, apart.square * per_r};
  } else {
    const V per = 1.0 / (factor * apart.root);
    return {per, per * factor, apart.root};
  }
}
template <class V, int D>
KOKKOS_FORCEINLINE_FUNCTION PairLength<V> length(const Distance<V, D>& apart) {
  if constexpr (estimates_rsqrt<V>) {
    const V per_r = rsqrt(apart.square);
    return {per_r, per_r, apart.square * per_r};
  } else {
    const V per_r = 1.0 / apart.root;
    return {per_r, per_r, apart.root};
  }
}

// The particles near a cluster, or a part of one.
struct NearList {
  const int* j;
  const std::uint8_t* place;  // of the part's in j; none: all of j
  int n;
  KOKKOS_FORCEINLINE_FUNCTION int operator[](int k) const { return j[place ? place[k] : k]; }
};

// pair(j, apart(j)) for each of them, where roots take long the next one's ahead of this one's pair: two
// halves of a long chain of operations side by side. (Ahead of a root and a quotient too many numbers wait:
// slower by a quarter.)
template <class V, class Apart, class Pair>
KOKKOS_FORCEINLINE_FUNCTION void for_each_distance(const NearList& near, const Apart& apart,
                                                   const Pair& pair) {
  if constexpr (estimates_rsqrt<V>) {
    for (int k = 0; k < near.n; ++k) pair(near.j[k], apart(near.j[k]));
  } else if (near.n > 0) {
    int j = near[0];
    auto next = apart(j);
    for (int k = 1; k < near.n; ++k) {
      const auto here = next;
      const int i = j;
      j = near[k];
      next = apart(j);
      pair(i, here);
    }
    pair(j, next);
  }
}

}  // namespace freshet
