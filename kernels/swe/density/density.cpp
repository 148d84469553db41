#include "kernels/swe/density/density.hpp"

#include "cellgrid/parallel/launch.hpp"
#include "kernels/swe/density/density_sums.hpp"
#include "kernels/swe/density/least_squares.hpp"

namespace freshet::swe {
namespace {

constexpr int most_turns = 60;  // each changes rho by at most 2: enough to cross any range

// Symmetric part of the L-normalised gradient B A^-1.
KOKKOS_FORCEINLINE_FUNCTION Sym<Lane, 1> symmetric_gradient(const Gradient<Lane, 1>& b, const Sym<Lane, 1>& a,
                                                            Lane) {
  return {b.xx * usable_inverse(a).xx};
}
KOKKOS_FORCEINLINE_FUNCTION Sym<Lane, 2> symmetric_gradient(const Gradient<Lane, 2>& b, const Sym<Lane, 2>& a,
                                                            Lane shear) {
  const Sym<Lane, 2> l = usable_inverse(a);
  return {b.ux * l.xx + b.uy * l.xy, 0.5 * shear * (b.ux * l.xy + b.uy * l.yy + b.vx * l.xx + b.vy * l.xy),
          b.vx * l.xy + b.vy * l.yy};
}

template <int D, class K, bool single>
struct SolveDensity {
  SumDensity<D, K, single> sums;
  ImposedLanes imposed_lanes;
  DensityOptions options;

  struct Solved {
    Lane rho, h, alpha, imposed,
        own;  // own: part of the density that the particle's own depth makes (behind walls)
  };

  KOKKOS_INLINE_FUNCTION Lane calibration(const Lanes& me) const {
    return options.calibration.extent(0) > 0 ? me.load(options.calibration) : Lane(1.0);
  }

  // A residual whose square is far within the tolerance: the step that follows it squares the error, be it
  // Newton's or, at a bound, exact. Not where that step crosses a bound. alpha stays that of the density
  // before, so that its error is of this size.
  KOKKOS_INLINE_FUNCTION double before_last_step() const {
    return larger(options.tolerance, 0.07 * root(options.tolerance));
  }

  // Newton on psi = rho - sum m W(h(rho)) (2.8)-(2.10), its factor held within [1/2, 2]. Where h is at a
  // bound it does not follow rho: alpha = 1 and the root is the sum itself. "Bounded" is decided here, once,
  // by the last evaluation. A particle that is settled stays so whatever the others of its cluster do:
  // results do not depend on the number of lanes.
  KOKKOS_INLINE_FUNCTION void operator()(int c, double& evaluations, int& most, int& outgrown, int& capped,
                                         int& floored) const {
    const Particles<D>& p = sums.p;
    const Lanes me = sums.clusters(c);
    const Self<D> i = sums.here(me);
    const Lane kh = me.load(p.kh), listed = me.load(p.h), calibrated = calibration(me);
    const Lane low = options.bounds.floor * i.h0, high = options.bounds.cap * i.h0;
    const Lane imposed = imposed_lanes(me), free = 1.0 - imposed;
    const Lane longest_listed = (1.0 + options.margin) * listed;
    Lane rho = me.load(p.rho), h = clamp(smoothing_length<D>(kh, rho), low, smaller(high, longest_listed));
    const Lane imposed_rho = rho;
    Sums<D> s = options.gradient ? sums.template sum<Want::gradient>(c, i, rho, h)
                                 : sums.template sum<Want::rate>(c, i, rho, h);
    const Sums<D> first = s;  // the gradient and the rate need no more than the predicted h
    Lane alpha{1.0}, bounded{0.0}, own{0.0};
    auto open = first_lanes(me.count);  // not settled yet
    int n = 1;
    for (int turn = 1;; ++turn) {
      const Lane total = calibrated * (s.density + s.wall.density);
      const Lane moment = calibrated * (s.moment * power<D>(1.0 / h) / h + s.wall.moment);
      const Lane wanted = smoothing_length<D>(kh, rho);
      bounded = select(open, select((low < wanted) & (wanted < high), Lane(0.0), Lane(1.0)), bounded);
      alpha = select(open, moment / (rho * double(D)), alpha);
      own = select(open, sums.walls.follows_depth() * calibrated * s.wall.density / rho, own);
      const Lane slope = rho - total + rho * (alpha - own);
      // Held by the list like by a bound: then it ends as outgrown, and the list is made again.
      const Lane held = select(smaller(high, longest_listed) < wanted, Lane(1.0), bounded);
      const Lane newton =
          select(Lane(0.0) < slope, rho * (alpha - own) / larger(slope, Lane(1e-300)), Lane(2.0));
      const Lane sum_itself = (total / rho - own) / larger(1.0 - own, Lane(0.1));
      const Lane factor = select(Lane(0.5) < held, sum_itself, newton);
      const Lane residual = free * larger(rho - total, total - rho) / rho;
      const Lane stepped =
          select(Lane(0.5) < imposed, imposed_rho, rho * clamp(factor, Lane(0.5), Lane(2.0)));
      rho = select(open, stepped, rho);
      const Lane found = smoothing_length<D>(kh, rho);
      const Lane bounded_then = select((low < found) & (found < high), Lane(0.0), Lane(1.0));
      const Lane enough = select(Lane(0.25) < size_of(bounded_then - bounded), Lane(options.tolerance),
                                 Lane(before_last_step()));
      open = open & (enough < residual);
      if (!any(open) || turn == most_turns) break;
      const Lane next = clamp(smoothing_length<D>(kh, rho), low, smaller(high, longest_listed));
      if (!any((next < h) | (h < next)) && !sums.follow_depth(c)) continue;  // a fixed h: the sums are known
      h = next;
      s = sums.template sum<Want::density>(c, i, rho, h);
      ++n;
    }
    const Lane wanted = clamp(smoothing_length<D>(kh, rho), low, high);
    h = select(Lane(0.5) < imposed, smoothing_length<D>(kh, rho), wanted);
    alpha = select(Lane(0.5) < imposed, Lane(options.imposed_alpha),
                   select(Lane(0.5) < bounded, Lane(1.0), alpha));
    write(me, {rho, h, alpha, imposed, own}, first, i.m);
    evaluations += n;
    most = larger(most, n);
    const auto active = first_lanes(me.count);
    const auto at_bound = active & (Lane(0.5) < bounded) & (imposed < Lane(0.5));
    outgrown += count(active & (longest_listed < h));
    capped += count(at_bound & (i.h0 < h));
    floored += count(at_bound & (h < i.h0));
  }

