// The closure of the pair areas (docs/formulas/sisph.md (I6)): the smallest weighted change that gives every
// free particle sum_j A_ij n_ij = 0,
//   A_ij <- A_ij (1 - (lambda_j - lambda_i) . n_ij),
//   sum_j A_ij n_ij n_ij . (lambda_i - lambda_j) = -sum_j A_ij n_ij          (a spring network; lambda = 0 at
//   held particles)
// A stays symmetric. On a lattice nothing changes. Without it a mean flow over disordered particles has an
// O(1) error.
#pragma once
#include "kernels/sisph/pairs/geometry.hpp"

namespace freshet::sisph {

struct ClosureReport {
  int iterations = 0;
  double change = 0;     // largest |A_new / A - 1|
  double unclosed = 0;   // largest |sum_j A_ij n_ij| / sum_j A_ij after it
  int negative = 0;      // areas below zero
  Field<double> lambda;  // the components one after another, images.slots() values each; empty where nothing
                         // was to be closed
};

// Changes g.area. Allocates; not for use inside a step.
template <int D>
ClosureReport close_areas(const Geometry<D>& g);

}  // namespace freshet::sisph
