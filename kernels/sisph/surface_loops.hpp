// The loops over pairs and particles of surface.cpp.
#pragma once
#include "kernels/sisph/parts.hpp"
#include "kernels/sisph/surface.hpp"

namespace freshet::sisph {
namespace {

// The depth of what runs up onto dry land: the water that half its velocity head lifts above the higher bed, at most that at the
// pair's middle and what there is. Without it a front stands before every dry particle until the water is as high as its bed.
KOKKOS_FORCEINLINE_FUNCTION Lane run_up_depth(Lane depth, Lane bed, Lane dry_bed, Lane half_head) {
  const Lane lifted = bed + depth + half_head - dry_bed, middle = depth + 0.5 * (bed - dry_bed);
  return larger(smaller(smaller(lifted, middle), depth), Lane(0.0));
}

// a, f, b, the row sums, the residual of the iterate and the share of its outflow f that a particle has water for; returns the
// slice's parts of |r|^2 and |b|^2, and how many of its particles would give more than they have.
template <int D, bool drying, bool dragged>
struct Coefficients {
  Geometry<D> g;
  SliceList active;
  Water<D> water;
  VecField<double, D> before;
  Field<double> last_depth, level;                 // of the Picard pass before
  Field<double> drag;                              // dt gamma
  Field<double> a, flux, right, residual, row_sum, share;  // written
  double stiffness, dt, gravity;                   // g theta^2 dt^2

  // The depth that f is carried in, vn its velocity from i to j.
  KOKKOS_FORCEINLINE_FUNCTION Lane carried_depth(Lane hi, Lane hj, Lane bi, Lane bj, Lane vn) const {
    const Lane still = face_depth<drying>(hi, hj, bi, bj);
    if constexpr (!drying) return still;
    const auto outward = Lane(0.0) < vn;
    const Lane giver = select(outward, hi, hj), taker = select(outward, hj, hi), half_head = (0.25 / gravity) * vn * vn;
    const Lane up = run_up_depth(giver, select(outward, bi, bj), select(outward, bj, bi), half_head);
    return still + (1.0 - wetness(taker, giver)) * larger(up - still, Lane(0.0));
  }

  KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, D> pair_velocity(const Vec<Lane, D>& vi, const Vec<Lane, D>& vj, Lane hi, Lane hj) const {
    if constexpr (!drying) return Lane(0.5) * (vi + vj);
    const Lane per = 1.0 / (hi + hj + 1e-300);
    return (hi * per) * vi + (hj * per) * vj;
  }

  KOKKOS_FUNCTION Kokkos::Array<double, 3> operator()(int k) const {
    const int s = active(k);
    const Lanes me = g.pairs(s);
    const Vec<Lane, D> vi = me.load(before);
    const Lane hi = me.load(water.depth), li = larger(me.load(last_depth), Lane(0.0)), bi = me.load(water.bed), eta = me.load(level);
    Lane outflow(0.0), given(0.0), sum_a(0.0), drawn(0.0), drag_i(0.0);
    if constexpr (dragged) drag_i = me.load(drag);
    g.pairs.for_each(s, [&](int e, PairIndex j) {
      const Lane hj = gather(water.depth.data(), j), lj = larger(gather(last_depth.data(), j), Lane(0.0));
      const Lane bj = drying ? gather(water.bed.data(), j) : Lane(0.0);
      const Lane face = 0.5 * (face_depth<drying>(hi, hj, bi, bj) + face_depth<drying>(li, lj, bi, bj));
      const Lane vn = dot(pair_velocity(vi, gather(before, j), hi + li, hj + lj), PairView::load(g.n, e));
      const Lane carried = 0.5 * (carried_depth(hi, hj, bi, bj, vn) + carried_depth(li, lj, bi, bj, vn));
      const Lane area = PairView::load(g.area, e), f = area * carried * vn;
      Lane aij = stiffness * area * face / PairView::load(g.distance, e);
      if constexpr (dragged) aij = aij / (1.0 + 0.5 * (drag_i + gather(drag.data(), j)));
      PairView::store(flux, e, f);
      PairView::store(a, e, aij);
      outflow += f;
      given += larger(f, Lane(0.0));
      sum_a += aij;
      drawn += aij * (gather(level.data(), j) - eta);
    });
    const Lane omega = me.load(g.omega), free = free_lanes(g, me);
    const Lane has = omega * hi, wanted = dt * given, overdrawn = select(has < free * wanted, Lane(1.0), Lane(0.0));
    const Lane b = has - dt * outflow, r = free * (b + drawn - omega * larger(eta - bi, Lane(0.0)));
    me.store(right, b);
    me.store(row_sum, sum_a);
    me.store(residual, r);
    me.store(share, select(Lane(0.5) < overdrawn, has / (wanted + 1e-300), Lane(1.0)));
    return {{sum_of(me, r * r), sum_of(me, free * b * b), sum_of(me, overdrawn)}};
  }
};

// Scales f by the donor's share, so that b >= 0: else a film that runs off has to be held by a surface far below the bed, which
// costs CG and Newton many iterations. Returns the slice's parts of |r|^2 and |b|^2.
template <int D>
struct LimitOutflow {
  Geometry<D> g;
  SliceList active;
  Field<double> depth, share, flux, right, residual;
  double dt;

