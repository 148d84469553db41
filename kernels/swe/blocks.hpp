// Particles without regard to rows, `lanes` at a time, for passes that look at no neighbours.
#pragma once
#include "cellgrid/clusters.hpp"

namespace freshet::swe {

inline int blocks(int n) { return (n + lanes - 1) / lanes; }
KOKKOS_FORCEINLINE_FUNCTION Lanes block(int b, int n) { return {b * lanes, smaller(lanes, n - b * lanes)}; }

// In which lanes a particle's kind is that of the owner.
KOKKOS_FORCEINLINE_FUNCTION auto owned_by(int owner, LaneIndex kind) {
  const Lane off = to_real(kind) - Lane(static_cast<double>(owner));
  return off * off < Lane(0.25);
}

// The sum of one(i), two numbers of a particle.
template <class One>
KOKKOS_FORCEINLINE_FUNCTION Kokkos::Array<double, 2> sum_of(const Lanes& me, const One& one) {
  Kokkos::Array<double, 2> sum{};
  for (int i = me.first; i < me.first + me.count; ++i) {
    const Kokkos::Array<double, 2> value = one(i);
    sum[0] += value[0], sum[1] += value[1];
  }
  return sum;
}

}  // namespace freshet::swe
