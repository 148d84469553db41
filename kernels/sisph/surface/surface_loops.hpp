// The loops over pairs and particles of surface.cpp.
#pragma once
#include "kernels/sisph/pairs/parts.hpp"
#include "kernels/sisph/surface/surface.hpp"

namespace freshet::sisph {
namespace {

// The depth of what runs up onto dry land: the water that half its velocity head lifts above the higher bed,
// at most that at the pair's middle and what there is. Without it a front stands before every dry particle
// until the water is as high as its bed.
KOKKOS_FORCEINLINE_FUNCTION Lane run_up_depth(Lane depth, Lane bed, Lane dry_bed, Lane half_head) {
  const Lane lifted = bed + depth + half_head - dry_bed, middle = depth + 0.5 * (bed - dry_bed);
  return larger(smaller(smaller(lifted, middle), depth), Lane(0.0));
}

// a, f, b, the row sums, the residual of the iterate and the share of its outflow f that a particle has water
// for; returns the slice's terms of |r|^2 and |b|^2, and how many of its particles would give more than they
// have. a is written where it is stored.
template <int D, bool drying, bool stored>
struct PairCoefficients {
  Geometry<D> g;
  SliceList active;
  Layer<D> water;
  VecField<double, D> before;
  Field<double> last_depth, level;                         // of the Picard pass before
  Field<double> drag;                                      // dt gamma; empty unless dragged
  Field<double> a, flux, right, residual, row_sum, share;  // written
  double stiffness, dt, gravity;                           // g theta^2 dt^2
  bool dragged;

  // The depth that f is carried in, vn its velocity from i to j.
  KOKKOS_FORCEINLINE_FUNCTION Lane carried_depth(Lane hi, Lane hj, Lane bi, Lane bj, Lane vn) const {
    const Lane still = face_depth<drying>(hi, hj, bi, bj);
    if constexpr (!drying) return still;
    const auto outward = Lane(0.0) < vn;
    const Lane giver = select(outward, hi, hj), taker = select(outward, hj, hi),
               half_head = (0.25 / gravity) * vn * vn;
    const Lane up = run_up_depth(giver, select(outward, bi, bj), select(outward, bj, bi), half_head);
    return still + (1.0 - wetness(taker, giver)) * larger(up - still, Lane(0.0));
  }

  KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, D> pair_velocity(const Vec<Lane, D>& vi, const Vec<Lane, D>& vj,
                                                         Lane hi, Lane hj) const {
    if constexpr (!drying) return Lane(0.5) * (vi + vj);
    const Lane per = 1.0 / (hi + hj + 1e-300);
    return (hi * per) * vi + (hj * per) * vj;
  }

  KOKKOS_FUNCTION LaneAddends<3> operator()(int k) const {
    const int s = active(k);
    const Lanes me = g.pairs(s);
    const Vec<Lane, D> vi = me.load(before);
    const Holding i{me.load(water.depth), larger(me.load(last_depth), Lane(0.0)), me.load(water.bed),
                    dragged ? me.load(drag) : Lane(0.0)};
    const Lane eta = me.load(level);
    Lane outflow(0.0), given(0.0), sum_a(0.0), drawn(0.0);
    g.pairs.for_each(s, [&](int e, PairIndex index) {
      const Holding j{gather(water.depth.data(), index), larger(gather(last_depth.data(), index), Lane(0.0)),
                      drying ? gather(water.bed.data(), index) : Lane(0.0),
                      dragged ? gather(drag.data(), index) : Lane(0.0)};
      const Lane vn = dot(pair_velocity(vi, gather(before, index), i.depth + i.last, j.depth + j.last),
                          PairView::load(g.n, e));
      const Lane carried = 0.5 * (carried_depth(i.depth, j.depth, i.bed, j.bed, vn) +
                                  carried_depth(i.last, j.last, i.bed, j.bed, vn));
      const Lane area = PairView::load(g.area, e), f = area * carried * vn;
      const Lane aij = coefficient<drying>(stiffness, area, PairView::load(g.distance, e), i, j, dragged);
      PairView::store(flux, e, f);
      if constexpr (stored) PairView::store(a, e, aij);
      outflow += f;
      given += larger(f, Lane(0.0));
      sum_a += aij;
      drawn += aij * (gather(level.data(), index) - eta);
    });
    const Lane omega = me.load(g.omega), free = free_lanes(g, me);
    const Lane has = omega * i.depth, wanted = dt * given,
               overdrawn = select(has < free * wanted, Lane(1.0), Lane(0.0));
    const Lane b = has - dt * outflow, r = free * (b + drawn - omega * larger(eta - i.bed, Lane(0.0)));
    me.store(right, b);
    me.store(row_sum, sum_a);
    me.store(residual, r);
    me.store(share, select(Lane(0.5) < overdrawn, has / (wanted + 1e-300), Lane(1.0)));
    return {{counted(me, r * r), counted(me, free * b * b), counted(me, overdrawn)}};
  }
};

// Scales f by the donor's share, so that b >= 0: else a film that runs off has to be held by a surface far
// below the bed, which costs CG and Newton many iterations. Returns the slice's terms of |r|^2 and |b|^2.
template <int D>
struct LimitOutflow {
  Geometry<D> g;
  SliceList active;
  Field<double> depth, share, flux, right, residual;
  double dt;