  KOKKOS_INLINE_FUNCTION void write(const Lanes& me, const Solved& state, const Sums<D>& s, Lane m) const {
    const Particles<D>& p = sums.p;
    const Lane inv_h = 1.0 / state.h, per_volume = power<D>(inv_h);
    const Lane free = 1.0 - state.imposed, calibrated = calibration(me);
    me.store(p.rho, state.rho);
    me.store(p.h, state.h);
    me.store(p.inv_h, inv_h);
    // Rows push like real particles; other virtual masses enter through the energy of i, where they share in
    // alpha.
    const Lane alpha = sums.walls.rows ? state.alpha : state.alpha - state.own;
    me.store(p.pressure, 0.5 * options.gravity / (options.calibration.extent(0) > 0 ? Lane(1.0) : alpha));
    me.store(p.celerity, root(options.gravity * state.rho));
    me.store(p.weight, m * per_volume * inv_h);
    const Lane closing = calibrated * (s.closing * per_volume * inv_h + s.wall.approach);
    const Lane rate = -free * closing / (state.alpha - state.own);
    me.store(p.growth, options.ahead > 0 ? rate + free * options.ahead * (rate - me.load(p.rate)) : rate);
    me.store(p.rate, rate);
    if (options.gradient) me.store(p.strain, symmetric_gradient(s.slope, s.spread, free));
  }
};

template <int D, class K>
struct Calibrate {
  SumDensity<D, K, false> sums;
  Field<double> calibration;

  KOKKOS_INLINE_FUNCTION void operator()(int c) const {
    const Lanes me = sums.clusters(c);
    const Lane rho = me.load(sums.p.rho);
    const Sums<D> s = sums.template sum<Want::density>(c, sums.here(me), rho, me.load(sums.p.h));
    me.store(calibration, clamp(rho / (s.density + s.wall.density), Lane(0.5), Lane(2.0)));
  }
};

}  // namespace

template <int D>
DensityReport solve_density(const AnyKernel<D>& kernel, const ClusterSet& clusters, const NeighbourView& near,
                            const WallView<D>& walls, const Particles<D>& p, const ImposedLanes& imposed,
                            const DensityOptions& options) {
  DensityReport report;
  double evaluations = 0;
  const auto solve = [&](const auto& k, auto single) {
    using Solve = SolveDensity<D, std::decay_t<decltype(k)>, decltype(single)::value>;
    Kokkos::parallel_reduce(
        "swe::density", balanced(clusters.size()), Solve{{k, clusters, near, walls, p}, imposed, options},
        evaluations, Kokkos::Max<int>(report.newton_max), report.outgrown, report.capped, report.floored);
  };
  std::visit([&](const auto& k) { p.single.on() ? solve(k, std::true_type{}) : solve(k, std::false_type{}); },
             kernel);
  report.newton_mean = clusters.size() > 0 ? evaluations / clusters.size() : 0;
  return report;
}

template <int D>
void calibrate_density(const AnyKernel<D>& kernel, const ClusterSet& clusters, const NeighbourView& near,
                       const WallView<D>& walls, const Particles<D>& p, const Field<double>& calibration) {
  std::visit(
      [&](const auto& k) {
        using K = std::decay_t<decltype(k)>;
        launch("swe::calibrate", Range(0, clusters.size()),
               Calibrate<D, K>{{k, clusters, near, walls, p}, calibration});
      },
      kernel);
}

#define FRESHET_INSTANTIATE(D)                                                                          \
  template DensityReport solve_density<D>(const AnyKernel<D>&, const ClusterSet&, const NeighbourView&, \
                                          const WallView<D>&, const Particles<D>&, const ImposedLanes&, \
                                          const DensityOptions&);                                       \
  template void calibrate_density<D>(const AnyKernel<D>&, const ClusterSet&, const NeighbourView&,      \
                                     const WallView<D>&, const Particles<D>&, const Field<double>&);
FRESHET_INSTANTIATE(1)
FRESHET_INSTANTIATE(2)
#undef FRESHET_INSTANTIATE

}  // namespace freshet::swe
