#include "kernels/swe/force/well_balanced.hpp"

#include "cellgrid/parallel/launch.hpp"

namespace freshet::swe {
namespace {

// Of the bed's push: what the neighbours give, and how much of a straight slope they see.
template <int D>
struct BedPush {
  Vec<Lane, D> t;
  Lane seen{0.0};
};

template <int D, class K>
struct BalancedBed {
  K kernel;
  ClusterSet clusters;
  NeighbourView near;
  WallView<D> walls;
  Particles<D> p;
  BedTerm<D> bed;
  double half_gravity;

  // sum over the neighbours that counts(j) as seen from x: the particle's own place, or its image's.
  template <class Counts>
  KOKKOS_INLINE_FUNCTION BedPush<D> sum(int c, const Vec<Lane, D>& x, Lane b, Lane inv_h,
                                        const Counts& counts) const {
    const Lane per_slope = power<D>(inv_h) * inv_h;
    BedPush<D> push;
    near.for_each(c, [&](int j) {
      if (!counts(j)) return;
      const Vec<Lane, D> x_ij = x - broadcast(at(p.x, j));
      const Lane r2 = dot(x_ij, x_ij) + tiny_square, inv_r = rsqrt(r2), r = r2 * inv_r;
      const Lane slopes =
          p.m(j) * per_slope * kernel.slope(r * inv_h) + p.weight(j) * kernel.slope(r * Lane(p.inv_h(j)));
      const Lane per_depth = slopes * (1.0 / p.rho(j));
      push.t += ((bed.level(j) - b) * half_gravity * per_depth * inv_r) * x_ij;
      push.seen += (-0.5 / D) * per_depth * r;
    });
    return push;
  }

  // At the water's edge, where neighbours are missing, the bed's own slope stands in for what they do not
  // show of it; none of it where they see 90 % or more, so that water wet everywhere stays balanced.
  KOKKOS_INLINE_FUNCTION Lane missing(Lane seen) const {
    const Lane lack = 1.0 - seen;
    return lack * clamp(10.0 * lack - 1.0, Lane(0.0), Lane(1.0));
  }

  KOKKOS_INLINE_FUNCTION void operator()(int c) const {
    const Lanes me = clusters(c);
    const Vec<Lane, D> x = me.load(p.x);
    const Lane b = me.load(bed.level), inv_h = me.load(p.inv_h);
    BedPush<D> push = sum(c, x, b, inv_h, [](int) { return true; });
    if (walls.on && walls.mirror)
      walls.for_each_image(c, x, [&](const Image<D>& image, Lane weight, const WallPiece& piece) {
        const BedPush<D> seen =
            sum(c, image(x), b, inv_h, [&](int j) { return walls.mirrors(piece, at(p.x, j), 1e300); });
        push.t += weight * image.turn_back(seen.t);
        push.seen += weight * seen.seen;
      });
    Vec<Lane, D> t = me.load(p.t) + push.t;
    const Lane lack = missing(push.seen);
    if (any(Lane(0.0) < lack)) t += (2.0 * half_gravity * lack) * bed.spline.at(x).slope;
    me.store(p.t, t);
  }
};

}  // namespace

template <int D>
void add_balanced_bed(const AnyKernel<D>& kernel, const ClusterSet& clusters, const NeighbourView& near,
                      const WallView<D>& walls, const Particles<D>& p, const BedTerm<D>& bed,
                      double gravity) {
  const BedTerm<D> ground = bed;
  const VecField<double, D> x = p.x;
  const ClusterSet sets = clusters;
  launch(
      "swe::bed_level", Range(0, clusters.size()), KOKKOS_LAMBDA(int c) {
        const Lanes me = sets(c);
        me.store(ground.level, ground.spline.at(me.load(x)).b);
      });
  std::visit(
      [&](const auto& k) {
        launch("swe::balanced_bed", Range(0, clusters.size()),
               BalancedBed<D, std::decay_t<decltype(k)>>{k, clusters, near, walls, p, bed, 0.5 * gravity});
      },
      kernel);
}

template void add_balanced_bed<1>(const AnyKernel<1>&, const ClusterSet&, const NeighbourView&,
                                  const WallView<1>&, const Particles<1>&, const BedTerm<1>&, double);
template void add_balanced_bed<2>(const AnyKernel<2>&, const ClusterSet&, const NeighbourView&,
                                  const WallView<2>&, const Particles<2>&, const BedTerm<2>&, double);

}  // namespace freshet::swe
