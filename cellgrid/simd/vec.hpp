// Small vectors and symmetric matrices in D dimensions, of any value type V (double or pack).
#pragma once
#include <array>

#include "cellgrid/parallel/types.hpp"

namespace freshet {

template <class V, int D>
struct Vec;

template <class V>
struct Vec<V, 1> {
  V x{0.0};
  KOKKOS_FORCEINLINE_FUNCTION Vec& operator+=(const Vec& b) { return x += b.x, *this; }
  friend KOKKOS_FORCEINLINE_FUNCTION Vec operator+(const Vec& a, const Vec& b) { return {a.x + b.x}; }
  friend KOKKOS_FORCEINLINE_FUNCTION Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x}; }
  friend KOKKOS_FORCEINLINE_FUNCTION Vec operator*(const V& s, const Vec& a) { return {s * a.x}; }
};

template <class V>
struct Vec<V, 2> {
  V x{0.0}, y{0.0};
  KOKKOS_FORCEINLINE_FUNCTION Vec& operator+=(const Vec& b) { return x += b.x, y += b.y, *this; }
  friend KOKKOS_FORCEINLINE_FUNCTION Vec operator+(const Vec& a, const Vec& b) {
    return {a.x + b.x, a.y + b.y};
  }
  friend KOKKOS_FORCEINLINE_FUNCTION Vec operator-(const Vec& a, const Vec& b) {
    return {a.x - b.x, a.y - b.y};
  }
  friend KOKKOS_FORCEINLINE_FUNCTION Vec operator*(const V& s, const Vec& a) { return {s * a.x, s * a.y}; }
};

template <class V>
struct Vec<V, 3> {
  V x{0.0}, y{0.0}, z{0.0};
  KOKKOS_FORCEINLINE_FUNCTION Vec& operator+=(const Vec& b) { return x += b.x, y += b.y, z += b.z, *this; }
  friend KOKKOS_FORCEINLINE_FUNCTION Vec operator+(const Vec& a, const Vec& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend KOKKOS_FORCEINLINE_FUNCTION Vec operator-(const Vec& a, const Vec& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend KOKKOS_FORCEINLINE_FUNCTION Vec operator*(const V& s, const Vec& a) {
    return {s * a.x, s * a.y, s * a.z};
  }
};

// x and, in 2-D, y.
template <int D>
KOKKOS_FORCEINLINE_FUNCTION Vec<double, D> to_vec(double x, double y) {
  if constexpr (D == 1) return {x};
  else return {x, y};
}
template <int D>
Vec<double, D> to_vec(const std::array<double, 2>& a) {
  return to_vec<D>(a[0], a[1]);
}

KOKKOS_FORCEINLINE_FUNCTION double y_of(const Vec<double, 1>&) { return 0; }
KOKKOS_FORCEINLINE_FUNCTION double y_of(const Vec<double, 2>& a) { return a.y; }

// f of each number, of several vectors or matrices number by number.
template <class F, class... V>
KOKKOS_FORCEINLINE_FUNCTION auto each(const F& f, const Vec<V, 1>&... a) -> Vec<decltype(f(a.x...)), 1> {
  return {f(a.x...)};
}
template <class F, class... V>
KOKKOS_FORCEINLINE_FUNCTION auto each(const F& f, const Vec<V, 2>&... a) -> Vec<decltype(f(a.x...)), 2> {
  return {f(a.x...), f(a.y...)};
}

template <class V>
KOKKOS_FORCEINLINE_FUNCTION V dot(const Vec<V, 1>& a, const Vec<V, 1>& b) {
  return a.x * b.x;
}
template <class V>
KOKKOS_FORCEINLINE_FUNCTION V dot(const Vec<V, 2>& a, const Vec<V, 2>& b) {
  return a.x * b.x + a.y * b.y;
}
template <class V>
KOKKOS_FORCEINLINE_FUNCTION V dot(const Vec<V, 3>& a, const Vec<V, 3>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

// Symmetric matrix.
template <class V, int D>
struct Sym;

template <class V>
struct Sym<V, 1> {
  V xx{0.0};
  KOKKOS_FORCEINLINE_FUNCTION Sym& operator+=(const Sym& b) { return xx += b.xx, *this; }
};
template <class V>
struct Sym<V, 2> {
  V xx{0.0}, xy{0.0}, yy{0.0};
  KOKKOS_FORCEINLINE_FUNCTION Sym& operator+=(const Sym& b) {
    return xx += b.xx, xy += b.xy, yy += b.yy, *this;
  }
};

template <class F, class... V>
KOKKOS_FORCEINLINE_FUNCTION auto each(const F& f, const Sym<V, 1>&... a) -> Sym<decltype(f(a.xx...)), 1> {
  return {f(a.xx...)};
}
template <class F, class... V>
KOKKOS_FORCEINLINE_FUNCTION auto each(const F& f, const Sym<V, 2>&... a) -> Sym<decltype(f(a.xx...)), 2> {
  return {f(a.xx...), f(a.xy...), f(a.yy...)};
}

template <class V>
KOKKOS_FORCEINLINE_FUNCTION Vec<V, 1> operator*(const Sym<V, 1>& m, const Vec<V, 1>& a) {
  return {m.xx * a.x};
}
template <class V>
KOKKOS_FORCEINLINE_FUNCTION Vec<V, 2> operator*(const Sym<V, 2>& m, const Vec<V, 2>& a) {
  return {m.xx * a.x + m.xy * a.y, m.xy * a.x + m.yy * a.y};
}

// a^T M a
template <class V>
KOKKOS_FORCEINLINE_FUNCTION V quadratic(const Sym<V, 1>& m, const Vec<V, 1>& a) {
  return m.xx * (a.x * a.x);
}
template <class V>
KOKKOS_FORCEINLINE_FUNCTION V quadratic(const Sym<V, 2>& m, const Vec<V, 2>& a) {
  return m.xx * (a.x * a.x) + (2.0 * m.xy) * (a.x * a.y) + m.yy * (a.y * a.y);
}

template <class V>
KOKKOS_FORCEINLINE_FUNCTION V trace(const Sym<V, 1>& m) {
  return m.xx;
}
template <class V>
KOKKOS_FORCEINLINE_FUNCTION V trace(const Sym<V, 2>& m) {
  return m.xx + m.yy;
}

// Fields of vectors: the y part exists in 2-D only.
template <class T, int D>
struct VecField;
template <class T>
struct VecField<T, 1> {
  Field<T> x;
};
template <class T>
struct VecField<T, 2> {
  Field<T> x, y;
};
template <class T, int D>
struct SymField;
template <class T>
struct SymField<T, 1> {
  Field<T> xx;
};
template <class T>
struct SymField<T, 2> {
  Field<T> xx, xy, yy;
};

// The values of particle j.
template <class T>
KOKKOS_FORCEINLINE_FUNCTION Vec<double, 1> at(const VecField<T, 1>& f, int j) {
  return {f.x(j)};
}
template <class T>
KOKKOS_FORCEINLINE_FUNCTION Vec<double, 2> at(const VecField<T, 2>& f, int j) {
  return {f.x(j), f.y(j)};
}
template <class T>
KOKKOS_FORCEINLINE_FUNCTION void put(const VecField<T, 1>& f, int j, const Vec<double, 1>& a) {
  f.x(j) = a.x;
}
template <class T>
KOKKOS_FORCEINLINE_FUNCTION void put(const VecField<T, 2>& f, int j, const Vec<double, 2>& a) {
  f.x(j) = a.x;
  f.y(j) = a.y;
}

}  // namespace freshet
