// Bed friction, implicit (docs/formulas/sisph.md (I25)): gamma_i = g n^2 |v_i| / H_i^(4/3) [1/s] of the state
// at the start of the step; velocities are divided by 1 + dt gamma_i, the matrix by 1 + dt (gamma_i +
// gamma_j) / 2 and the theta part of the fluxes' velocities by 1 + dt gamma_i. The matrix stays symmetric and
// positive; where the water gets thin gamma grows and nothing moves. n [s/m^(1/3)] by place: fixed, since
// particles are at rest.
#pragma once
#include "kernels/sisph/surface/surface.hpp"

namespace freshet::sisph {

// drag: dt gamma per particle; g_n2: g n^2.
template <int D>
void find_drag(int particles, const Layer<D>& water, const Field<double>& g_n2, double dt,
               const Field<double>& drag);

}  // namespace freshet::sisph
