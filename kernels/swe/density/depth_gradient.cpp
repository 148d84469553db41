#include "kernels/swe/density/depth_gradient.hpp"

#include "cellgrid/parallel/launch.hpp"
#include "kernels/swe/density/least_squares.hpp"

namespace freshet::swe {
namespace {

template <int D, class K>
struct DepthGradient {
  K kernel;
  ClusterSet clusters;
  NeighbourView near;
  Particles<D> p;

  KOKKOS_INLINE_FUNCTION void operator()(int c) const {
    const Lanes me = clusters(c);
    const Vec<Lane, D> x = me.load(p.x);
    const Lane rho = me.load(p.rho), inv_h = me.load(p.inv_h);
    Vec<Lane, D> slope;
    Sym<Lane, D> spread;
    near.for_each(c, [&](int j) {
      const Vec<Lane, D> x_ji = broadcast(at(p.x, j)) - x;
      const Lane r2 = dot(x_ji, x_ji) + tiny_square, inv_r = rsqrt(r2);
      const Vec<Lane, D> f_x = (-p.m(j) * kernel.slope(r2 * inv_r * inv_h) * inv_r) * x_ji;
      add_square(spread, f_x, x_ji);
      slope += (Lane(p.rho(j)) - rho) * f_x;
    });
    me.store(p.depth_slope, usable_inverse(spread) * slope);
  }
};

}  // namespace

template <int D>
void find_depth_gradient(const AnyKernel<D>& kernel, const ClusterSet& clusters, const NeighbourView& near,
                         const Particles<D>& p) {
  std::visit(
      [&](const auto& k) {
        launch("swe::depth_gradient", Range(0, clusters.size()),
               DepthGradient<D, std::decay_t<decltype(k)>>{k, clusters, near, p});
      },
      kernel);
}

template void find_depth_gradient<1>(const AnyKernel<1>&, const ClusterSet&, const NeighbourView&,
                                     const Particles<1>&);
template void find_depth_gradient<2>(const AnyKernel<2>&, const ClusterSet&, const NeighbourView&,
                                     const Particles<2>&);

}  // namespace freshet::swe
