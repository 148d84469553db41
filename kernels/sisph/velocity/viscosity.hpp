// Lateral viscosity (docs/formulas/sisph.md (I27)), implicit:
//   (m_i (1 + dt gamma_i) + dt sum_j c_ij) d_i - dt sum_j c_ij d_j = dt sum_j c_ij (u_j - u_i),   c_ij = nu
//   A_ij H_ij / d_ij, m = omega H
// u: where pressure and friction alone would take the velocities, so that what they balance stays to
// round-off; d: what viscosity changes it by. Symmetric and positive: any step; by CG with Jacobi. The pairs
// give momentum to each other alone. An image behind a wall that slips has the velocity R u_j; behind one
// that holds the water -u_j (docs/formulas/sisph.md (I7)). Mass fluxes have R u_j in either case: nothing
// passes.
#pragma once
#include "kernels/linear/cg.hpp"
#include "kernels/sisph/surface/surface.hpp"

namespace freshet::sisph {

struct ViscosityOptions {
  double viscosity;  // m2/s
  bool slip;         // walls
  double tolerance;  // of CG, relative to the right side
  int most;          // iterations
};

template <int D>
class Viscosity {
 public:
  Viscosity(const Geometry<D>& g, const ViscosityOptions& options);

  // d [m/s] for u = predicted, whose images are written; drag: dt gamma, or empty. Held particles have none.
  // Returns CG's iterations.
  int find(const Layer<D>& water, const Field<double>& drag, const VecField<double, D>& predicted, double dt);
  // to += (1 + dt gamma) d
  void add(const Field<double>& drag, const VecField<double, D>& to) const;

 private:
  Geometry<D> g_;
  ViscosityOptions options_;
  int stride_;  // of the components, one after another
  linear::ConjugateGradients cg_;
  Field<double> pull_, mass_;               // dt c_ij per pair; m_i (1 + dt gamma_i), m^D x m
  Field<double> right_, inverse_, change_;  // stride_ values per component
};

}  // namespace freshet::sisph
