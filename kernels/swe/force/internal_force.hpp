// Pressure force of the variational SPH-SWE scheme with stabilisation, docs/formulas/swe.md (S15):
// t_i = sum_j m_j { [g/(2 alpha_i) + Pi/2] G_ij(h_i) + [g/(2 alpha_j) + Pi/2] G_ij(h_j) }, G = W' x_ij / r,
// rho_w = 1.
#pragma once
#include "kernels/boundaries/walls/walls.hpp"
#include "kernels/swe/force/stabilisation.hpp"
#include "kernels/swe/particles.hpp"

namespace freshet::swe {

// 2-D, cubic spline, no walls.
inline Cost internal_force_cost(const AnyStabilisation& stabilisation) {
  return std::visit(
      [](const auto& s) {
        return Cost{61 + s.flops, 8, s.velocity_gradient ? 16.0 : 13.0};
      },
      stabilisation);
}

// Reads x, v_pred, m, h0, rho, h, inv_h, pressure, celerity, weight and, where the stabilisation
// reconstructs, strain and depth_slope; writes t and signal.
template <int D>
void internal_force(const AnyKernel<D>& kernel, const ClusterSet& clusters, const NeighbourView& near,
                    const WallView<D>& walls, const Particles<D>& p, const AnyStabilisation& stabilisation);

}  // namespace freshet::swe
