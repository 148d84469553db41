#include "kernels/swe/density.hpp"

#include "cellgrid/balanced.hpp"
#include "kernels/swe/least_squares.hpp"

namespace freshet::swe {
namespace {

constexpr int most_turns = 60;  // each changes rho by at most 2: enough to cross any range

// sum_j m_j F (v_j - v_i) (x) (x_j - x_i), and its trace.
template <class V, int D>
struct Gradient;
template <class V>
struct Gradient<V, 1> {
  V xx{0.0};
  KOKKOS_FORCEINLINE_FUNCTION Gradient& operator+=(const Gradient& b) { return xx += b.xx, *this; }
  KOKKOS_FORCEINLINE_FUNCTION void add(const Vec<V, 1>& fd, const Vec<V, 1>& dv) { xx += fd.x * dv.x; }
  KOKKOS_FORCEINLINE_FUNCTION V divergence() const { return xx; }
};
template <class V>
struct Gradient<V, 2> {
  V ux{0.0}, uy{0.0}, vx{0.0}, vy{0.0};
  KOKKOS_FORCEINLINE_FUNCTION Gradient& operator+=(const Gradient& b) {
    return ux += b.ux, uy += b.uy, vx += b.vx, vy += b.vy, *this;
  }
  KOKKOS_FORCEINLINE_FUNCTION void add(const Vec<V, 2>& fd, const Vec<V, 2>& dv) {
    ux += fd.x * dv.x;
    uy += fd.y * dv.x;
    vx += fd.x * dv.y;
    vy += fd.y * dv.y;
  }
  KOKKOS_FORCEINLINE_FUNCTION V divergence() const { return ux + vy; }
};

// Symmetric part of the L-normalised gradient B A^-1.
KOKKOS_FORCEINLINE_FUNCTION Sym<Lane, 1> symmetric_gradient(const Gradient<Lane, 1>& b, const Sym<Lane, 1>& a, Lane) {
  return {b.xx * usable_inverse(a).xx};
}
KOKKOS_FORCEINLINE_FUNCTION Sym<Lane, 2> symmetric_gradient(const Gradient<Lane, 2>& b, const Sym<Lane, 2>& a, Lane shear) {
  const Sym<Lane, 2> l = usable_inverse(a);
  return {b.ux * l.xx + b.uy * l.xy, 0.5 * shear * (b.ux * l.xy + b.uy * l.yy + b.vx * l.xx + b.vy * l.xy), b.vx * l.xy + b.vy * l.yy};
}

// What a walk over the neighbours is for: density and its derivative by h; also d rho/dt; also grad v.
enum class Want { density, rate, gradient };

template <int D>
struct PairSums {
  Lane density{0.0};        // sum m W
  Lane moment{0.0};         // sum m F r^2, F = -W'/r
  Lane closing{0.0};        // sum m F v_ji . x_ji
  Sym<Lane, D> spread;      // sum m F x_ji (x) x_ji: its trace is the moment
  Gradient<Lane, D> slope;  // sum m F v_ji (x) x_ji: its divergence is the closing

  // Number by number: a sum that is copied as a whole stays in memory while it is summed (g++ 12).
  KOKKOS_FORCEINLINE_FUNCTION PairSums& operator+=(const PairSums& b) {
    return density += b.density, moment += b.moment, closing += b.closing, spread += b.spread, slope += b.slope, *this;
  }
};

template <int D>
struct Sums : PairSums<D> {
  WallSums<Lane, D> wall;
};

// One pair, all from one 1/r.
template <Want want, class K, int D>
KOKKOS_FORCEINLINE_FUNCTION void add_pair(const K& kernel, const Vec<Lane, D>& x_ji, const Vec<Lane, D>& v_ji, Lane m, Lane inv_h,
                                          PairSums<D>& sum) {
  const Lane r2 = dot(x_ji, x_ji) + tiny_square;
  const Lane inv_r = rsqrt(r2), r = r2 * inv_r;
  const auto k = kernel.at(r * inv_h);
  const Lane m_dw = -m * k.dw;
  sum.density += m * k.w;
  if constexpr (want == Want::gradient) {
    const Vec<Lane, D> f_x = (m_dw * inv_r) * x_ji;
    add_square(sum.spread, f_x, x_ji);
    sum.slope.add(f_x, v_ji);
  } else {
    sum.moment += m_dw * r;
    if constexpr (want == Want::rate) sum.closing += m_dw * inv_r * dot(v_ji, x_ji);
  }
}

// What a cluster's particles bring to their sums.
template <int D>
struct Here {
  Vec<Lane, D> x, v;
  Lane m, h0;
};

template <int D, class K>
struct SumDensity {
  K kernel;
  ClusterSet clusters;
  NeighbourView near;
  WallView<D> walls;
  Particles<D> p;

  KOKKOS_INLINE_FUNCTION Here<D> here(const Lanes& me) const {
    return {me.load(p.x), me.load(p.v_pred), me.load(p.m), me.load(p.h0)};
  }