  KOKKOS_FUNCTION LaneAddends<2> operator()(int k) const {
    const int s = active(k);
    const Lanes me = g.pairs(s);
    const Lane mine = me.load(share), free = free_lanes(g, me);
    Lane outflow(0.0);
    g.pairs.for_each(s, [&](int e, PairIndex j) {
      const Lane f = PairView::load(flux, e),
                 limited = f * select(Lane(0.0) < f, mine, gather(share.data(), j));
      PairView::store(flux, e, limited);
      outflow += limited;
    });
    const Lane b = me.load(g.omega) * me.load(depth) - dt * outflow,
               r = me.load(residual) + free * (b - me.load(right));
    me.store(right, b);
    me.store(residual, r);
    return {{counted(me, r * r), counted(me, free * b * b)}};
  }
};

// The depth from the fluxes, b - T eta = omega H, and the residual against V(eta); returns the slice's terms
// of |r|^2.
template <int D, class Matrix>
struct Residual {
  Geometry<D> g;
  SliceList active;
  Matrix a;
  Field<double> level, bed, right, depth, residual;

  KOKKOS_FUNCTION LaneAddends<1> operator()(int k) const {
    const int s = active(k);
    const Lanes me = g.pairs(s);
    const Lane eta = me.load(level), omega = me.load(g.omega), free = free_lanes(g, me);
    Lane drawn(0.0);
    a.for_each(g.pairs, s,
               [&](int, PairIndex j, Lane aij) { drawn += aij * (gather(level.data(), j) - eta); });
    const Lane volume = me.load(right) + drawn;
    const Lane r = free * (volume - omega * larger(eta - me.load(bed), Lane(0.0)));
    me.store(depth, select(Lane(0.5) < free, volume / omega, me.load(depth)));
    me.store(residual, r);
    return {{counted(me, r * r)}};
  }
};

// Every row solved for its own level, its neighbours' as they are.
template <int D, class Matrix>
struct LevelAlone {
  Geometry<D> g;
  SliceList active;
  Matrix a;
  Field<double> level, bed, right, row_sum, found;

  KOKKOS_FUNCTION void operator()(int k) const {
    const int s = active(k);
    const Lanes me = g.pairs(s);
    const Lane sum = me.load(row_sum), floor = me.load(bed);
    // were its level the bed's
    const Lane excess = me.load(right) + a.weighted_sum(g.pairs, s, level) - sum * floor;
    const Lane slope = sum + select(Lane(0.0) < excess, me.load(g.omega), Lane(0.0));
    const auto tied = (Lane(0.0) < sum) & (Lane(0.5) < free_lanes(g, me));
    me.store(found, select(tied, floor + excess / (slope + 1e-300), me.load(level)));
  }
};

}  // namespace
}  // namespace freshet::sisph
