#include "kernels/swe/internal_force_loop.hpp"

namespace freshet::swe {

template void internal_force<2>(const AnyKernel<2>&, const ClusterSet&, const NeighbourView&, const WallView<2>&,
                                const Particles<2>&, const AnyStabilisation&);

}  // namespace freshet::swe
