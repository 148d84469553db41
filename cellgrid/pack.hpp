// pack<T, W>: W values computed in step, on the compiler's vector extensions. A pair body written for a value type V
// runs with V = pack<double, 8> on a CPU and with V = double on a GPU or as the scalar reference.
// Every object that passes packs must be compiled with the same instruction-set flags.
#pragma once
#include <cmath>

#include "cellgrid/types.hpp"

#if defined(__AVX512F__) && !defined(FRESHET_SCALAR)
#include <immintrin.h>
#define FRESHET_AVX512
#endif

namespace freshet {

// Lanes per cluster: one 64-byte register of doubles on a CPU, plain scalars elsewhere.
#if defined(KOKKOS_ENABLE_CUDA) || defined(KOKKOS_ENABLE_HIP) || defined(FRESHET_SCALAR)
inline constexpr int lanes = 1;
#else
inline constexpr int lanes = 8;
#endif

template <class T, int W>
struct vector_of {
  typedef T type __attribute__((vector_size(W * sizeof(T))));
};

template <class T, int W>
struct pack {
  using Vector = typename vector_of<T, W>::type;
  Vector v;

  pack() = default;
  pack(T scalar) : v(scalar - Vector{}) {}  // broadcast: implicit, so that bodies read alike for scalars and packs
  pack(Vector vector) : v(vector) {}

  T operator[](int lane) const { return v[lane]; }
  void set(int lane, T value) { v[lane] = value; }

