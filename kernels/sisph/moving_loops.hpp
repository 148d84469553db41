// The loops over pairs of moving.cpp, slice by slice.
#pragma once
#include "kernels/sisph/moving.hpp"

namespace freshet::sisph {
namespace {

// S^-1 sum_j omega_j G_ij (f_j - f_i) n_ij; zero beside the domain.
template <int D, class Difference>
KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, D> slope_of(const Geometry<D>& g, int s, const Difference& difference) {
  const Lanes me = g.pairs(s);
  Vec<Lane, D> sum;
  g.pairs.for_each(s, [&](int e, PairIndex j) { sum += (PairView::load(g.weight, e) * difference(j)) * PairView::load(g.n, e); });
  return free_lanes(g, me) * (me.load(g.inverse) * sum);
}

// v* and v_th.
template <int D>
struct Predict {
  Geometry<D> g;
  Field<double> depth, bed;
  VecField<double, D> v, star, mixed;
  double impulse, theta;  // g dt

  KOKKOS_FUNCTION void operator()(int s) const {
    const Lanes me = g.pairs(s);
    const Lane eta = me.load(bed) + me.load(depth);
    const Vec<Lane, D> slope = slope_of(g, s, [&](const PairIndex& j) { return gather(bed.data(), j) + gather(depth.data(), j) - eta; });
    const Vec<Lane, D> before = me.load(v), pushed = before - Lane(impulse) * slope;
    me.store(star, pushed);
    me.store(mixed, Lane(1 - theta) * before + Lane(theta) * pushed);
  }
};

// The system of the increment; returns the slice's parts of |b|^2 and |omega|^2.
template <int D>
struct Increment {
  Geometry<D> g;
  VecField<double, D> mixed;
  Field<double> inertia, rise, a, right, diagonal, inverse;
  double stiffness, dt;  // g theta^2 dt^2

  KOKKOS_FUNCTION Kokkos::Array<double, 2> operator()(int s) const {
    const Lanes me = g.pairs(s);
    const Vec<Lane, D> vi = me.load(mixed);
    const Sym<Lane, D> scale = me.load(g.inverse);
    const Lane mass = me.load(inertia), omega = me.load(g.omega), free = free_lanes(g, me);
    Lane spread(0.0), sum = mass;
    g.pairs.for_each(s, [&](int e, PairIndex j) {
      const Lane aij = stiffness * PairView::load(g.area, e) / PairView::load(g.distance, e);
      PairView::store(a, e, aij);
      sum += aij;
      spread += PairView::load(g.weight, e) * dot(gather(mixed, j) - vi, scale * PairView::load(g.n, e));
    });
    const Lane b = free * (mass * me.load(rise) - dt * omega * spread);
    me.store(right, b);
    me.store(diagonal, sum);
    me.store(inverse, free / sum);
    const Lane b2 = b * b, omega2 = omega * omega;
    Kokkos::Array<double, 2> total{};
    for (int l = 0; l < me.count; ++l) total[0] += lane_of(b2, l), total[1] += lane_of(omega2, l);
    return total;
  }
};

// v^{n+1} and H^{n+1}.
template <int D>
struct Correct {
  Geometry<D> g;
  Field<double> change, depth, rise, last;
  VecField<double, D> star, end;
  double impulse;  // g theta dt

  KOKKOS_FUNCTION void operator()(int s) const {
    const Lanes me = g.pairs(s);
    const Lane mine = me.load(change);
    const Vec<Lane, D> slope = slope_of(g, s, [&](const PairIndex& j) { return gather(change.data(), j) - mine; });
    me.store(end, me.load(star) - Lane(impulse) * slope);
    me.store(last, me.load(depth) + mine - me.load(rise));
  }
};

// The square of the largest |v_i - v_j| of pairs.
template <int D>
struct Jump {
  Geometry<D> g;
  VecField<double, D> v;

  KOKKOS_FUNCTION void operator()(int s, double& most) const {
    const Vec<Lane, D> vi = g.pairs(s).load(v);
    g.pairs.for_each(s, [&](int, PairIndex j) {
      const Vec<Lane, D> between = gather(v, j) - vi;
      most = larger(most, largest(dot(between, between)));
    });
  }
};

}  // namespace
}  // namespace freshet::sisph
