#include "kernels/sisph/velocity/gradient.hpp"

#include "cellgrid/parallel/launch.hpp"

namespace freshet::sisph {
namespace {

template <int D>
struct Smooth {
  Geometry<D> g;
  SliceList active;
  Field<double> depth, bed;
  VecField<double, D> gradient;

  KOKKOS_FUNCTION void operator()(int k) const {
    const int s = active(k);
    const Lanes me = g.pairs(s);
    const Lane eta = me.load(bed) + me.load(depth);
    Vec<Lane, D> sum;
    g.pairs.for_each(s, [&](int e, PairIndex j) {
      const Lane difference = gather(bed.data(), j) + gather(depth.data(), j) - eta;
      sum += (PairView::load(g.weight, e) * difference) * PairView::load(g.n, e);
    });
    me.store(gradient, free_lanes(g, me) * (me.load(g.inverse) * sum));
  }
};

// S^-1, or the inverse of S + 0.1 tr(S) 1 where S is singular, of what lies between where it nearly is; zero
// for zero.
KOKKOS_FORCEINLINE_FUNCTION Sym<Lane, 1> guarded_inverse(const Sym<Lane, 1>& m) {
  return {select(Lane(1e-12) < m.xx, 1.0 / (m.xx + least_moment), Lane(0.0))};
}
KOKKOS_FORCEINLINE_FUNCTION Sym<Lane, 2> guarded_inverse(const Sym<Lane, 2>& m) {
  const Lane half = 0.5 * trace(m), flat = m.xx * m.yy - m.xy * m.xy;
  const Lane extra = 0.2 * half * larger(1.0 - flat / (0.05 * half * half + 1e-300), Lane(0.0));
  const Lane xx = m.xx + extra, yy = m.yy + extra, det = xx * yy - m.xy * m.xy;
  const Lane per = select(Lane(1e-24) < half, 1.0 / (det + least_moment), Lane(0.0));
  return {per * yy, -per * m.xy, per * xx};
}

template <int D>
struct Drying {
  Geometry<D> g;
  SliceList active;
  Field<double> depth, bed;
  VecField<double, D> gradient;

  KOKKOS_FUNCTION void operator()(int k) const {
    constexpr double film = 1e-6,
                     clear = 0.05;  // m; of the deepest pair, above every bed around: away from the front
    const int s = active(k);
    const Lanes me = g.pairs(s);
    const Lane bi = me.load(bed), eta = bi + larger(me.load(depth), Lane(0.0));
    Vec<Lane, D> sum, weighted;
    Sym<Lane, D> moment;
    Lane lowest(1e300), deepest(1e-300);
    g.pairs.for_each(s, [&](int e, PairIndex j) {
      const Lane bj = gather(bed.data(), j), level = bj + larger(gather(depth.data(), j), Lane(0.0));
      const Vec<Lane, D> n = PairView::load(g.n, e);
      const Lane w = PairView::load(g.weight, e), higher = larger(bi, bj), pull = w * (level - eta);
      const Lane above = larger(larger(eta, level) - higher, Lane(0.0));
      sum += pull * n;
      weighted += (pull * above) * n;
      moment += outer(n, w * above * PairView::load(g.distance, e));
      lowest = smaller(lowest, smaller(eta, level) - higher);
      deepest = larger(deepest, above);
    });
    // Weights of order one, so that "nearly zero" means something; a film says nothing of the surface where
    // water comes to.
    const Lane per = 1.0 / deepest, told = deepest / (deepest + film);
    const Vec<Lane, D> smooth = me.load(g.inverse) * sum,
                       front = told * (guarded_inverse(scaled(moment, per)) * (per * weighted));
    const Lane away = larger(smaller(per * lowest / clear, Lane(1.0)), Lane(0.0));
    me.store(gradient, free_lanes(g, me) * (front + away * (smooth - front)));
  }

 private:
  static KOKKOS_FORCEINLINE_FUNCTION Sym<Lane, 1> scaled(const Sym<Lane, 1>& m, Lane f) { return {f * m.xx}; }
  static KOKKOS_FORCEINLINE_FUNCTION Sym<Lane, 2> scaled(const Sym<Lane, 2>& m, Lane f) {
    return {f * m.xx, f * m.xy, f * m.yy};
  }
};

template <int D>
struct Velocities {
  Geometry<D> g;
  SliceList active;
  Layer<D> water;
  VelocityGradient<D> out;

  KOKKOS_FUNCTION void operator()(int k) const {
    constexpr double thin = 0.1, full = 0.3;  // of the deeper of two
    const int s = active(k);
    const Lanes me = g.pairs(s);
    const Vec<Lane, D> vi = me.load(water.v);
    const Lane hi = me.load(water.depth);
    Vec<Lane, D> of_u, of_v;
    Lane least_share = select(Lane(0.0) < hi, Lane(1.0), Lane(0.0));
    g.pairs.for_each(s, [&](int e, PairIndex j) {
      const Lane hj = gather(water.depth.data(), j), w = PairView::load(g.weight, e);
      const Vec<Lane, D> n = PairView::load(g.n, e), difference = gather(water.v, j) - vi;
      least_share = smaller(least_share, smaller(hi, hj) / (larger(hi, hj) + 1e-300));
      of_u += (w * difference.x) * n;
      if constexpr (D == 2) of_v += (w * difference.y) * n;
    });
    const Lane kept =
        free_lanes(g, me) * larger(smaller((least_share - thin) / (full - thin), Lane(1.0)), Lane(0.0));
    const Sym<Lane, D> inverse = me.load(g.inverse);
    me.store(out.u, kept * (inverse * of_u));
    if constexpr (D == 2) me.store(out.v, kept * (inverse * of_v));
  }
};

}  // namespace

template <int D>
void surface_gradient(const Geometry<D>& g, const SliceList& active, const Field<double>& depth,
                      const Field<double>& bed, const VecField<double, D>& gradient, bool drying) {
  const Range range(0, active.count);
  if (drying) launch("sisph::gradient_drying", range, Drying<D>{g, active, depth, bed, gradient});
  else launch("sisph::gradient", range, Smooth<D>{g, active, depth, bed, gradient});
}

template <int D>
void velocity_gradient(const Geometry<D>& g, const SliceList& active, const Layer<D>& water,
                       const VelocityGradient<D>& gradient) {
  g.images.fill(water.v);
  launch("sisph::velocity_gradient", Range(0, active.count), Velocities<D>{g, active, water, gradient});
  g.images.fill_gradient(gradient.u, gradient.v);
}

template void surface_gradient(const Geometry<1>&, const SliceList&, const Field<double>&,
                               const Field<double>&, const VecField<double, 1>&, bool);
template void surface_gradient(const Geometry<2>&, const SliceList&, const Field<double>&,
                               const Field<double>&, const VecField<double, 2>&, bool);
template void velocity_gradient(const Geometry<1>&, const SliceList&, const Layer<1>&,
                                const VelocityGradient<1>&);
template void velocity_gradient(const Geometry<2>&, const SliceList&, const Layer<2>&,
                                const VelocityGradient<2>&);

}  // namespace freshet::sisph
