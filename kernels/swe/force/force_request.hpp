// What internal_force() hands to its pair loops, which are compiled once per dimension and precision, side by
// side.
#pragma once
#include "kernels/swe/force/internal_force.hpp"

namespace freshet::swe {

template <int D>
struct ForceRequest {
  const AnyKernel<D>& kernel;
  const ClusterSet& clusters;
  const NeighbourView& near;
  const WallView<D>& walls;
  const Particles<D>& p;
  const AnyStabilisation& stabilisation;
};

template <int D, bool single>
void sum_force(const ForceRequest<D>& request);

}  // namespace freshet::swe
