// pack<T, W>: W values computed in step, in as many of the processor's registers as they need (eight doubles:
// one with AVX-512, two with AVX2, four with SSE and NEON). Every object that passes packs must be compiled
// with the same instruction-set flags.
#pragma once
#include "cellgrid/simd/registers.hpp"

#ifndef FRESHET_DEVICE
namespace freshet {

// ---- Packs of one register
// ---------------------------------------------------------------------------------------------------- B:
// bytes of a register; tests ask for other ones than the machine's.
template <class T, int W, int B = register_bytes, bool one = (W * sizeof(T) <= B)>
struct pack;

// The lanes' truth values.
template <class P, bool one = P::one_register>
struct LaneMask {
  using Bits =
      decltype(registers::less(std::declval<typename P::Vector>(), std::declval<typename P::Vector>()));
  Bits bits;
  friend KOKKOS_FORCEINLINE_FUNCTION LaneMask operator&(LaneMask a, LaneMask b) {
    return {static_cast<Bits>(a.bits & b.bits)};
  }
  friend KOKKOS_FORCEINLINE_FUNCTION LaneMask operator|(LaneMask a, LaneMask b) {
    return {static_cast<Bits>(a.bits | b.bits)};
  }
  friend KOKKOS_FORCEINLINE_FUNCTION LaneMask operator!(LaneMask a) { return {static_cast<Bits>(~a.bits)}; }
  friend KOKKOS_FORCEINLINE_FUNCTION bool any(LaneMask m) { return registers::any(m.bits); }
  friend KOKKOS_FORCEINLINE_FUNCTION int count(LaneMask m) { return registers::count(m.bits); }
};

template <class T, int W, int B>
struct pack<T, W, B, true> {
  static constexpr bool one_register = true;
  using Vector = registers::Vector<T, W>;
  using Mask = LaneMask<pack>;
  Vector v;

  pack() = default;
  KOKKOS_FORCEINLINE_FUNCTION pack(T scalar)
      : v(scalar - Vector{}) {}  // implicit: bodies read alike for scalars and packs
  explicit KOKKOS_FORCEINLINE_FUNCTION pack(Vector vector) : v(vector) {}
  // value(lane) in each lane, put together in registers; use(lane, value) of each.
  template <class Value>
  static KOKKOS_FORCEINLINE_FUNCTION pack of(const Value& value) {
    return of(value, std::make_integer_sequence<int, W>{});
  }
  template <class Use>
  KOKKOS_FORCEINLINE_FUNCTION void for_each(const Use& use) const {
    for_each(use, std::make_integer_sequence<int, W>{});
  }

  KOKKOS_FORCEINLINE_FUNCTION T operator[](int lane) const { return v[lane]; }
  KOKKOS_FORCEINLINE_FUNCTION void set(int lane, T value) { v[lane] = value; }

