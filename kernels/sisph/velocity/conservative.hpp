// The pressure of the conservative momentum, for bores and dam breaks (docs/formulas/sisph.md (I26)): per
// unit mass of water m' = omega H'
//   (slope)_i = (1 / m'_i) sum_j (A_ij / 2) H_ij (eta_j - eta_i) n_ij,   H_ij = (H_i + H_j) / 2,
// with depth and surface of the same level theta, H = (1 - theta) H^n + theta H^{n+1}. Over a flat bed H_ij
// (eta_j - eta_i) = (H_j^2 - H_i^2) / 2, so with closed areas (sum_j A_ij n_ij = 0) the momentum given is
// pairwise antisymmetric: exact. Reads both depths and the bed; writes the slope, which takes the place of
// the gradient of the surface.
#pragma once
#include "kernels/sisph/pairs/geometry.hpp"

namespace freshet::sisph {

// The two levels in time that a slope is taken between.
struct DepthLevels {
  Field<double> now, next;  // m
  double theta;             // weight of the next
};

template <int D>
void conservative_slope(const Geometry<D>& g, const SliceList& active, const DepthLevels& depths,
                        const Field<double>& bed, const VecField<double, D>& slope);

}  // namespace freshet::sisph
