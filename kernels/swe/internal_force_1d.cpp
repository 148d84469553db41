#include "kernels/swe/internal_force_loop.hpp"

namespace freshet::swe {

template void internal_force<1>(const AnyKernel<1>&, const ClusterSet&, const NeighbourView&, const WallView<1>&,
                                const Particles<1>&, const AnyStabilisation&);

}  // namespace freshet::swe
