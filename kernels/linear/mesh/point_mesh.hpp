// A preconditioner for Laplacians on scattered points of about even spacing whose rows are 1 on the diagonal
// and averages beside it: what varies over a spacing or two is left as it is (there A is near the identity),
// the rest is found on a mesh of two spacings:
//   z = r + P B P^T (w r),   P, B: of mesh_correction.hpp with a_i and the mass w d,   w_i = a_i / s_i
// where row i is about -s_i lap and d_i is the part of its entries that lies on given points (mass by which
// nodes near them are held). Where constants are free the mesh sees r without its weighted mean.
#pragma once
#include "kernels/linear/mesh/mesh_correction.hpp"

namespace freshet::linear {

// Of each point: a [m2], w [1], d; w = 0: its value is given. singular: constants are in the matrix' null
// space.
struct MeshWeights {
  Field<double> area, weight, held;
  bool singular = false;
};

class PointMesh {
 public:
  // Lays the mesh over sorted points and finds its system.
  void build(const Rows& rows, const VecField<double, 2>& x, int points, const Period& period,
             const MeshWeights& weights);
  // z := as above.
  void operator()(const Vector& r, const Vector& z);

 private:
  double mean(const Vector& r);

  MeshCorrection<2> mesh_;
  Field<double> weight_;
  double total_weight_ = 0;  // where constants are free, else 0
  int points_ = 0;
};

}  // namespace freshet::linear
