// A preconditioner for Laplacians on scattered points of about even spacing whose rows are 1 on the diagonal and averages beside it:
// what varies over a spacing or two is left as it is (there A is near the identity), the rest is found on a mesh of two spacings:
//   z = r + P B P^T (w r),   P: bilinear from the mesh's nodes,   B: one cycle of BoxMultigrid on
//   -sum_i a_i (lumped grad N . grad N) + P^T (w d),   w_i = a_i / s_i
// where row i is about -s_i lap and d_i is the part of its entries that lies on given points (mass by which nodes near them are held).
// Cells are four spacings / 2 of a row of cellgrid's order, so that a cell's points follow each other. A periodic axis closes with a
// cell as wide as is left. Where constants are free the mesh sees r without its weighted mean. All passes are by rows of cells or blocks of points: results do not depend on the number of threads.
#pragma once
#include "cellgrid/clusters.hpp"
#include "cellgrid/near.hpp"
#include "kernels/linear/box_multigrid.hpp"

namespace freshet::linear {

// The cells of the mesh: column i, row j; nodes are their corners.
struct MeshCells {
  int columns = 0, rows = 0;
  double x0 = 0, y0 = 0, width = 1, height = 1;   // m
  double last_width = 1, last_height = 1;         // m, of the last column and row: not the same where the domain is periodic

  KOKKOS_FORCEINLINE_FUNCTION int size() const { return columns * rows; }
  KOKKOS_FORCEINLINE_FUNCTION double width_of(int i) const { return i + 1 == columns ? last_width : width; }
  KOKKOS_FORCEINLINE_FUNCTION double height_of(int j) const { return j + 1 == rows ? last_height : height; }
};

// Of each point: a [m2], w [1], d; w = 0: its value is given. singular: constants are in the matrix' null space.
struct MeshWeights {
  Field<double> area, weight, held;
  bool singular = false;
};

class PointMesh {
 public:
  // Whether a mesh suits the points: at most `most` cells for one of them.
  static bool suits(const Rows& rows, int points, double most = 6) {
    return static_cast<double>(rows.rows) * rows.bins / bins_per_cell(rows) < most * points + 1000;
  }
  // Lays the mesh over sorted points and finds its system.
  void build(const Rows& rows, const VecField<double, 2>& x, int points, const Period& period, const MeshWeights& weights);
  // z := as above.
  void operator()(const Vector& r, const Vector& z);

  double sum_of_weights();  // device lambdas may not live in private members

 private:
  static int bins_per_cell(const Rows& rows);
  void lay(const Rows& rows, const Period& period);
  double mean(const Vector& r);

  MeshCells cells_;
  BoxMultigrid multigrid_;
  Field<int> first_;                // point of each cell
  Field<int> node_;                 // south-west of each point
  Field<double> fx_, fy_, weight_;  // where in its cell, 0 to 1; w
  Vector south_, north_;            // what a row of cells gives to the nodes below and above it
  double total_weight_ = 0;         // where constants are free, else 0
  int points_ = 0;
  OrderedSums sums_;
};

}  // namespace freshet::linear
