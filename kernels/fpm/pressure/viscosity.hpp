// Viscosity taken implicitly (docs/formulas/fpm.md (F22)): (1 - k lap) v* = b with k = nu tau [m2], both
// components at once, so that nu does not limit the step.
//   fluid                v_i - k sum_j l_ij (v_j - v_i) = b_i with the stencils' Laplacian, divided by 1 + k
//   sum_j l_ij free surface         the fitted polynomial obeys the equation and n . grad v = 0, each with
//   weight 100 (elliptic.hpp); n: into the water walls that slip      the same along the wall; n . v* = n . b
//   walls that hold      the velocity along the wall is 0, in the first step b's; n . v* = n . b
// The normal part on walls is free to choose: the pressure's condition there, n . grad phi = rho n . v* /
// tau, takes it off again. In the first step, before any pressure is known, v* falls along walls too, or they
// would brake it and still water would not stay still. Solved by BiCGStab; the rows have ones on the diagonal
// (Jacobi).
#pragma once
#include "kernels/fpm/stencils/stencils.hpp"
#include "kernels/fpm/tank.hpp"
#include "kernels/linear/bicgstab.hpp"
#include "kernels/linear/cluster_matrix.hpp"

namespace freshet::fpm {

struct ViscousPlaces {
  Field<int> kind, surface;    // PointKind; 1 on the free surface
  VecField<double, 2> normal;  // of walls, 0 elsewhere
  bool slip = true;
  bool first_step = false;
};

class ImplicitViscosity {
 public:
  // v holds b and then v*. start: the first guess.
  linear::BiCgStabReport solve(const StencilView<2>& stencils, const ViscousPlaces& places, double k,
                               const VecField<double, 2>& v, const VecField<double, 2>& start);

 public:
  void assemble(const StencilView<2>& stencils, double k);
  void set_right_side(const VecField<double, 2>& v, const VecField<double, 2>& start);
  void multiply(const Field<double>& x, const Field<double>& y) const;

 private:
  ViscousPlaces places_;
  linear::ClusterMatrix matrix_;
  linear::BiCgStab krylov_;
  Field<double> per_b_, b_, x_;  // b_ and x_: all of the x components, then all of the y
};

}  // namespace freshet::fpm