  KOKKOS_FUNCTION Kokkos::Array<double, 2> operator()(int k) const {
    const int s = active(k);
    const Lanes me = g.pairs(s);
    const Lane mine = me.load(share), free = free_lanes(g, me);
    Lane outflow(0.0);
    g.pairs.for_each(s, [&](int e, PairIndex j) {
      const Lane f = PairView::load(flux, e), limited = f * select(Lane(0.0) < f, mine, gather(share.data(), j));
      PairView::store(flux, e, limited);
      outflow += limited;
    });
    const Lane b = me.load(g.omega) * me.load(depth) - dt * outflow, r = me.load(residual) + free * (b - me.load(right));
    me.store(right, b);
    me.store(residual, r);
    return {{sum_of(me, r * r), sum_of(me, free * b * b)}};
  }
};

// y = (P + T) x; returns the slice's part of x . y.
template <int D>
struct Product {
  Geometry<D> g;
  SliceList active;
  Field<double> a, diagonal, x, y;

  KOKKOS_FUNCTION Kokkos::Array<double, 1> operator()(int k) const {
    const int s = active(k);
    const Lanes me = g.pairs(s);
    const Lane xi = me.load(x);
    const Lane row = free_lanes(g, me) * (me.load(diagonal) * xi - g.pairs.weighted_sum(s, a, x));
    me.store(y, row);
    return {{sum_of(me, xi * row)}};
  }
};

// The depth from the fluxes, b - T eta = omega H, and the residual against V(eta); returns the slice's part of |r|^2.
template <int D>
struct Residual {
  Geometry<D> g;
  SliceList active;
  Field<double> a, level, bed, right, depth, residual;

  KOKKOS_FUNCTION Kokkos::Array<double, 1> operator()(int k) const {
    const int s = active(k);
    const Lanes me = g.pairs(s);
    const Lane eta = me.load(level), omega = me.load(g.omega), free = free_lanes(g, me);
    Lane drawn(0.0);
    g.pairs.for_each(s, [&](int e, PairIndex j) { drawn += PairView::load(a, e) * (gather(level.data(), j) - eta); });
    const Lane volume = me.load(right) + drawn;
    const Lane r = free * (volume - omega * larger(eta - me.load(bed), Lane(0.0)));
    me.store(depth, select(Lane(0.5) < free, volume / omega, me.load(depth)));
    me.store(residual, r);
    return {{sum_of(me, r * r)}};
  }
};

// Every row solved for its own level, its neighbours' as they are.
template <int D>
struct LevelAlone {
  Geometry<D> g;
  SliceList active;
  Field<double> a, level, bed, right, row_sum, found;

  KOKKOS_FUNCTION void operator()(int k) const {
    const int s = active(k);
    const Lanes me = g.pairs(s);
    const Lane sum = me.load(row_sum), floor = me.load(bed);
    const Lane excess = me.load(right) + g.pairs.weighted_sum(s, a, level) - sum * floor;  // were its level the bed's
    const Lane slope = sum + select(Lane(0.0) < excess, me.load(g.omega), Lane(0.0));
    const auto tied = (Lane(0.0) < sum) & (Lane(0.5) < free_lanes(g, me));
    me.store(found, select(tied, floor + excess / (slope + 1e-300), me.load(level)));
  }
};

}  // namespace
}  // namespace freshet::sisph
