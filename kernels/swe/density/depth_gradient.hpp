// grad rho by least squares over the neighbours, for stabilisations that reconstruct the depth:
// docs/formulas/swe.md (S14).
#pragma once
#include "kernels/swe/particles.hpp"

namespace freshet::swe {

// sum m_j F (rho_j - rho_i) x_ji normalised so that it is exact for linear fields; zero where the neighbours
// do not span the plane. Reads x, m, rho, inv_h; writes depth_slope [1].
template <int D>
void find_depth_gradient(const AnyKernel<D>& kernel, const ClusterSet& clusters, const NeighbourView& near,
                         const Particles<D>& p);

}  // namespace freshet::swe
