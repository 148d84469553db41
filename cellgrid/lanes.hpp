// Packs of several registers, and Lane: the value type of the pair loops. A pair body written for a value type V runs with
// V = pack<double, 8> on a CPU and with V = double on a GPU or as the scalar reference.
#pragma once
#include "cellgrid/pack.hpp"

#if defined(FRESHET_DEVICE) || defined(FRESHET_SCALAR)
#define FRESHET_ONE_LANE
#endif

// Of a lambda: no call, and no memory for what it returns.
#define FRESHET_INLINE_LAMBDA __attribute__((always_inline))

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

#ifndef FRESHET_DEVICE
// ---- Packs in two halves ----------------------------------------------------------------------------------------------------
template <class P>
struct LaneMask<P, false> {
  LaneMask<typename P::Half> low, high;
  friend KOKKOS_FORCEINLINE_FUNCTION LaneMask operator&(LaneMask a, LaneMask b) { return {a.low & b.low, a.high & b.high}; }
  friend KOKKOS_FORCEINLINE_FUNCTION LaneMask operator|(LaneMask a, LaneMask b) { return {a.low | b.low, a.high | b.high}; }
  friend KOKKOS_FORCEINLINE_FUNCTION LaneMask operator!(LaneMask a) { return {!a.low, !a.high}; }
  friend KOKKOS_FORCEINLINE_FUNCTION bool any(LaneMask m) { return any(m.low | m.high); }
  friend KOKKOS_FORCEINLINE_FUNCTION int count(LaneMask m) { return count(m.low) + count(m.high); }
};

template <class T, int W, int B>
struct pack<T, W, B, false> {
  static constexpr bool one_register = false;
  using Half = pack<T, W / 2, B>;
  using Mask = LaneMask<pack>;
  Half low, high;

  pack() = default;
  KOKKOS_FORCEINLINE_FUNCTION pack(T scalar) : low(scalar), high(scalar) {}
  KOKKOS_FORCEINLINE_FUNCTION pack(Half first, Half second) : low(first), high(second) {}
  template <class Value>
  static KOKKOS_FORCEINLINE_FUNCTION pack of(const Value& value) {
    return {Half::of(value), Half::of([&](int lane) { return value(W / 2 + lane); })};
  }

  KOKKOS_FORCEINLINE_FUNCTION T operator[](int lane) const { return lane < W / 2 ? low[lane] : high[lane - W / 2]; }
  KOKKOS_FORCEINLINE_FUNCTION void set(int lane, T value) {
    if (lane < W / 2) low.set(lane, value);
    else high.set(lane - W / 2, value);
  }

  KOKKOS_FORCEINLINE_FUNCTION pack& operator+=(pack b) { return *this = *this + b; }
  KOKKOS_FORCEINLINE_FUNCTION pack& operator-=(pack b) { return *this = *this - b; }
  KOKKOS_FORCEINLINE_FUNCTION pack& operator*=(pack b) { return *this = *this * b; }
  friend KOKKOS_FORCEINLINE_FUNCTION pack operator+(pack a, pack b) { return {a.low + b.low, a.high + b.high}; }
  friend KOKKOS_FORCEINLINE_FUNCTION pack operator-(pack a, pack b) { return {a.low - b.low, a.high - b.high}; }
  friend KOKKOS_FORCEINLINE_FUNCTION pack operator*(pack a, pack b) { return {a.low * b.low, a.high * b.high}; }
  friend KOKKOS_FORCEINLINE_FUNCTION pack operator/(pack a, pack b) { return {a.low / b.low, a.high / b.high}; }
  friend KOKKOS_FORCEINLINE_FUNCTION pack operator-(pack a) { return {-a.low, -a.high}; }
  friend KOKKOS_FORCEINLINE_FUNCTION Mask operator<(pack a, pack b) { return {a.low < b.low, a.high < b.high}; }
  friend KOKKOS_FORCEINLINE_FUNCTION pack select(Mask m, pack a, pack b) {
    return {select(m.low, a.low, b.low), select(m.high, a.high, b.high)};
  }
  friend KOKKOS_FORCEINLINE_FUNCTION pack smaller(pack a, pack b) { return {smaller(a.low, b.low), smaller(a.high, b.high)}; }
  friend KOKKOS_FORCEINLINE_FUNCTION pack larger(pack a, pack b) { return {larger(a.low, b.low), larger(a.high, b.high)}; }
  friend KOKKOS_FORCEINLINE_FUNCTION pack larger_where(Mask m, pack a, pack b) {
    return {larger_where(m.low, a.low, b.low), larger_where(m.high, a.high, b.high)};
  }
  friend KOKKOS_FORCEINLINE_FUNCTION pack turned_by(pack a, pack b) { return {turned_by(a.low, b.low), turned_by(a.high, b.high)}; }
  friend KOKKOS_FORCEINLINE_FUNCTION pack size_of(pack a) { return {size_of(a.low), size_of(a.high)}; }
  friend KOKKOS_FORCEINLINE_FUNCTION pack root(pack a) { return {root(a.low), root(a.high)}; }
  friend KOKKOS_FORCEINLINE_FUNCTION pack rsqrt(pack a) { return {rsqrt(a.low), rsqrt(a.high)}; }
  friend KOKKOS_FORCEINLINE_FUNCTION pack bits_as_number(pack a) { return {bits_as_number(a.low), bits_as_number(a.high)}; }
  friend KOKKOS_FORCEINLINE_FUNCTION pack number_as_bits(pack a) { return {number_as_bits(a.low), number_as_bits(a.high)}; }
  friend KOKKOS_FORCEINLINE_FUNCTION pack rounded(pack a) { return {rounded(a.low), rounded(a.high)}; }
};