  KOKKOS_FORCEINLINE_FUNCTION pack& operator+=(pack b) { return *this = *this + b; }
  KOKKOS_FORCEINLINE_FUNCTION pack& operator-=(pack b) { return *this = *this - b; }
  KOKKOS_FORCEINLINE_FUNCTION pack& operator*=(pack b) { return *this = *this * b; }
  friend KOKKOS_FORCEINLINE_FUNCTION pack operator+(pack a, pack b) { return pack(a.v + b.v); }
  friend KOKKOS_FORCEINLINE_FUNCTION pack operator-(pack a, pack b) { return pack(a.v - b.v); }
  friend KOKKOS_FORCEINLINE_FUNCTION pack operator*(pack a, pack b) { return pack(a.v * b.v); }
  friend KOKKOS_FORCEINLINE_FUNCTION pack operator/(pack a, pack b) { return pack(a.v / b.v); }
  friend KOKKOS_FORCEINLINE_FUNCTION pack operator-(pack a) { return pack(-a.v); }
  friend KOKKOS_FORCEINLINE_FUNCTION Mask operator<(pack a, pack b) { return {registers::less(a.v, b.v)}; }
  friend KOKKOS_FORCEINLINE_FUNCTION pack select(Mask m, pack a, pack b) {
    return pack(registers::select(m.bits, a.v, b.v));
  }
  friend KOKKOS_FORCEINLINE_FUNCTION pack smaller(pack a, pack b) {
    return pack(registers::smaller(a.v, b.v));
  }
  friend KOKKOS_FORCEINLINE_FUNCTION pack larger(pack a, pack b) { return pack(registers::larger(a.v, b.v)); }
  friend KOKKOS_FORCEINLINE_FUNCTION pack larger_where(Mask m, pack a, pack b) {
    return pack(registers::larger_where(m.bits, a.v, b.v));
  }
  friend KOKKOS_FORCEINLINE_FUNCTION pack turned_by(pack a, pack b) {
    return pack(registers::turned_by(a.v, b.v));
  }
  friend KOKKOS_FORCEINLINE_FUNCTION pack size_of(pack a) { return pack(registers::size_of(a.v)); }
  friend KOKKOS_FORCEINLINE_FUNCTION pack root(pack a) { return pack(registers::root(a.v)); }
  friend KOKKOS_FORCEINLINE_FUNCTION pack rsqrt(pack a) { return pack(registers::rsqrt(a.v)); }
  friend KOKKOS_FORCEINLINE_FUNCTION pack bits_as_number(pack a) {
    return pack(registers::bits_as_number(a.v));
  }
  friend KOKKOS_FORCEINLINE_FUNCTION pack number_as_bits(pack a) {
    return pack(registers::number_as_bits(a.v));
  }
  friend KOKKOS_FORCEINLINE_FUNCTION pack rounded(pack a) { return pack(registers::rounded(a.v)); }

 private:
  template <class Value, int... l>
  static KOKKOS_FORCEINLINE_FUNCTION pack of(const Value& value, std::integer_sequence<int, l...>) {
    return pack(Vector{static_cast<T>(value(l))...});
  }
  template <class Use, int... l>
  KOKKOS_FORCEINLINE_FUNCTION void for_each(const Use& use, std::integer_sequence<int, l...>) const {
    (use(l, v[l]), ...);
  }
};

// ---- Packs in two halves
// ----------------------------------------------------------------------------------------------------
template <class P>
struct LaneMask<P, false> {
  LaneMask<typename P::Half> low, high;
  friend KOKKOS_FORCEINLINE_FUNCTION LaneMask operator&(LaneMask a, LaneMask b) {
    return {a.low & b.low, a.high & b.high};
  }
  friend KOKKOS_FORCEINLINE_FUNCTION LaneMask operator|(LaneMask a, LaneMask b) {
    return {a.low | b.low, a.high | b.high};
  }
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

  KOKKOS_FORCEINLINE_FUNCTION T operator[](int lane) const {
    return lane < W / 2 ? low[lane] : high[lane - W / 2];
  }
  KOKKOS_FORCEINLINE_FUNCTION void set(int lane, T value) {
    if (lane < W / 2) low.set(lane, value);
    else high.set(lane - W / 2, value);
  }

