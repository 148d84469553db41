// Lane: the value type of the pair loops. A pair body written for a value type V runs with V = pack<double,
// 8> on a CPU and with V = double on a GPU or as the scalar reference, for which the words of pack.hpp are
// here too.
#pragma once
#include "cellgrid/simd/pack.hpp"

#if defined(FRESHET_DEVICE) || defined(FRESHET_SCALAR)
#define FRESHET_ONE_LANE
#endif

namespace freshet {

template <class V>
inline constexpr bool in_one_register = true;
#ifndef FRESHET_DEVICE
template <class T, int W, int B>
inline constexpr bool in_one_register<pack<T, W, B>> = pack<T, W, B>::one_register;
#endif

// Consecutive values in memory, register by register: what is written in pieces and read whole waits.
template <class V, class T>
KOKKOS_FORCEINLINE_FUNCTION V loaded(const T* from) {
  if constexpr (in_one_register<V>) {
    V value;
    __builtin_memcpy(&value, from, sizeof value);
    return value;
  } else {
    constexpr int half = sizeof(V) / sizeof(T) / 2;
    return {loaded<typename V::Half>(from), loaded<typename V::Half>(from + half)};
  }
}
template <class V, class T>
KOKKOS_FORCEINLINE_FUNCTION void store(T* to, const V& value) {
  if constexpr (in_one_register<V>) {
    __builtin_memcpy(to, &value, sizeof value);
  } else {
    constexpr int half = sizeof(V) / sizeof(T) / 2;
    store(to, value.low);
    store(to + half, value.high);
  }
}

// ---- The same words for plain scalars
// -----------------------------------------------------------------------------------------
KOKKOS_FORCEINLINE_FUNCTION bool any(bool m) { return m; }
KOKKOS_FORCEINLINE_FUNCTION int count(bool m) { return m; }
KOKKOS_FORCEINLINE_FUNCTION double select(bool m, double a, double b) { return m ? a : b; }
KOKKOS_FORCEINLINE_FUNCTION double larger_where(bool m, double a, double b) { return m && a < b ? b : a; }
KOKKOS_FORCEINLINE_FUNCTION double turned_by(double a, double b) { return b < 0 ? -a : a; }
KOKKOS_FORCEINLINE_FUNCTION double size_of(double a) { return a < 0 ? -a : a; }
KOKKOS_FORCEINLINE_FUNCTION double rsqrt(double a) {
#if defined(__CUDA_ARCH__) || defined(__HIP_DEVICE_COMPILE__)
  return ::rsqrt(a);  // one operation there, root and quotient two
#else
  return 1.0 / ::sqrt(a);
#endif
}
KOKKOS_FORCEINLINE_FUNCTION double root(double a) { return ::sqrt(a); }
KOKKOS_FORCEINLINE_FUNCTION int to_index(double a) { return static_cast<int>(a); }  // cut towards zero
KOKKOS_FORCEINLINE_FUNCTION double to_real(int a) { return a; }
KOKKOS_FORCEINLINE_FUNCTION double gather(const double* table, int index) { return table[index]; }
KOKKOS_FORCEINLINE_FUNCTION double inverse_cbrt(double a) { return 1.0 / ::cbrt(a); }  // a > 0
KOKKOS_FORCEINLINE_FUNCTION double lane_of(double a, int) { return a; }
KOKKOS_FORCEINLINE_FUNCTION void set_lane(double& a, int, double value) { a = value; }
KOKKOS_FORCEINLINE_FUNCTION double largest(double a) { return a; }
KOKKOS_FORCEINLINE_FUNCTION double smallest(double a) { return a; }
// A number of its own: a product is not contracted into a multiply-add with what is done next.
KOKKOS_FORCEINLINE_FUNCTION double rounded(double a) {
#if defined(__CUDA_ARCH__) || defined(__HIP_DEVICE_COMPILE__)
  return __dadd_rn(a, 0.0);
#elif defined(__GNUC__) && __GNUC__ >= 12 && !defined(__clang__) && !defined(FRESHET_DEVICE)
  return __builtin_assoc_barrier(a);
#else
  return a;
#endif
}

template <class V>
KOKKOS_FORCEINLINE_FUNCTION V clamp(V value, V low, V high) {
  return smaller(larger(value, low), high);
}

// ---- Lanes: those of a cluster
// ------------------------------------------------------------------------------------------------
#ifdef FRESHET_ONE_LANE
inline constexpr int lanes = 1;
using Lane = double;
using LaneIndex = int;
// value(lane) in each lane.
template <class V, class Value>
KOKKOS_FORCEINLINE_FUNCTION V lanes_of(const Value& value) {
  return value(0);
}
template <class T, class Use>
KOKKOS_FORCEINLINE_FUNCTION void for_each_lane(T a, const Use& use) {
  use(0, a);
}
KOKKOS_FORCEINLINE_FUNCTION bool first_lanes(int n) { return n > 0; }
#else
inline constexpr int lanes = 8;
using Lane = pack<double, lanes>;
using LaneIndex = pack<int, lanes>;  // for look-ups in tables
template <class V, class Value>
KOKKOS_FORCEINLINE_FUNCTION V lanes_of(const Value& value) {
  return V::of(value);
}
KOKKOS_FORCEINLINE_FUNCTION Lane::Mask first_lanes(int n) {
  return Lane::of([](int lane) { return lane; }) < Lane(n);
}
#endif

// ---- Pair loops register by register
// ------------------------------------------------------------------------------------------ A cluster has
// two parts, the halves of its lanes, where these fill several registers.
#ifdef FRESHET_ONE_LANE
inline constexpr int parts_of_cluster = 1;
#else
inline constexpr int parts_of_cluster = Lane::one_register ? 1 : 2;
#endif

// loop(a, part) of values a of type V (a pack, a Vec of packs, a struct with an each() of its own), one
// register of their lanes after the other: a body that fills the registers twice over would be spilt in every
// pair. What the loop returns is put together again.
#ifdef FRESHET_DEVICE
template <class V, class Values, class Loop>
KOKKOS_FORCEINLINE_FUNCTION auto by_register(const Values& a, const Loop& loop) {
  return loop(a, 0);
}
#else
struct FirstHalf {
  template <class P>
  KOKKOS_FORCEINLINE_FUNCTION auto operator()(const P& a) const {
    return first_half(a);
  }
};
struct SecondHalf {
  template <class P>
  KOKKOS_FORCEINLINE_FUNCTION auto operator()(const P& a) const {
    return second_half(a);
  }
};
struct Join {
  template <class P>
  KOKKOS_FORCEINLINE_FUNCTION auto operator()(const P& a, const P& b) const {
    return join(a, b);
  }
};
template <class V, class Values, class Loop>
KOKKOS_FORCEINLINE_FUNCTION auto by_register(const Values& a, const Loop& loop) {
  if constexpr (in_one_register<V>) {
    return loop(a, 0);
  } else {
    const auto of_half = [&](int part) FRESHET_INLINE_LAMBDA {
      return [&loop, part](const auto& some, int) FRESHET_INLINE_LAMBDA { return loop(some, part); };
    };
    using Half = typename V::Half;
    const auto first = by_register<Half>(each(FirstHalf{}, a), of_half(0));
    const auto second = by_register<Half>(each(SecondHalf{}, a), of_half(1));
    return each(Join{}, first, second);
  }
}
#endif

}  // namespace freshet