  template <Want want>
  KOKKOS_INLINE_FUNCTION Sums<D> sum(int c, const Here<D>& i, Lane rho, Lane h) const {
    const Lane inv_h = 1.0 / h;
    const PairSums<D> pairs = walk<want>(c, i.x, i.v, inv_h, [](int) { return true; });
    Sums<D> s;
    s += pairs;
    if constexpr (want == Want::gradient) s.moment = trace(s.spread), s.closing = s.slope.divergence();
    const Lane per_volume = power<D>(inv_h);
    s.density *= per_volume;
    if (walls.on && walls.mirror)
      add_images(c, i, inv_h, s.wall);
    else if (walls.on)
      add_walls(c, i, walls.virtual_mass(i.m, i.h0 * inv_h, rho), inv_h, s.wall);
    return s;
  }

  // The sums over the neighbours that count, as seen from x moving at v. A local result, its arguments by value: sums whose
  // address is known elsewhere would be written to memory at every pair.
  template <Want want, class Counts>
  KOKKOS_FORCEINLINE_FUNCTION PairSums<D> walk(int c, const Vec<Lane, D> x, const Vec<Lane, D> v, const Lane inv_h,
                                               const Counts& counts) const {
    PairSums<D> s;
    near.for_each(c, [&](int j) {
      if (!counts(j)) return;
      Vec<Lane, D> v_ji;
      if constexpr (want != Want::density) v_ji = broadcast(at(p.v_pred, j)) - v;
      add_pair<want>(kernel, broadcast(at(p.x, j)) - x, v_ji, Lane(p.m(j)), inv_h, s);
    });
    return s;
  }

  // Whether the sums depend on the particle's own depth beside its h: through virtual particles that follow it.
  KOKKOS_INLINE_FUNCTION bool follow_depth(int c) const { return walls.on && !walls.mirror && walls.near.length(c) > 0; }

  // What the neighbours' images add: the cluster's own image sees the neighbours.
  KOKKOS_INLINE_FUNCTION void add_images(int c, const Here<D>& i, Lane inv_h, WallSums<Lane, D>& wall) const {
    const Lane per_volume = power<D>(inv_h);
    walls.for_each_image(c, i.x, [&](const Image<D>& image, Lane weight, const WallSegment& segment) {
      const Vec<Lane, D> x_image = image(i.x);
      const double limit = kernel.support / smallest(inv_h) + walls.foremost(segment, x_image);
      if (limit <= 0) return;
      const PairSums<D> s = walk<Want::rate>(c, x_image, image.turn(i.v), inv_h,
                                             [&](int j) { return walls.mirrors(segment, at(p.x, j), limit); });
      wall.density += weight * per_volume * s.density;
      wall.moment += weight * per_volume * inv_h * s.moment;
      wall.approach += weight * per_volume * inv_h * s.closing;
    });
  }

  KOKKOS_INLINE_FUNCTION void add_walls(int c, const Here<D>& i, Lane mass, Lane inv_h, WallSums<Lane, D>& s) const {
    walls.near.for_each(c, [&](int k) {
      const Vec<Lane, D> normal_velocity = broadcast(walls.projector, k) * i.v;
      add_wall(kernel, walls.stretch, i.x - broadcast(at(walls.x, k)), normal_velocity, inv_h, mass * walls.share(k), s);
    });
  }
};

template <int D, class K>
struct SolveDensity {
  SumDensity<D, K> sums;
  ImposedLanes imposed_lanes;
  DensityOptions options;

  struct State {
    Lane rho, h, alpha, imposed, own;  // own: part of the density that the particle's own depth makes (behind walls)
  };

  KOKKOS_INLINE_FUNCTION Lane calibration(const Lanes& me) const {
    return options.calibration.extent(0) > 0 ? me.load(options.calibration) : Lane(1.0);
  }

  // A residual whose square is within the tolerance, with room: the step that follows it squares the error, be it Newton's or,
  // at a bound, exact. Not where that step crosses a bound.
  KOKKOS_INLINE_FUNCTION double before_last_step() const { return larger(options.tolerance, 0.5 * root(options.tolerance)); }