  KOKKOS_FORCEINLINE_FUNCTION pack& operator+=(pack b) { return *this = *this + b; }
  KOKKOS_FORCEINLINE_FUNCTION pack& operator-=(pack b) { return *this = *this - b; }
  KOKKOS_FORCEINLINE_FUNCTION pack& operator*=(pack b) { return *this = *this * b; }
  friend KOKKOS_FORCEINLINE_FUNCTION pack operator+(pack a, pack b) {
    return {a.low + b.low, a.high + b.high};
  }
  friend KOKKOS_FORCEINLINE_FUNCTION pack operator-(pack a, pack b) {
    return {a.low - b.low, a.high - b.high};
  }
  friend KOKKOS_FORCEINLINE_FUNCTION pack operator*(pack a, pack b) {
    return {a.low * b.low, a.high * b.high};
  }
  friend KOKKOS_FORCEINLINE_FUNCTION pack operator/(pack a, pack b) {
    return {a.low / b.low, a.high / b.high};
  }
  friend KOKKOS_FORCEINLINE_FUNCTION pack operator-(pack a) { return {-a.low, -a.high}; }
  friend KOKKOS_FORCEINLINE_FUNCTION Mask operator<(pack a, pack b) {
    return {a.low < b.low, a.high < b.high};
  }
  friend KOKKOS_FORCEINLINE_FUNCTION pack select(Mask m, pack a, pack b) {
    return {select(m.low, a.low, b.low), select(m.high, a.high, b.high)};
  }
  friend KOKKOS_FORCEINLINE_FUNCTION pack smaller(pack a, pack b) {
    return {smaller(a.low, b.low), smaller(a.high, b.high)};
  }
  friend KOKKOS_FORCEINLINE_FUNCTION pack larger(pack a, pack b) {
    return {larger(a.low, b.low), larger(a.high, b.high)};
  }
  friend KOKKOS_FORCEINLINE_FUNCTION pack larger_where(Mask m, pack a, pack b) {
    return {larger_where(m.low, a.low, b.low), larger_where(m.high, a.high, b.high)};
  }
  friend KOKKOS_FORCEINLINE_FUNCTION pack turned_by(pack a, pack b) {
    return {turned_by(a.low, b.low), turned_by(a.high, b.high)};
  }
  friend KOKKOS_FORCEINLINE_FUNCTION pack size_of(pack a) { return {size_of(a.low), size_of(a.high)}; }
  friend KOKKOS_FORCEINLINE_FUNCTION pack root(pack a) { return {root(a.low), root(a.high)}; }
  friend KOKKOS_FORCEINLINE_FUNCTION pack rsqrt(pack a) { return {rsqrt(a.low), rsqrt(a.high)}; }
  friend KOKKOS_FORCEINLINE_FUNCTION pack bits_as_number(pack a) {
    return {bits_as_number(a.low), bits_as_number(a.high)};
  }
  friend KOKKOS_FORCEINLINE_FUNCTION pack number_as_bits(pack a) {
    return {number_as_bits(a.low), number_as_bits(a.high)};
  }
  friend KOKKOS_FORCEINLINE_FUNCTION pack rounded(pack a) { return {rounded(a.low), rounded(a.high)}; }
};

// ---- Words that change the number or the kind of lanes
// ---------------------------------------------------------------------- Some lanes of a and b, b's counted
// after a's.
template <int first, class To, class From, int... l>
KOKKOS_FORCEINLINE_FUNCTION To picked(From a, From b, std::integer_sequence<int, l...>) {
  return To(__builtin_shufflevector(a.v, b.v, (first + l)...));
}
template <class T, int W, int B>
KOKKOS_FORCEINLINE_FUNCTION pack<T, W / 2, B> first_half(pack<T, W, B> a) {
  if constexpr (pack<T, W, B>::one_register)
    return picked<0, pack<T, W / 2, B>>(a, a, std::make_integer_sequence<int, W / 2>{});
  else return a.low;
}
template <class T, int W, int B>
KOKKOS_FORCEINLINE_FUNCTION pack<T, W / 2, B> second_half(pack<T, W, B> a) {
  if constexpr (pack<T, W, B>::one_register)
    return picked<W / 2, pack<T, W / 2, B>>(a, a, std::make_integer_sequence<int, W / 2>{});
  else return a.high;
}
template <class T, int W, int B>
KOKKOS_FORCEINLINE_FUNCTION pack<T, 2 * W, B> join(pack<T, W, B> a, pack<T, W, B> b) {
  if constexpr (pack<T, 2 * W, B>::one_register)
    return picked<0, pack<T, 2 * W, B>>(a, b, std::make_integer_sequence<int, 2 * W>{});
  else return {a, b};
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
  else return join(convert<To>(first_half(a)), convert<To>(second_half(a)));
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
  else return pack<double, W, B>::of([&](int lane) { return table[index[lane]]; });
}

template <class T, int W, int B>
KOKKOS_FORCEINLINE_FUNCTION T largest(pack<T, W, B> a) {
  if constexpr (W == 2) return larger(a[0], a[1]);
  else return largest(larger(first_half(a), second_half(a)));
}
template <class T, int W, int B>
KOKKOS_FORCEINLINE_FUNCTION T smallest(pack<T, W, B> a) {
  return -largest(-a);
}
// A third of the exponent, taken on the bits read as a number (at most 8.2 % off), then Newton's method,
// which squares the error.
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

}  // namespace freshet
#endif