// ---- Words that change the number or the kind of lanes ----------------------------------------------------------------------
// Some lanes of a and b, b's counted after a's.
template <int first, class To, class From, int... l>
KOKKOS_FORCEINLINE_FUNCTION To picked(From a, From b, std::integer_sequence<int, l...>) {
  return To(__builtin_shufflevector(a.v, b.v, (first + l)...));
}
template <class T, int W, int B>
KOKKOS_FORCEINLINE_FUNCTION pack<T, W / 2, B> first_half(pack<T, W, B> a) {
  if constexpr (pack<T, W, B>::one_register)
    return picked<0, pack<T, W / 2, B>>(a, a, std::make_integer_sequence<int, W / 2>{});
  else
    return a.low;
}
template <class T, int W, int B>
KOKKOS_FORCEINLINE_FUNCTION pack<T, W / 2, B> second_half(pack<T, W, B> a) {
  if constexpr (pack<T, W, B>::one_register)
    return picked<W / 2, pack<T, W / 2, B>>(a, a, std::make_integer_sequence<int, W / 2>{});
  else
    return a.high;
}
template <class T, int W, int B>
KOKKOS_FORCEINLINE_FUNCTION pack<T, 2 * W, B> join(pack<T, W, B> a, pack<T, W, B> b) {
  if constexpr (pack<T, 2 * W, B>::one_register)
    return picked<0, pack<T, 2 * W, B>>(a, b, std::make_integer_sequence<int, 2 * W>{});
  else
    return {a, b};
}
// Lane k of a in the first half of the lanes, lane k of b in the second; one register each.
template <int k, class P, int... l>
KOKKOS_FORCEINLINE_FUNCTION P halves_of(P a, P b, std::integer_sequence<int, l...>) {
  constexpr int width = sizeof...(l);
  return P(__builtin_shufflevector(a.v, b.v, (l < width / 2 ? k : width + k)...));
}

// Four values from memory in the first lanes; one register.
template <class P>
KOKKOS_FORCEINLINE_FUNCTION P first_four(const float* from) {
  return P(registers::first_four<typename P::Vector>(from));
}

// Values of another type; whole numbers are cut towards zero.
template <class To, class T, int W, int B>
KOKKOS_FORCEINLINE_FUNCTION pack<To, W, B> convert(pack<T, W, B> a) {
  if constexpr (pack<T, W, B>::one_register && pack<To, W, B>::one_register)
    return pack<To, W, B>(registers::convert<To>(a.v));
  else
    return join(convert<To>(first_half(a)), convert<To>(second_half(a)));
}
template <int W, int B>
KOKKOS_FORCEINLINE_FUNCTION pack<int, W, B> to_index(pack<double, W, B> a) {
  return convert<int>(a);
}
template <int W, int B>
KOKKOS_FORCEINLINE_FUNCTION pack<double, W, B> to_real(pack<int, W, B> a) {
  return convert<double>(a);
}
template <int W, int B>
KOKKOS_FORCEINLINE_FUNCTION pack<double, W, B> gather(const double* table, pack<int, W, B> index) {
  if constexpr (pack<double, W, B>::one_register)
    return pack<double, W, B>(registers::gather<registers::Vector<double, W>>(table, index.v));
  else
    return pack<double, W, B>::of([&](int lane) { return table[index[lane]]; });
}