  // Newton on psi = rho - sum m W(h(rho)) (2.8)-(2.10), its factor held within [1/2, 2]. Where h is at a bound it does not
  // follow rho: alpha = 1 and the root is the sum itself. "Bounded" is decided here, once, by the last evaluation.
  KOKKOS_INLINE_FUNCTION void operator()(int c, double& evaluations, int& most, int& outgrown, int& capped, int& floored) const {
    const Particles<D>& p = sums.p;
    const Lanes me = sums.clusters(c);
    const Here<D> i = sums.here(me);
    const Lane kh = me.load(p.kh), listed = me.load(p.h), calibrated = calibration(me);
    const Lane low = options.bounds.floor * i.h0, high = options.bounds.cap * i.h0;
    const Lane imposed = imposed_lanes(me), free = 1.0 - imposed;
    const Lane longest_listed = (1.0 + options.margin) * listed;
    Lane rho = me.load(p.rho), h = clamp(smoothing_length<D>(kh, rho), low, smaller(high, longest_listed));
    const Lane imposed_rho = rho;
    Sums<D> s = options.gradient ? sums.template sum<Want::gradient>(c, i, rho, h) : sums.template sum<Want::rate>(c, i, rho, h);
    const Sums<D> first = s;  // the gradient and the rate need no more than the predicted h
    Lane alpha, bounded, own;
    int n = 1;
    for (int turn = 1;; ++turn) {
      const Lane total = calibrated * (s.density + s.wall.density);
      const Lane moment = calibrated * (s.moment * power<D>(1.0 / h) / h + s.wall.moment);
      const Lane wanted = smoothing_length<D>(kh, rho);
      bounded = select((low < wanted) & (wanted < high), Lane(0.0), Lane(1.0));
      alpha = moment / (rho * double(D));
      own = sums.walls.follows_depth() * calibrated * s.wall.density / rho;
      const Lane slope = rho - total + rho * (alpha - own);
      // Held by the list like by a bound: then it ends as outgrown, and the list is made again.
      const Lane held = select(smaller(high, longest_listed) < wanted, Lane(1.0), bounded);
      const Lane newton = select(Lane(0.0) < slope, rho * (alpha - own) / larger(slope, Lane(1e-300)), Lane(2.0));
      const Lane sum_itself = (total / rho - own) / larger(1.0 - own, Lane(0.1));
      const Lane factor = select(Lane(0.5) < held, sum_itself, newton);
      const Lane residual = free * larger(rho - total, total - rho) / rho;
      rho = select(Lane(0.5) < imposed, imposed_rho, rho * clamp(factor, Lane(0.5), Lane(2.0)));
      const Lane found = smoothing_length<D>(kh, rho);
      const Lane bounded_then = select((low < found) & (found < high), Lane(0.0), Lane(1.0));
      const Lane enough = select(Lane(0.25) < size_of(bounded_then - bounded), Lane(options.tolerance), Lane(before_last_step()));
      if (!any(enough < residual) || turn == most_turns) break;
      const Lane next = clamp(smoothing_length<D>(kh, rho), low, smaller(high, longest_listed));
      if (!any((next < h) | (h < next)) && !sums.follow_depth(c)) continue;  // a fixed h: the sums are known
      h = next;
      s = sums.template sum<Want::density>(c, i, rho, h);
      ++n;
    }
    const Lane wanted = clamp(smoothing_length<D>(kh, rho), low, high);
    h = select(Lane(0.5) < imposed, smoothing_length<D>(kh, rho), wanted);
    alpha = select(Lane(0.5) < imposed, Lane(options.imposed_alpha), select(Lane(0.5) < bounded, Lane(1.0), alpha));
    write(me, {rho, h, alpha, imposed, own}, first, i.m);
    evaluations += n;
    most = larger(most, n);
    const auto active = first_lanes(me.count);
    const auto at_bound = active & (Lane(0.5) < bounded) & (imposed < Lane(0.5));
    outgrown += count(active & (longest_listed < h));
    capped += count(at_bound & (i.h0 < h));
    floored += count(at_bound & (h < i.h0));
  }

  KOKKOS_INLINE_FUNCTION void write(const Lanes& me, const State& state, const Sums<D>& s, Lane m) const {
    const Particles<D>& p = sums.p;
    const Lane inv_h = 1.0 / state.h, per_volume = power<D>(inv_h);
    const Lane free = 1.0 - state.imposed, calibrated = calibration(me);
    me.store(p.rho, state.rho);
    me.store(p.h, state.h);
    me.store(p.inv_h, inv_h);
    // Rows push like real particles; other virtual masses enter through the energy of i, where they share in alpha.
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
  SumDensity<D, K> sums;
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
  std::visit(
      [&](const auto& k) {
        using K = std::decay_t<decltype(k)>;
        Kokkos::parallel_reduce("swe::density", balanced(clusters.size()),
                                SolveDensity<D, K>{{k, clusters, near, walls, p}, imposed, options}, evaluations,
                                Kokkos::Max<int>(report.newton_max), report.outgrown, report.capped, report.floored);
      },
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
        Kokkos::parallel_for("swe::calibrate", Range(0, clusters.size()),
                             Calibrate<D, K>{{k, clusters, near, walls, p}, calibration});
      },
      kernel);
}

#define FRESHET_INSTANTIATE(D)                                                                                                  \
  template DensityReport solve_density<D>(const AnyKernel<D>&, const ClusterSet&, const NeighbourView&, const WallView<D>&,     \
                                          const Particles<D>&, const ImposedLanes&, const DensityOptions&);                     \
  template void calibrate_density<D>(const AnyKernel<D>&, const ClusterSet&, const NeighbourView&, const WallView<D>&,          \
                                     const Particles<D>&, const Field<double>&);
FRESHET_INSTANTIATE(1)
FRESHET_INSTANTIATE(2)
#undef FRESHET_INSTANTIATE

}  // namespace freshet::swe
