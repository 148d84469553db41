// Vectors of a linear system: the passes that iterative solvers share. Sums depend on no order
// (cellgrid/particles/sums.hpp); each function is one visit to memory. n: unknowns; fields may be longer.
// Device-safe: KOKKOS_LAMBDA with local copies only.
#pragma once
#include "cellgrid/parallel/launch.hpp"
#include "cellgrid/parallel/work.hpp"
#include "cellgrid/particles/sums.hpp"

namespace freshet::linear {

using Vector = Field<double>;

// a . b
inline double dot(int n, const Vector& a, const Vector& b) {
  return sum_of_particles<1>(
      "linear::dot", n,
      KOKKOS_LAMBDA(const Lanes& me) { return LaneAddends<1>{{me.load(a) * me.load(b)}}; })[0];
}

// {a . b, a . c}
inline Addends<2> dots(int n, const Vector& a, const Vector& b, const Vector& c) {
  return sum_of_particles<2>(
      "linear::dots", n, KOKKOS_LAMBDA(const Lanes& me) {
        const Lane with = me.load(a);
        return LaneAddends<2>{{with * me.load(b), with * me.load(c)}};
      });
}

// y := b - y, the residual where y holds A x; returns y . y.
inline double subtract_from(int n, const Vector& b, const Vector& y) {
  return sum_of_particles<1>(
      "linear::subtract_from", n, KOKKOS_LAMBDA(const Lanes& me) {
        const Lane rest = me.load(b) - me.load(y);
        me.store(y, rest);
        return LaneAddends<1>{{rest * rest}};
      })[0];
}

// y := alpha x + y
inline void add(int n, double alpha, const Vector& x, const Vector& y) {
  launch(
      "linear::add", Range(0, n), KOKKOS_LAMBDA(int i) { y(i) += alpha * x(i); });
}

inline constexpr Cost follow_cost{0, 2, 3};
// y := x + beta y; beta = 0 is a copy, whatever y held.
inline void follow(int n, const Vector& x, double beta, const Vector& y) {
  launch(
      "linear::follow", Range(0, n), KOKKOS_LAMBDA(int i) { y(i) = beta == 0 ? x(i) : x(i) + beta * y(i); });
}

inline void fill(int n, double value, const Vector& y) {
  launch(
      "linear::fill", Range(0, n), KOKKOS_LAMBDA(int i) { y(i) = value; });
}

}  // namespace freshet::linear
