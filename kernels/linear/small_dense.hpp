// Small symmetric systems of fixed size, for values V that are doubles or packs: all loops are unrolled by
// the compiler's front end, so that the numbers stay in registers. Device-safe.
#pragma once
#include <utility>

#include "cellgrid/simd/lanes.hpp"

namespace freshet {

// Calls f(integral_constant 0), ..., f(integral_constant N - 1).
template <class F, int... K>
KOKKOS_FORCEINLINE_FUNCTION void unroll(const F& f, std::integer_sequence<int, K...>) {
  (f(std::integral_constant<int, K>{}), ...);
}
template <int N, class F>
KOKKOS_FORCEINLINE_FUNCTION void unroll(const F& f) {
  unroll(f, std::make_integer_sequence<int, N>{});
}

template <class V, int N>
struct Column {
  V a[N];
  KOKKOS_FORCEINLINE_FUNCTION V& operator[](int k) { return a[k]; }
  KOKKOS_FORCEINLINE_FUNCTION const V& operator[](int k) const { return a[k]; }
};

template <class V, int N>
KOKKOS_FORCEINLINE_FUNCTION V dot(const Column<V, N>& a, const Column<V, N>& b) {
  V sum = a[0] * b[0];
  unroll<N - 1>([&](auto k) { sum += a[k + 1] * b[k + 1]; });
  return sum;
}

// The lower triangle of a symmetric matrix, row by row.
template <class V, int N>
struct Symmetric {
  V a[N * (N + 1) / 2];

  static constexpr int slot(int i, int j) { return i * (i + 1) / 2 + j; }  // j <= i
  KOKKOS_FORCEINLINE_FUNCTION V& operator()(int i, int j) { return a[slot(i, j)]; }
  KOKKOS_FORCEINLINE_FUNCTION const V& operator()(int i, int j) const { return a[slot(i, j)]; }

  // += s c c^T
  KOKKOS_FORCEINLINE_FUNCTION void add_square(const V& s, const Column<V, N>& c) {
    unroll<N>([&](auto i) {
      const V sc = s * c[i];
      unroll<i + 1>([&](auto j) { a[slot(i, j)] += sc * c[j]; });
    });
  }
};

// Pivots below `least` times their diagonal entry count as zero: the unknown is left out (its value becomes
// 0). Those of the unknowns from `soft_from` on grow by `stiffness` times what they fall short of `soft`
// times their diagonal entry: what the system hardly determines is drawn towards 0.
template <class V>
struct Pivots {
  double least = 1e-10;
  int soft_from = 1 << 30;
  double stiffness = 0;
  V soft = V(0.0);
};

// L D L^T of a symmetric matrix with no negative eigenvalues; singular ones have a bounded answer. `complete`
// tells how many unknowns the matrix determines (1 = all).
template <class V, int N>
class Factored {
 public:
  explicit KOKKOS_FORCEINLINE_FUNCTION Factored(const Symmetric<V, N>& g, const Pivots<V>& pivots = {})
      : l_(g) {
    V kept{0.0};
    unroll<N>([&](auto i) {
      unroll<i>([&](auto j) {  // l(i, j) holds L D until its row is done
        unroll<j>([&](auto k) { l_(i, j) -= l_(i, k) * l_(j, k); });
      });
      V pivot = l_(i, i);
      unroll<i>([&](auto j) {
        const V scaled = l_(i, j) * inverse_[j];
        pivot -= scaled * l_(i, j);
        l_(i, j) = scaled;
      });
      const V least = pivots.least * g(i, i);
      kept += select(least < pivot, V(1.0), V(0.0));
      if (i >= pivots.soft_from) pivot += pivots.stiffness * larger(V(0.0), pivots.soft * g(i, i) - pivot);
      const auto sound = least < pivot;
      inverse_[i] = select(sound, V(1.0) / select(sound, pivot, V(1.0)), V(0.0));
    });
    complete_ = kept * V(1.0 / N);
  }

  KOKKOS_FORCEINLINE_FUNCTION Column<V, N> solve(Column<V, N> b) const {
    unroll<N>([&](auto i) { unroll<i>([&](auto j) { b[i] -= l_(i, j) * b[j]; }); });
    unroll<N>([&](auto i) { b[i] *= inverse_[i]; });
    unroll<N>([&](auto r) {
      constexpr int i = N - 1 - r;
      unroll<r>([&](auto k) { b[i] -= l_(i + 1 + k, i) * b[i + 1 + k]; });
    });
    return b;
  }

  KOKKOS_FORCEINLINE_FUNCTION const V& complete() const { return complete_; }

 private:
  Symmetric<V, N> l_;
  Column<V, N> inverse_;
  V complete_;
};

}  // namespace freshet
