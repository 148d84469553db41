#include "kernels/swe/force/force_request.hpp"

namespace freshet::swe {

template <int D>
void internal_force(const AnyKernel<D>& kernel, const ClusterSet& clusters, const NeighbourView& near,
                    const WallView<D>& walls, const Particles<D>& p, const AnyStabilisation& stabilisation) {
  const ForceRequest<D> request{kernel, clusters, near, walls, p, stabilisation};
  p.single.on() ? sum_force<D, true>(request) : sum_force<D, false>(request);
}

template void internal_force<1>(const AnyKernel<1>&, const ClusterSet&, const NeighbourView&,
                                const WallView<1>&, const Particles<1>&, const AnyStabilisation&);
template void internal_force<2>(const AnyKernel<2>&, const ClusterSet&, const NeighbourView&,
                                const WallView<2>&, const Particles<2>&, const AnyStabilisation&);

}  // namespace freshet::swe
