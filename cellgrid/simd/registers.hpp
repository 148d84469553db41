// One register of the processor by name: what it is called, how wide it is, and what is done with one. The
// one file that knows instruction sets; packs (pack.hpp) are made of these.
#pragma once
#include <cmath>
#include <type_traits>
#include <utility>

#include "cellgrid/parallel/types.hpp"

#ifndef FRESHET_DEVICE  // whose compilers take no vector types
#ifdef __x86_64__
#include <immintrin.h>
#endif

namespace freshet {

// The widest register that this build may use [bytes], and its name.
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512BW__) && defined(__AVX512VL__)
inline constexpr int register_bytes = 64;
inline constexpr const char* instruction_set = "AVX-512";
#elif defined(__AVX2__) && defined(__FMA__)
inline constexpr int register_bytes = 32;
inline constexpr const char* instruction_set = "AVX2";
#else
inline constexpr int register_bytes = 16;
#if defined(__x86_64__)
inline constexpr const char* instruction_set = "SSE";
#elif defined(__ARM_NEON)
inline constexpr const char* instruction_set = "NEON";
#else
inline constexpr const char* instruction_set = "128-bit registers";
#endif
#endif

#if defined(__FMA__) || defined(__ARM_NEON)
inline constexpr bool multiplies_and_adds_at_once = true;
#else
inline constexpr bool multiplies_and_adds_at_once = false;
#endif

// The name of the best that the machine has which the program runs on.
inline const char* machine_instruction_set() {
#ifdef __x86_64__
  const bool wide = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                    __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
  if (wide) return "AVX-512";
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ? "AVX2" : "SSE";
#else
  return instruction_set;
#endif
}

