// Well-balanced bed force: the bed slope taken with the same particle sums as the depth gradient, so that
// still water over any bed (wet everywhere, on a lattice, behind mirror walls) stays at rest to round-off.
//   pressure   t_i = sum_j m_j (g/2) [G_ij(h_i) + G_ij(h_j)]                  (2.22) with alpha = 1
//   bed        t_i += sum_j (m_j/rho_j) (b_j - b_i) (g/2) [G_ij(h_i) + G_ij(h_j)]
// At rest rho_j + b_j is one level z, and both together are (z - b_i) sum_j V_j G_ij, which vanishes by
// symmetry where h and V are the same everywhere. That they are is the work of the calibration: the sum of
// each particle is scaled so that it gives the exact depth at the start (density.hpp).
#pragma once
#include "kernels/boundaries/walls/walls.hpp"
#include "kernels/swe/motion.hpp"

namespace freshet::swe {

// Reads x, m, rho, inv_h, weight; samples bed.level [m] at x; adds to t.
template <int D>
void add_balanced_bed(const AnyKernel<D>& kernel, const ClusterSet& clusters, const NeighbourView& near,
                      const WallView<D>& walls, const Particles<D>& p, const BedTerm<D>& bed, double gravity);

}  // namespace freshet::swe