template <class T, int W, int B>
KOKKOS_FORCEINLINE_FUNCTION T largest(pack<T, W, B> a) {
  if constexpr (W == 2)
    return larger(a[0], a[1]);
  else
    return largest(larger(first_half(a), second_half(a)));
}
template <class T, int W, int B>
KOKKOS_FORCEINLINE_FUNCTION T smallest(pack<T, W, B> a) {
  return -largest(-a);
}
// A third of the exponent, taken on the bits read as a number (at most 8.2 % off), then Newton's method, which squares the error.
template <int W, int B>
KOKKOS_FORCEINLINE_FUNCTION pack<double, W, B> inverse_cbrt(pack<double, W, B> a) {
  constexpr double zero_exponent = 1023.0 * 4503599627370496.0;  // the bits of 1.0
  pack<double, W, B> y = number_as_bits((4.0 / 3.0 * zero_exponent) - bits_as_number(a) * (1.0 / 3.0));
  for (int n = 0; n < 4; ++n) y = y * (4.0 / 3.0 - (1.0 / 3.0) * a * y * y * y);
  return y;
}

// Single lanes, for what has no vector form.
template <class T, int W, int B>
KOKKOS_FORCEINLINE_FUNCTION T lane_of(const pack<T, W, B>& a, int lane) {
  return a[lane];
}
template <class T, int W, int B>
KOKKOS_FORCEINLINE_FUNCTION void set_lane(pack<T, W, B>& a, int lane, T value) {
  a.set(lane, value);
}
// use(lane, value) for every lane in turn.
template <class T, int W, int B, class Use>
KOKKOS_FORCEINLINE_FUNCTION void for_each_lane(const pack<T, W, B>& a, const Use& use) {
  if constexpr (pack<T, W, B>::one_register) {
    a.for_each(use);
  } else {
    for_each_lane(a.low, use);
    for_each_lane(a.high, [&](int lane, T value) { use(W / 2 + lane, value); });
  }
}
#endif

// ---- The same words for plain scalars -----------------------------------------------------------------------------------------
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
#elif defined(__GNUC__) && __GNUC__ >= 12 && !defined(__clang__) && !defined(KOKKOS_ENABLE_CUDA) && !defined(KOKKOS_ENABLE_HIP)
  return __builtin_assoc_barrier(a);
#else
  return a;
#endif
}

template <class V>
KOKKOS_FORCEINLINE_FUNCTION V clamp(V value, V low, V high) {
  return smaller(larger(value, low), high);
}

// ---- Lanes: those of a cluster ------------------------------------------------------------------------------------------------
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
KOKKOS_FORCEINLINE_FUNCTION Lane::Mask first_lanes(int n) { return Lane::of([](int lane) { return lane; }) < Lane(n); }
#endif

// ---- Pair loops register by register ------------------------------------------------------------------------------------------
// A cluster has two parts, the halves of its lanes, where these fill several registers.
#ifdef FRESHET_ONE_LANE
inline constexpr int parts_of_cluster = 1;
#else
inline constexpr int parts_of_cluster = Lane::one_register ? 1 : 2;
#endif

// loop(a, part) of values a of type V (a pack, a Vec of packs, a struct with an each() of its own), one register of their lanes after
// the other: a body that fills the registers twice over would be spilt in every pair. What the loop returns is put together again.
#ifdef FRESHET_DEVICE
template <class V, class Values, class Loop>
KOKKOS_FORCEINLINE_FUNCTION auto by_register(const Values& a, const Loop& loop) {
  return loop(a, 0);
}
#else
struct FirstHalf {
  template <class P>
  KOKKOS_FORCEINLINE_FUNCTION auto operator()(const P& a) const { return first_half(a); }
};
struct SecondHalf {
  template <class P>
  KOKKOS_FORCEINLINE_FUNCTION auto operator()(const P& a) const { return second_half(a); }
};
struct Join {
  template <class P>
  KOKKOS_FORCEINLINE_FUNCTION auto operator()(const P& a, const P& b) const { return join(a, b); }
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
