// Gradients over the stored pairs, exact for linear fields (docs/formulas/sisph.md (I4), (I24)).
#pragma once
#include "kernels/sisph/surface/surface.hpp"

namespace freshet::sisph {

// grad eta, eta = bed + max(0, depth). drying: where a pair of the particle stands at a front (no water above
// the higher bed), its pairs are weighted with that water, and S_w + 0.1 tr(S_w) 1 is taken where S_w is
// nearly singular; dry pairs count nothing. Everywhere one rule passes into the other continuously, so that
// shores do not follow rounding.
template <int D>
void surface_gradient(const Geometry<D>& g, const SliceList& active, const Field<double>& depth,
                      const Field<double>& bed, const VecField<double, D>& gradient, bool drying);

// The velocity gradient, row by row: of u, then (2-D) of v. Zero where the particle or a neighbour is dry or
// one has less than a tenth of the other's depth, whole from three tenths on: slopes in thin films would
// throw water about.
template <int D>
struct VelocityGradient {
  VecField<double, D> u, v;  // 1/s; 1-D: u alone
};
template <int D>
void velocity_gradient(const Geometry<D>& g, const SliceList& active, const Layer<D>& water,
                       const VelocityGradient<D>& gradient);

}  // namespace freshet::sisph