// ---- Words on one register: g++ makes single instructions of most; what it does not is written out beneath
// ---------------
namespace registers {

template <class T, int W>
struct VectorOf {
  typedef T type __attribute__((vector_size(W * sizeof(T))));
};
template <class T, int W>
using Vector = typename VectorOf<T, W>::type;
template <class V>
using Element = std::decay_t<decltype(std::declval<V>()[0])>;
template <class V>
inline constexpr int width = sizeof(V) / sizeof(Element<V>);

// The bits of a value as a whole number, and its sign.
template <class T>
using WholeOf = std::conditional_t<sizeof(T) == 8, unsigned long long, unsigned>;
template <class V>
using Bits = Vector<WholeOf<Element<V>>, width<V>>;
template <class V>
inline constexpr WholeOf<Element<V>> sign = WholeOf<Element<V>>(1) << (8 * sizeof(Element<V>) - 1);

template <class V>
KOKKOS_FORCEINLINE_FUNCTION auto less(V a, V b) {
  return a < b;
}
template <class M, class V>
KOKKOS_FORCEINLINE_FUNCTION V select(M m, V a, V b) {
  return m ? a : b;
}
template <class V>
KOKKOS_FORCEINLINE_FUNCTION V smaller(V a, V b) {
  return a < b ? a : b;
}
template <class V>
KOKKOS_FORCEINLINE_FUNCTION V larger(V a, V b) {
  return b < a ? a : b;
}
#ifdef __x86_64__  // of a maximum with zero g++ makes a comparison and a bitwise and
using Doubles2 = Vector<double, 2>;
KOKKOS_FORCEINLINE_FUNCTION Doubles2 larger(Doubles2 a, Doubles2 b) {
  return (Doubles2)_mm_max_pd((__m128d)a, (__m128d)b);
}
#endif
#ifdef __AVX__
using Doubles4 = Vector<double, 4>;
KOKKOS_FORCEINLINE_FUNCTION Doubles4 larger(Doubles4 a, Doubles4 b) {
  return (Doubles4)_mm256_max_pd((__m256d)a, (__m256d)b);
}
#endif
template <class M, class V>
KOKKOS_FORCEINLINE_FUNCTION V larger_where(M m, V a, V b) {
  return larger(a, select(m, b, a));
}
template <class V>
KOKKOS_FORCEINLINE_FUNCTION V turned_by(V a, V b) {
  return (V)((Bits<V>)a ^ ((Bits<V>)b & sign<V>));
}
template <class V>
KOKKOS_FORCEINLINE_FUNCTION V size_of(V a) {
  return (V)((Bits<V>)a & ~sign<V>);
}
template <class V>
KOKKOS_FORCEINLINE_FUNCTION V root(V a) {
  for (int l = 0; l < width<V>; ++l)
    a[l] = sizeof(Element<V>) == 8 ? __builtin_sqrt(a[l]) : __builtin_sqrtf(a[l]);
  return a;
}
template <class V>
KOKKOS_FORCEINLINE_FUNCTION V rsqrt(V a) {
  return Element<V>(1) / root(a);
}
template <class To, class V>
KOKKOS_FORCEINLINE_FUNCTION auto convert(V a) {
  return __builtin_convertvector(a, Vector<To, width<V>>);
}
// The bits of a positive double read as a number, and back; without the last twenty of them, which leaves
// 2^-32 of the value.
template <class V>
KOKKOS_FORCEINLINE_FUNCTION V bits_as_number(V a) {
  const V two52 = V{} + 0x1p52;
  return ((V)(((Bits<V>)a >> 20) | (Bits<V>)two52) - two52) * 0x1p20;
}
template <class V>
KOKKOS_FORCEINLINE_FUNCTION V number_as_bits(V a) {
  return (V)((Bits<V>)(a * 0x1p-20 + 0x1p52) << 20);
}
// The truth values of all lanes, a bit each.
template <class M>
KOKKOS_FORCEINLINE_FUNCTION unsigned signs(M m) {
  unsigned bits = 0;
  for (int l = 0; l < width<M>; ++l) bits |= static_cast<unsigned>(m[l] != 0) << l;
  return bits;
}
#ifdef __x86_64__
using Truths2 = decltype(Vector<double, 2>{} < Vector<double, 2>{});
KOKKOS_FORCEINLINE_FUNCTION unsigned signs(Truths2 m) {
  return static_cast<unsigned>(_mm_movemask_pd((__m128d)m));
}
#endif
#ifdef __AVX__
using Truths4 = decltype(Vector<double, 4>{} < Vector<double, 4>{});
KOKKOS_FORCEINLINE_FUNCTION unsigned signs(Truths4 m) {
  return static_cast<unsigned>(_mm256_movemask_pd((__m256d)m));
}
#endif
template <class M>
KOKKOS_FORCEINLINE_FUNCTION int count(M m) {
  return __builtin_popcount(signs(m));
}
template <class M>
KOKKOS_FORCEINLINE_FUNCTION bool any(M m) {
  return signs(m) != 0;
}
template <class V, class I>
KOKKOS_FORCEINLINE_FUNCTION V gather(const Element<V>* table, I index) {
  V value;
  for (int l = 0; l < width<V>; ++l) value[l] = table[index[l]];
  return value;
}
template <class V>
KOKKOS_FORCEINLINE_FUNCTION V first_four(const float* from) {
  return V{from[0], from[1], from[2], from[3]};
}
template <class V>
KOKKOS_FORCEINLINE_FUNCTION V rounded(V a) {
#if defined(__GNUC__) && __GNUC__ >= 12 && !defined(__clang__)
  return __builtin_assoc_barrier(a);
#else
  return a;
#endif
}

#ifdef __AVX512F__
// The maskz forms with every lane on are the plain instructions; g++ 12 warns falsely of the plain forms.
using Doubles = Vector<double, 8>;
using Floats = Vector<float, 16>;
inline constexpr __mmask8 all8 = 0xff;
inline constexpr __mmask16 all16 = 0xffff;
KOKKOS_FORCEINLINE_FUNCTION __mmask8 less(Doubles a, Doubles b) {
  return _mm512_cmp_pd_mask((__m512d)a, (__m512d)b, _CMP_LT_OQ);
}
KOKKOS_FORCEINLINE_FUNCTION __mmask16 less(Floats a, Floats b) {
  return _mm512_cmp_ps_mask((__m512)a, (__m512)b, _CMP_LT_OQ);
}
KOKKOS_FORCEINLINE_FUNCTION Doubles select(__mmask8 m, Doubles a, Doubles b) {
  return (Doubles)_mm512_mask_blend_pd(m, (__m512d)b, (__m512d)a);
}
KOKKOS_FORCEINLINE_FUNCTION Floats select(__mmask16 m, Floats a, Floats b) {
  return (Floats)_mm512_mask_blend_ps(m, (__m512)b, (__m512)a);
}
KOKKOS_FORCEINLINE_FUNCTION Doubles smaller(Doubles a, Doubles b) {
  return (Doubles)_mm512_maskz_min_pd(all8, (__m512d)a, (__m512d)b);
}
KOKKOS_FORCEINLINE_FUNCTION Floats smaller(Floats a, Floats b) {
  return (Floats)_mm512_maskz_min_ps(all16, (__m512)a, (__m512)b);
}
KOKKOS_FORCEINLINE_FUNCTION Doubles larger(Doubles a, Doubles b) {
  return (Doubles)_mm512_maskz_max_pd(all8, (__m512d)a, (__m512d)b);
}
KOKKOS_FORCEINLINE_FUNCTION Floats larger(Floats a, Floats b) {
  return (Floats)_mm512_maskz_max_ps(all16, (__m512)a, (__m512)b);
}
KOKKOS_FORCEINLINE_FUNCTION Doubles larger_where(__mmask8 m, Doubles a, Doubles b) {
  return (Doubles)_mm512_mask_max_pd((__m512d)a, m, (__m512d)a, (__m512d)b);
}
KOKKOS_FORCEINLINE_FUNCTION Floats larger_where(__mmask16 m, Floats a, Floats b) {
  return (Floats)_mm512_mask_max_ps((__m512)a, m, (__m512)a, (__m512)b);
}
// One instruction on the bits (0x78: a ^ (b & c)).
KOKKOS_FORCEINLINE_FUNCTION Doubles turned_by(Doubles a, Doubles b) {
  return (Doubles)_mm512_ternarylogic_epi64((__m512i)a, (__m512i)b,
                                            _mm512_set1_epi64(static_cast<long long>(1ull << 63)), 0x78);
}
KOKKOS_FORCEINLINE_FUNCTION Floats turned_by(Floats a, Floats b) {
  return (Floats)_mm512_ternarylogic_epi32((__m512i)a, (__m512i)b,
                                           _mm512_set1_epi32(static_cast<int>(1u << 31)), 0x78);
}
KOKKOS_FORCEINLINE_FUNCTION Doubles root(Doubles a) {
  return (Doubles)_mm512_maskz_sqrt_pd(all8, (__m512d)a);
}
KOKKOS_FORCEINLINE_FUNCTION Floats root(Floats a) { return (Floats)_mm512_maskz_sqrt_ps(all16, (__m512)a); }
// 14-bit estimates; the terms up to e^2 leave 5.7e-13, those up to e leave single precision.
KOKKOS_FORCEINLINE_FUNCTION Doubles rsqrt(Doubles a) {
  const Doubles y = (Doubles)_mm512_maskz_rsqrt14_pd(all8, (__m512d)a), e = 1.0 - a * y * y;
  return y + y * e * (0.5 + 0.375 * e);
}
KOKKOS_FORCEINLINE_FUNCTION Floats rsqrt(Floats a) {
  const Floats y = (Floats)_mm512_maskz_rsqrt14_ps(all16, (__m512)a);
  return y * (1.5f - 0.5f * a * y * y);
}
KOKKOS_FORCEINLINE_FUNCTION Doubles bits_as_number(Doubles a) {
  return __builtin_convertvector((Vector<long long, 8>)a, Doubles);
}
KOKKOS_FORCEINLINE_FUNCTION Doubles number_as_bits(Doubles a) {
  return (Doubles) __builtin_convertvector(a, Vector<long long, 8>);
}
KOKKOS_FORCEINLINE_FUNCTION bool any(__mmask8 m) { return m != 0; }
KOKKOS_FORCEINLINE_FUNCTION bool any(__mmask16 m) { return m != 0; }
KOKKOS_FORCEINLINE_FUNCTION int count(__mmask8 m) { return __builtin_popcount(m); }
KOKKOS_FORCEINLINE_FUNCTION int count(__mmask16 m) { return __builtin_popcount(m); }
template <>
KOKKOS_FORCEINLINE_FUNCTION Doubles gather<Doubles>(const double* table, Vector<int, 8> index) {
  return (Doubles)_mm512_mask_i32gather_pd(_mm512_setzero_pd(), all8, (__m256i)index, table, 8);
}
template <>
KOKKOS_FORCEINLINE_FUNCTION Floats first_four<Floats>(const float* from) {
  return (Floats)_mm512_castps128_ps512(_mm_load_ps(from));
}
#endif

}  // namespace registers

}  // namespace freshet
#endif
