// Pair arithmetic in single precision, two neighbours at once: the first half of a Twin's lanes holds a cluster against one
// neighbour, the second half against another. Positions are subtracted in double before they are rounded, so that a distance has
// single precision wherever the water lies. On a GPU, or with one lane per cluster, a Twin is a double and holds one neighbour:
// there only the records are in single precision.
#pragma once
#include "cellgrid/clusters.hpp"

namespace freshet {

// What a pair loop reads of a neighbour: N numbers side by side, one load for all of them.
template <int N>
struct alignas(4 * N) SingleRecord {
  float value[N];
};

#if defined(KOKKOS_ENABLE_CUDA) || defined(KOKKOS_ENABLE_HIP) || defined(FRESHET_SCALAR)
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
inline constexpr int neighbours_at_once = 2;
using Twin = pack<float, 2 * lanes>;
using HalfTwin = pack<float, lanes>;

inline HalfTwin first_half(Twin a) { return HalfTwin::Vector(__builtin_shufflevector(a.v, a.v, 0, 1, 2, 3, 4, 5, 6, 7)); }
inline HalfTwin second_half(Twin a) { return HalfTwin::Vector(__builtin_shufflevector(a.v, a.v, 8, 9, 10, 11, 12, 13, 14, 15)); }
inline Lane widen(HalfTwin a) { return __builtin_convertvector(a.v, Lane::Vector); }

#ifdef FRESHET_AVX512
struct Mask16 {
  __mmask16 bits;
};
inline constexpr __mmask16 all_twins = 0xffff;
inline HalfTwin narrow(Lane a) { return HalfTwin::Vector(_mm512_maskz_cvtpd_ps(all_lanes, (__m512d)a.v)); }
inline Twin join(HalfTwin a, HalfTwin b) {
  return Twin::Vector(_mm512_maskz_insertf32x8(all_twins, _mm512_castps256_ps512((__m256)a.v), (__m256)b.v, 1));
}
inline Mask16 operator<(Twin a, Twin b) { return {_mm512_cmp_ps_mask((__m512)a.v, (__m512)b.v, _CMP_LT_OQ)}; }
inline Twin select(Mask16 m, Twin a, Twin b) { return Twin::Vector(_mm512_mask_blend_ps(m.bits, (__m512)b.v, (__m512)a.v)); }
inline Twin smaller(Twin a, Twin b) { return Twin::Vector(_mm512_maskz_min_ps(all_twins, (__m512)a.v, (__m512)b.v)); }
inline Twin larger(Twin a, Twin b) { return Twin::Vector(_mm512_maskz_max_ps(all_twins, (__m512)a.v, (__m512)b.v)); }
inline Twin larger_where(Mask16 m, Twin a, Twin b) {
  return Twin::Vector(_mm512_mask_max_ps((__m512)a.v, m.bits, (__m512)a.v, (__m512)b.v));
}
inline Twin turned_by(Twin a, Twin b) {
  const __m512i sign = _mm512_set1_epi32(static_cast<int>(1u << 31));
  return Twin::Vector((__m512)_mm512_ternarylogic_epi32((__m512i)a.v, (__m512i)b.v, sign, 0x78));
}
inline Twin size_of(Twin a) {
  return Twin::Vector((__m512)_mm512_maskz_and_epi32(all_twins, _mm512_set1_epi32(0x7fffffff), (__m512i)a.v));
}
inline Twin root(Twin a) { return Twin::Vector(_mm512_maskz_sqrt_ps(all_twins, (__m512)a.v)); }
// 14-bit estimate and one Newton step: single precision.
inline Twin rsqrt(Twin a) {
  const Twin y = Twin::Vector(_mm512_maskz_rsqrt14_ps(all_twins, (__m512)a.v));
  return y * (1.5f - 0.5f * a * y * y);
}
#else
struct Mask16 {
  typedef int Bits __attribute__((vector_size(4 * 2 * lanes)));
  Bits bits;
};
inline HalfTwin narrow(Lane a) { return __builtin_convertvector(a.v, HalfTwin::Vector); }
inline Twin join(HalfTwin a, HalfTwin b) {
  return Twin::Vector(__builtin_shufflevector(a.v, b.v, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
}
inline Mask16 operator<(Twin a, Twin b) { return {a.v < b.v}; }
inline Twin select(Mask16 m, Twin a, Twin b) { return Twin::Vector(m.bits ? a.v : b.v); }
inline Twin smaller(Twin a, Twin b) { return select(b < a, b, a); }
inline Twin larger(Twin a, Twin b) { return select(a < b, b, a); }
inline Twin larger_where(Mask16 m, Twin a, Twin b) { return select(m, larger(a, b), a); }
inline Twin turned_by(Twin a, Twin b) { return select(b < Twin(0.0f), -a, a); }
inline Twin size_of(Twin a) { return turned_by(a, a); }
inline Twin root(Twin a) {
  for (int l = 0; l < 2 * lanes; ++l) a.v[l] = std::sqrt(a.v[l]);
  return a;
}
inline Twin rsqrt(Twin a) { return 1.0f / root(a); }
#endif

inline Twin twice(Lane a) { return join(narrow(a), narrow(a)); }
// The sum, in double, and the larger of the halves.
inline Lane folded(Twin a) { return widen(first_half(a)) + widen(second_half(a)); }
inline Lane folded_largest(Twin a) { return larger(widen(first_half(a)), widen(second_half(a))); }
// i - a and i - b
inline Twin apart(Lane i, double a, double b) { return join(narrow(i - a), narrow(i - b)); }
// 1 where a neighbour counts: the second half only where there are two.
inline Twin kept(bool both) { return join(HalfTwin(1.0f), HalfTwin(both ? 1.0f : 0.0f)); }

// The records of two neighbours, number by number.
template <int N>
class TwinRecord {
 public:
  TwinRecord(const SingleRecord<N>& a, const SingleRecord<N>& b) : a_(load(a)), b_(load(b)) {}
  template <int k>
  Twin get() const {
    constexpr int j = 2 * lanes + k;
    return Twin::Vector(__builtin_shufflevector(a_.v, b_.v, k, k, k, k, k, k, k, k, j, j, j, j, j, j, j, j));
  }

 private:
  // Never by way of memory: a wide load of what narrow stores have just left there waits for them.
  static Twin load(const SingleRecord<N>& r) {
    static_assert(N == 4 || N == 2 * lanes, "a quarter of a Twin, or a whole one");
#ifdef FRESHET_AVX512
    if constexpr (N == 4) return Twin::Vector(_mm512_castps128_ps512(_mm_load_ps(r.value)));
#endif
    Twin v(0.0f);
    __builtin_memcpy(&v, r.value, sizeof r);
    return v;
  }
  Twin a_, b_;
};
#endif

KOKKOS_FORCEINLINE_FUNCTION Vec<Twin, 1> apart(const Vec<Lane, 1>& i, const VecField<double, 1>& x, int a, int b) {
  return {apart(i.x, x.x(a), x.x(b))};
}
KOKKOS_FORCEINLINE_FUNCTION Vec<Twin, 2> apart(const Vec<Lane, 2>& i, const VecField<double, 2>& x, int a, int b) {
  return {apart(i.x, x.x(a), x.x(b)), apart(i.y, x.y(a), x.y(b))};
}
KOKKOS_FORCEINLINE_FUNCTION Vec<Twin, 1> twice(const Vec<Lane, 1>& a) { return {twice(a.x)}; }
KOKKOS_FORCEINLINE_FUNCTION Vec<Twin, 2> twice(const Vec<Lane, 2>& a) { return {twice(a.x), twice(a.y)}; }
KOKKOS_FORCEINLINE_FUNCTION Sym<Twin, 1> twice(const Sym<Lane, 1>& a) { return {twice(a.xx)}; }
KOKKOS_FORCEINLINE_FUNCTION Sym<Twin, 2> twice(const Sym<Lane, 2>& a) { return {twice(a.xx), twice(a.xy), twice(a.yy)}; }
KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 1> folded(const Vec<Twin, 1>& a) { return {folded(a.x)}; }
KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 2> folded(const Vec<Twin, 2>& a) { return {folded(a.x), folded(a.y)}; }
KOKKOS_FORCEINLINE_FUNCTION Sym<Lane, 1> folded(const Sym<Twin, 1>& a) { return {folded(a.xx)}; }
KOKKOS_FORCEINLINE_FUNCTION Sym<Lane, 2> folded(const Sym<Twin, 2>& a) { return {folded(a.xx), folded(a.xy), folded(a.yy)}; }

// A cluster's neighbours two by two: pair(a, b, keep). The last of an odd number comes with itself, keep 0 in the second half.
template <class Pair>
KOKKOS_FORCEINLINE_FUNCTION void for_each_twin(const NeighbourView& near, int cluster, const Pair& pair) {
  const int n = near.length(cluster);
  const int* j = &near.list(cluster, 0);
  for (int k = 0; k < n; k += neighbours_at_once) {
    const bool both = k + neighbours_at_once <= n;
    pair(j[k], j[both ? k + neighbours_at_once - 1 : k], kept(both));
  }
}

// Added to r^2 like tiny_square, as large as single precision needs.
template <class V>
inline constexpr double least_square = tiny_square;
template <>
inline constexpr double least_square<pack<float, 2 * lanes>> = 1e-24;  // m2

}  // namespace freshet