  friend pack operator+(pack a, pack b) { return a.v + b.v; }
  friend pack operator-(pack a, pack b) { return a.v - b.v; }
  friend pack operator*(pack a, pack b) { return a.v * b.v; }
  friend pack operator/(pack a, pack b) { return a.v / b.v; }
  friend pack operator-(pack a) { return -a.v; }
  pack& operator+=(pack b) { return v += b.v, *this; }
  pack& operator-=(pack b) { return v -= b.v, *this; }
  pack& operator*=(pack b) { return v *= b.v, *this; }
};

// The value type of the pair loops and its per-lane truth value.
#ifdef FRESHET_AVX512
struct Mask8 {
  __mmask8 bits;
  friend Mask8 operator&(Mask8 a, Mask8 b) { return {static_cast<__mmask8>(a.bits & b.bits)}; }
  friend Mask8 operator|(Mask8 a, Mask8 b) { return {static_cast<__mmask8>(a.bits | b.bits)}; }
  friend Mask8 operator!(Mask8 a) { return {static_cast<__mmask8>(~a.bits)}; }
};
using double8 = pack<double, 8>;
// The maskz forms with every lane on are the plain instructions; g++ 12 warns falsely of the plain forms.
inline constexpr __mmask8 all_lanes = 0xff;
inline Mask8 operator<(double8 a, double8 b) {
  return {_mm512_cmp_pd_mask((__m512d)a.v, (__m512d)b.v, _CMP_LT_OQ)};
}
inline bool any(Mask8 m) { return m.bits != 0; }
inline Mask8 first_lanes(int n) { return {static_cast<__mmask8>((1 << n) - 1)}; }
inline int count(Mask8 m) { return __builtin_popcount(m.bits); }
inline double8 select(Mask8 m, double8 a, double8 b) {
  return double8::Vector(_mm512_mask_blend_pd(m.bits, (__m512d)b.v, (__m512d)a.v));
}
inline double8 smaller(double8 a, double8 b) { return double8::Vector(_mm512_maskz_min_pd(all_lanes, (__m512d)a.v, (__m512d)b.v)); }
inline double8 larger(double8 a, double8 b) { return double8::Vector(_mm512_maskz_max_pd(all_lanes, (__m512d)a.v, (__m512d)b.v)); }
// a, in the lanes of m the larger of a and b.
inline double8 larger_where(Mask8 m, double8 a, double8 b) {
  return double8::Vector(_mm512_mask_max_pd((__m512d)a.v, m.bits, (__m512d)a.v, (__m512d)b.v));
}
// a with its sign turned where b is negative: one instruction on the bits (0x78: a ^ (b & c)).
inline double8 turned_by(double8 a, double8 b) {
  const __m512i sign = _mm512_set1_epi64(static_cast<long long>(1ull << 63));
  return double8::Vector((__m512d)_mm512_ternarylogic_epi64((__m512i)a.v, (__m512i)b.v, sign, 0x78));
}
inline double8 size_of(double8 a) {
  return double8::Vector((__m512d)_mm512_maskz_andnot_epi64(all_lanes, _mm512_set1_epi64(static_cast<long long>(1ull << 63)), (__m512i)a.v));
}
inline double8 sqrt(double8 a) { return double8::Vector(_mm512_maskz_sqrt_pd(all_lanes, (__m512d)a.v)); }
// 14-bit estimate and one third-order step: relative error below 1e-12, no division. a > 0.
inline double8 rsqrt(double8 a) {
  const double8 y = double8::Vector(_mm512_maskz_rsqrt14_pd(all_lanes, (__m512d)a.v));
  const double8 e = 1.0 - a * y * y;
  return y + y * e * (0.5 + 0.375 * e);
}
#elif !defined(KOKKOS_ENABLE_CUDA) && !defined(KOKKOS_ENABLE_HIP)
template <int W>
struct LaneMask {
  typedef long long Bits __attribute__((vector_size(W * 8)));
  Bits bits;
  friend LaneMask operator&(LaneMask a, LaneMask b) { return {a.bits & b.bits}; }
  friend LaneMask operator|(LaneMask a, LaneMask b) { return {a.bits | b.bits}; }
  friend LaneMask operator!(LaneMask a) { return {~a.bits}; }
};
template <int W>
LaneMask<W> operator<(pack<double, W> a, pack<double, W> b) {
  return {a.v < b.v};
}
#ifndef FRESHET_SCALAR
inline LaneMask<lanes> first_lanes(int n) {
  LaneMask<lanes> m;
  for (int l = 0; l < lanes; ++l) m.bits[l] = l < n ? -1 : 0;
  return m;
}
#endif
template <int W>
int count(LaneMask<W> m) {
  long long n = 0;
  for (int l = 0; l < W; ++l) n -= m.bits[l];
  return static_cast<int>(n);
}
template <int W>
bool any(LaneMask<W> m) {
  long long found = 0;
  for (int l = 0; l < W; ++l) found |= m.bits[l];
  return found != 0;
}
template <int W>
pack<double, W> select(LaneMask<W> m, pack<double, W> a, pack<double, W> b) {
  return typename pack<double, W>::Vector(m.bits ? a.v : b.v);
}
template <int W>
pack<double, W> smaller(pack<double, W> a, pack<double, W> b) {
  return typename pack<double, W>::Vector(b.v < a.v ? b.v : a.v);
}
template <int W>
pack<double, W> larger(pack<double, W> a, pack<double, W> b) {
  return typename pack<double, W>::Vector(a.v < b.v ? b.v : a.v);
}
template <int W>
pack<double, W> larger_where(LaneMask<W> m, pack<double, W> a, pack<double, W> b) {
  return select(m, larger(a, b), a);
}
template <int W>
pack<double, W> turned_by(pack<double, W> a, pack<double, W> b) {
  return select(b < pack<double, W>(0.0), -a, a);
}
template <int W>
pack<double, W> size_of(pack<double, W> a) {
  return turned_by(a, a);
}
template <int W>
pack<double, W> sqrt(pack<double, W> a) {
  pack<double, W> root;
  for (int l = 0; l < W; ++l) root.v[l] = std::sqrt(a.v[l]);
  return root;
}
template <int W>
pack<double, W> rsqrt(pack<double, W> a) {
  return 1.0 / sqrt(a);
}
#endif

// The same words for plain scalars.
KOKKOS_FORCEINLINE_FUNCTION bool any(bool m) { return m; }
KOKKOS_FORCEINLINE_FUNCTION int count(bool m) { return m; }
#if defined(KOKKOS_ENABLE_CUDA) || defined(KOKKOS_ENABLE_HIP) || defined(FRESHET_SCALAR)
KOKKOS_FORCEINLINE_FUNCTION bool first_lanes(int n) { return n > 0; }
#endif
KOKKOS_FORCEINLINE_FUNCTION double select(bool m, double a, double b) { return m ? a : b; }
KOKKOS_FORCEINLINE_FUNCTION double larger_where(bool m, double a, double b) { return m && a < b ? b : a; }
KOKKOS_FORCEINLINE_FUNCTION double turned_by(double a, double b) { return b < 0 ? -a : a; }
KOKKOS_FORCEINLINE_FUNCTION double size_of(double a) { return a < 0 ? -a : a; }
KOKKOS_FORCEINLINE_FUNCTION double rsqrt(double a) {
  return 1.0 / ::sqrt(a);
}
KOKKOS_FORCEINLINE_FUNCTION double root(double a) {
  return ::sqrt(a);
}

#if defined(KOKKOS_ENABLE_CUDA) || defined(KOKKOS_ENABLE_HIP) || defined(FRESHET_SCALAR)
using Lane = double;
#else
using Lane = pack<double, lanes>;
KOKKOS_FORCEINLINE_FUNCTION Lane root(Lane a) { return sqrt(a); }
#endif

// Whole numbers per lane, for table look-ups.
#if defined(KOKKOS_ENABLE_CUDA) || defined(KOKKOS_ENABLE_HIP) || defined(FRESHET_SCALAR)
using LaneIndex = int;
#else
using LaneIndex = pack<int, lanes>;
#endif

// Cut towards zero.
KOKKOS_FORCEINLINE_FUNCTION int to_index(double a) { return static_cast<int>(a); }
KOKKOS_FORCEINLINE_FUNCTION double to_real(int a) { return a; }
KOKKOS_FORCEINLINE_FUNCTION double gather(const double* table, int index) { return table[index]; }
// a^(-1/3), a > 0
KOKKOS_FORCEINLINE_FUNCTION double inverse_cbrt(double a) { return 1.0 / ::cbrt(a); }

#if !defined(KOKKOS_ENABLE_CUDA) && !defined(KOKKOS_ENABLE_HIP)
template <int W>
pack<int, W> to_index(pack<double, W> a) {
  return __builtin_convertvector(a.v, typename pack<int, W>::Vector);
}
template <int W>
pack<double, W> to_real(pack<int, W> a) {
  return __builtin_convertvector(a.v, typename pack<double, W>::Vector);
}
#ifdef FRESHET_AVX512
inline double8 gather(const double* table, pack<int, 8> index) {
  return double8::Vector(_mm512_mask_i32gather_pd(_mm512_setzero_pd(), all_lanes, (__m256i)index.v, table, 8));
}
#else
template <int W>
pack<double, W> gather(const double* table, pack<int, W> index) {
  pack<double, W> value;
  for (int l = 0; l < W; ++l) value.set(l, table[index[l]]);
  return value;
}
#endif
// A third of the exponent, taken on the bits read as a number (at most 8.2 % off), then Newton's method, which squares the error.
template <int W>
pack<double, W> inverse_cbrt(pack<double, W> a) {
  using Bits = typename vector_of<long long, W>::type;
  using Reals = typename pack<double, W>::Vector;
  constexpr double zero_exponent = 1023.0 * 4503599627370496.0;  // the bits of 1.0
  const Reals third = (4.0 / 3.0 * zero_exponent) - __builtin_convertvector((Bits)a.v, Reals) * (1.0 / 3.0);
  pack<double, W> y = (Reals)__builtin_convertvector(third, Bits);
  for (int n = 0; n < 4; ++n) y = y * (4.0 / 3.0 - (1.0 / 3.0) * a * y * y * y);
  return y;
}
#endif

// Added to r^2 so that a particle's pair with itself has a finite 1/r (and no effect, since x_ij = 0). Large enough that
// rsqrt's intermediate squares stay finite when r^2 is multiplied by small densities squared.
inline constexpr double tiny_square = 1e-200;

// Single lanes, for what has no vector form.
template <class T, int W>
T lane_of(const pack<T, W>& a, int lane) {
  return a[lane];
}
template <class T, int W>
void set_lane(pack<T, W>& a, int lane, T value) {
  a.set(lane, value);
}
KOKKOS_FORCEINLINE_FUNCTION double lane_of(double a, int) { return a; }
KOKKOS_FORCEINLINE_FUNCTION void set_lane(double& a, int, double value) { a = value; }

template <class V>
KOKKOS_FORCEINLINE_FUNCTION V clamp(V value, V low, V high) {
  return smaller(larger(value, low), high);
}

// Largest and smallest lane.
template <class T, int W>
T largest(pack<T, W> a) {
  T m = a[0];
  for (int l = 1; l < W; ++l) m = larger(m, a[l]);
  return m;
}
template <class T, int W>
T smallest(pack<T, W> a) {
  return -largest(-a);
}
#ifdef FRESHET_AVX512
inline double largest(double8 a) {
  const __m256d four = _mm256_max_pd((__m256d)__builtin_shufflevector(a.v, a.v, 0, 1, 2, 3), (__m256d)__builtin_shufflevector(a.v, a.v, 4, 5, 6, 7));
  const __m128d two = _mm_max_pd(_mm256_castpd256_pd128(four), _mm256_extractf128_pd(four, 1));
  return larger(two[0], two[1]);
}
inline double smallest(double8 a) { return -largest(-a); }
#endif
KOKKOS_FORCEINLINE_FUNCTION double largest(double a) { return a; }
KOKKOS_FORCEINLINE_FUNCTION double smallest(double a) { return a; }

}  // namespace freshet
