// The loops over pairs of moving particles, slice by slice.
#pragma once
#include "kernels/sisph/moving/moving.hpp"

namespace freshet::sisph {
namespace {

// S^-1 sum_j omega_j G_ij (f_j - f_i) n_ij
template <int D, class Difference>
KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, D> slope_of(const Geometry<D>& g, int s, const Difference& difference) {
  const Lanes me = g.pairs(s);
  Vec<Lane, D> sum;
  g.pairs.for_each(s, [&](int e, PairIndex j) {
    sum += (PairView::load(g.weight, e) * difference(j)) * PairView::load(g.n, e);
  });
  return me.load(g.inverse) * sum;
}

// 1 / (1 + dt gamma)
KOKKOS_FORCEINLINE_FUNCTION Lane slowed(const Lanes& me, const Field<double>& drag) {
  return drag.extent(0) > 0 ? 1.0 / (1.0 + me.load(drag)) : Lane(1.0);
}

// grad eta_th and v_th.
template <int D>
struct Predict {
  Geometry<D> g;
  Field<double> level, drag;
  VecField<double, D> v, slope, mixed;
  double impulse, theta;  // g dt

  KOKKOS_FUNCTION void operator()(int s) const {
    const Lanes me = g.pairs(s);
    const Lane eta = me.load(level);
    const Vec<Lane, D> up = slope_of(g, s, [&](const PairIndex& j) { return gather(level.data(), j) - eta; });
    const Vec<Lane, D> before = me.load(v),
                       end = slowed(me, drag) * (before - (impulse * free_lanes(g, me)) * up);
    me.store(slope, up);
    me.store(mixed, before + Lane(theta) * (end - before));
  }
};

// The system of the correction; returns the slice's parts of |b|^2 and |omega|^2.
template <int D, bool dragged>
struct Increment {
  Geometry<D> g;
  VecField<double, D> mixed, slope;
  Field<double> level, change, inertia, rise, drag, a, right, diagonal, inverse;
  double stiffness, theta, dt;  // g theta^2 dt^2

  KOKKOS_FUNCTION LaneAddends<2> operator()(int s) const {
    const Lanes me = g.pairs(s);
    const Vec<Lane, D> vi = me.load(mixed), up = me.load(slope);
    const Sym<Lane, D> scale = me.load(g.inverse);
    const Lane mass = me.load(inertia), omega = me.load(g.omega), free = free_lanes(g, me),
               eta = me.load(level);
    Lane held_back(0.0);
    if constexpr (dragged) held_back = 0.5 * me.load(drag);
    Lane spread(0.0), rough(0.0), sum = mass;
    g.pairs.for_each(s, [&](int e, PairIndex j) {
      const Vec<Lane, D> n = PairView::load(g.n, e);
      const Lane d = PairView::load(g.distance, e);
      Lane aij = stiffness * PairView::load(g.area, e) / d;
      if constexpr (dragged) aij = aij / (1.0 + held_back + 0.5 * gather(drag.data(), j));
      PairView::store(a, e, aij);
      sum += aij;
      spread += PairView::load(g.weight, e) * dot(gather(mixed, j) - vi, scale * n);
      rough += aij * (gather(level.data(), j) - eta - 0.5 * d * dot(gather(slope, j) + up, n));
    });
    const Lane b =
        free * (mass * (me.load(rise) - me.load(change)) - dt * omega * spread + (1 / theta) * rough);
    me.store(right, b);
    me.store(diagonal, sum);
    me.store(inverse, free / sum);
    return LaneAddends<2>{{counted(me, b * b), counted(me, omega * omega)}};
  }
};

// d eta, v^{n+1} and H^{n+1} after the correction.
template <int D>
struct Correct {
  Geometry<D> g;
  Field<double> correction, change, depth, rise, last, drag;
  VecField<double, D> slope, v, end;
  double impulse, theta;  // g dt

  KOKKOS_FUNCTION void operator()(int s) const {
    const Lanes me = g.pairs(s);
    const Lane mine = me.load(correction), total = me.load(change) + mine;
    const Vec<Lane, D> more =
        slope_of(g, s, [&](const PairIndex& j) { return gather(correction.data(), j) - mine; });
    const Vec<Lane, D> up = me.load(slope) + Lane(theta) * more;
    me.store(end, slowed(me, drag) * (me.load(v) - (impulse * free_lanes(g, me)) * up));
    me.store(change, total);
    me.store(last, me.load(depth) + (total - me.load(rise)));
  }
};

KOKKOS_FORCEINLINE_FUNCTION Lane size2(Lane omega, Vec<double, 1>) { return omega * omega; }
KOKKOS_FORCEINLINE_FUNCTION Lane size2(Lane omega, Vec<double, 2>) { return omega; }
KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 1> along(const VelocityGradient<1>& f, const Lanes& me,
                                               const PairIndex& j, const Vec<Lane, 1>& n) {
  return {dot(me.load(f.u) + gather(f.u, j), n)};
}
KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 2> along(const VelocityGradient<2>& f, const Lanes& me,
                                               const PairIndex& j, const Vec<Lane, 2>& n) {
  return {dot(me.load(f.u) + gather(f.u, j), n), dot(me.load(f.v) + gather(f.v, j), n)};
}

// v + share min(1, sharp |r| dt / dx) r,   r_i = dx_i^2 / omega_i sum_j A_ij / d_ij [v_j - v_i - d_ij (grad
// v_i + grad v_j) n_ij / 2], dx_i^D = omega_i: what moves neighbours against each other decays before it has
// moved them a spacing / sharp or so, and smooth velocities hardly feel it.
template <int D>
struct Even {
  Geometry<D> g;
  VecField<double, D> v, even;
  VelocityGradient<D> gradient;
  double per_speed;  // dt / dx, s/m

  KOKKOS_FUNCTION void operator()(int s) const {
    constexpr double share = 0.3;  // takes two thirds of the shortest waves on a lattice
    constexpr double sharp = 10;
    const Lanes me = g.pairs(s);
    const Vec<Lane, D> vi = me.load(v);
    const Lane omega = me.load(g.omega), scale = free_lanes(g, me) * size2(omega, Vec<double, D>{}) / omega;
    Vec<Lane, D> sum;
    g.pairs.for_each(s, [&](int e, PairIndex j) {
      const Lane d = PairView::load(g.distance, e),
                 w = gather(g.free.data(), j) * PairView::load(g.area, e) / d;
      sum += w * (gather(v, j) - vi - (0.5 * d) * along(gradient, me, j, PairView::load(g.n, e)));
    });
    const Vec<Lane, D> rough = scale * sum;
    me.store(even, vi + (share * smaller(sharp * per_speed * root(dot(rough, rough)), Lane(1.0))) * rough);
  }
};

// The square of the largest |v_i - v_j| of pairs.
template <int D>
struct LargestJump {
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
