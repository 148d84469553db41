// Refinement: the smoothing length follows the mass of the particles around.
#include "cellgrid/parallel/launch.hpp"
#include "kernels/swe/split/refinement.hpp"

namespace freshet::swe {
namespace {

template <int D>
struct Relax {
  ClusterSet clusters;
  NeighbourView near;
  Particles<D> p;
  ImposedLanes imposed;
  double gravity, per_mass, time, longest, dt;

  // The largest of m_j (1 - (r / 2 h_j)^2): from coarse to fine within 2 h of the last heavy one. It does not
  // tell apart masses that differ by a tenth: at a neighbour's distance, 0.8 h, a mass counts 0.84.
  KOKKOS_INLINE_FUNCTION Lane heaviest_near(int c, const Vec<Lane, D>& x, Lane m) const {
    near.for_each(c, [&](int j) {
      const Vec<Lane, D> d = x - broadcast(at(p.x, j));
      const double reach = Kernel<D>::support * p.h(j);
      m = larger(m, p.m(j) - p.m(j) / (reach * reach) * dot(d, d));
    });
    return m;
  }

  KOKKOS_INLINE_FUNCTION void operator()(int c) const {
    const Lanes me = clusters(c);
    const Lane heaviest = heaviest_near(c, me.load(p.x), me.load(p.m)), fixed = imposed(me);
    for (int l = 0; l < me.count; ++l) {
      const int i = me.particle(l);
      const double excess = p.kh(i) / (per_mass * lane_of(heaviest, l));
      if (lane_of(fixed, l) > 0.5 || ::fabs(excess - 1) < 1e-12) continue;
      const double left = time > 0 ? ::exp(-dt * root(gravity * p.rho(i)) / (time * p.h(i))) : 0.0;
      const double factor = ::pow(excess, left - 1);
      p.kh(i) *= factor;
      p.h0(i) = smaller(p.h0(i) * (D == 1 ? factor : root(factor)), larger(p.h0(i), longest));
    }
  }
};

}  // namespace

template <int D>
void Refinement<D>::relax(const ClusterSet& clusters, const NeighbourView& near, const Particles<D>& p,
                          const Field<int>& kind, double dt) const {
  launch(
      "refine::relax", Range(0, clusters.size()),
      Relax<D>{
          clusters, near, p, {kind}, relax_.gravity, power<D>(relax_.eta), relax_.time, relax_.longest, dt});
}

template void Refinement<1>::relax(const ClusterSet&, const NeighbourView&, const Particles<1>&,
                                   const Field<int>&, double) const;
template void Refinement<2>::relax(const ClusterSet&, const NeighbourView&, const Particles<2>&,
                                   const Field<int>&, double) const;

}  // namespace freshet::swe
