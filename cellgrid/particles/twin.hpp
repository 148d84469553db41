// Pair arithmetic in single precision, where registers have the lanes for it (AVX-512) two neighbours at
// once: the first half of a Twin's lanes then holds a cluster against one neighbour, the second half against
// another. Positions are subtracted in double before they are rounded, so that a distance has single
// precision wherever the water lies. On a GPU, or with one lane per cluster, a Twin is a double and holds one
// neighbour: there only the records are in single precision.
#pragma once
#include "cellgrid/particles/clusters.hpp"
#include "cellgrid/simd/distance.hpp"

namespace freshet {

// What a pair loop reads of a neighbour: N numbers side by side, one load for all of them.
template <int N>
struct alignas(4 * N) SingleRecord {
  float value[N];
};

#ifdef FRESHET_ONE_LANE
using Twin = double;
inline constexpr int neighbours_at_once = 1;

KOKKOS_FORCEINLINE_FUNCTION Twin twice(double a) { return a; }
KOKKOS_FORCEINLINE_FUNCTION double folded(Twin a) { return a; }
KOKKOS_FORCEINLINE_FUNCTION double folded_largest(Twin a) { return a; }
KOKKOS_FORCEINLINE_FUNCTION Twin apart(double i, double a, double) { return i - a; }
KOKKOS_FORCEINLINE_FUNCTION Twin kept(bool) { return 1.0; }

template <int N>
class TwinRecord {
 public:
  KOKKOS_FORCEINLINE_FUNCTION TwinRecord(const SingleRecord<N>& a, const SingleRecord<N>&) : a_(a) {}
  template <int k>
  KOKKOS_FORCEINLINE_FUNCTION Twin get() const {
    return a_.value[k];
  }

 private:
  const SingleRecord<N>& a_;
};
#else
inline constexpr int neighbours_at_once = register_bytes == 64 ? 2 : 1;
using Single = pack<float, lanes>;
using Twin = pack<float, neighbours_at_once * lanes>;

KOKKOS_FORCEINLINE_FUNCTION Single narrow(Lane a) { return convert<float>(a); }
KOKKOS_FORCEINLINE_FUNCTION Lane widen(Single a) { return convert<double>(a); }
// a for one neighbour, b for the other; where there is one, a.
template <class T = Twin>
KOKKOS_FORCEINLINE_FUNCTION T beside(Single a, [[maybe_unused]] Single b) {
  if constexpr (std::is_same_v<T, Single>) return a;
  else return join(a, b);
}
KOKKOS_FORCEINLINE_FUNCTION Twin twice(Lane a) { return beside(narrow(a), narrow(a)); }
// The sum, in double, and the larger of the neighbours'.
KOKKOS_FORCEINLINE_FUNCTION Lane folded(pack<float, 2 * lanes> a) {
  return widen(first_half(a)) + widen(second_half(a));
}
KOKKOS_FORCEINLINE_FUNCTION Lane folded(Single a) { return widen(a); }
KOKKOS_FORCEINLINE_FUNCTION Lane folded_largest(pack<float, 2 * lanes> a) {
  return larger(widen(first_half(a)), widen(second_half(a)));
}
KOKKOS_FORCEINLINE_FUNCTION Lane folded_largest(Single a) { return widen(a); }
// i - a and i - b
KOKKOS_FORCEINLINE_FUNCTION Twin apart(Lane i, double a, double b) {
  return beside(narrow(i - a), narrow(i - b));
}
// 1 where a neighbour counts: the second half only where there are two.
KOKKOS_FORCEINLINE_FUNCTION Twin kept(bool both) { return beside(Single(1.0f), Single(both ? 1.0f : 0.0f)); }

// The records of two neighbours, number by number: loaded whole, never by way of memory (a wide load of what
// narrow stores have just left there waits for them). Of one neighbour: each number loaded into all lanes.
template <int N>
KOKKOS_FORCEINLINE_FUNCTION auto held(const SingleRecord<N>& record) {
  static_assert(N == 4 || N == 2 * lanes, "a quarter of a Twin, or a whole one");
  if constexpr (neighbours_at_once == 1) return &record;
  else if constexpr (N == 4) return first_four<Twin>(record.value);
  else return loaded<Twin>(record.value);
}
template <int N>
class TwinRecord {
 public:
  KOKKOS_FORCEINLINE_FUNCTION TwinRecord(const SingleRecord<N>& a, const SingleRecord<N>& b)
      : a_(held(a)), b_(held(b)) {}
  template <int k>
  KOKKOS_FORCEINLINE_FUNCTION Twin get() const {
    if constexpr (neighbours_at_once == 2)
      return halves_of<k>(a_, b_, std::make_integer_sequence<int, 2 * lanes>{});
    else return Twin(a_->value[k]);
  }

 private:
  decltype(held(std::declval<const SingleRecord<N>&>())) a_, b_;
};
#endif

KOKKOS_FORCEINLINE_FUNCTION Vec<Twin, 1> apart(const Vec<Lane, 1>& i, const VecField<double, 1>& x, int a,
                                               int b) {
  return {apart(i.x, x.x(a), x.x(b))};
}
KOKKOS_FORCEINLINE_FUNCTION Vec<Twin, 2> apart(const Vec<Lane, 2>& i, const VecField<double, 2>& x, int a,
                                               int b) {
  return {apart(i.x, x.x(a), x.x(b)), apart(i.y, x.y(a), x.y(b))};
}
struct Twice {
  KOKKOS_FORCEINLINE_FUNCTION Twin operator()(const Lane& a) const { return twice(a); }
};
struct Folded {
  KOKKOS_FORCEINLINE_FUNCTION Lane operator()(const Twin& a) const { return folded(a); }
};

// A cluster's neighbours two by two: pair(a, b, keep). The last of an odd number comes with itself, keep 0 in
// the second half.
template <class Pair>
KOKKOS_FORCEINLINE_FUNCTION void for_each_twin(const NeighbourView& near, int cluster, const Pair& pair) {
  const int n = near.length(cluster);
  const int* j = &near.list(cluster, 0);
  for (int k = 0; k < n; k += neighbours_at_once) {
    const bool both = k + neighbours_at_once <= n;
    pair(j[k], j[both ? k + neighbours_at_once - 1 : k], kept(both));
  }
}

}  // namespace freshet
