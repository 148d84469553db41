// What two preconditioners (particle_mesh.hpp, point_mesh.hpp) share: values of sorted points to a mesh of
// two spacings and back,
//   c = B P^T v,   P: bilinear from the mesh's nodes to the points,
//   B: one cycle of BoxMultigrid on P^T m + sum_i a_i (lumped grad N . grad N)
// Cells are a row of cellgrid's order, in 1-D the line, times as many bins as make them square, so that a
// cell's points follow each other. A periodic axis closes with a cell as wide as is left. All passes are by
// rows of cells or blocks of points, without atomics: results do not depend on the number of threads.
// Templates are defined in mesh_passes.hpp, for the files that use them.
#pragma once
#include "cellgrid/particles/near.hpp"
#include "kernels/linear/mesh/box_multigrid.hpp"

namespace freshet::linear {

// The cells of the mesh: column i, row j; nodes are their corners.
struct MeshCells {
  int columns = 0, rows = 0;
  double x0 = 0, y0 = 0, width = 1, height = 1;  // m
  double last_width = 1,
         last_height = 1;  // m, of the last column and row: not the same where the domain is periodic

  KOKKOS_FORCEINLINE_FUNCTION int size() const { return columns * rows; }
  KOKKOS_FORCEINLINE_FUNCTION double width_of(int i) const { return i + 1 == columns ? last_width : width; }
  KOKKOS_FORCEINLINE_FUNCTION double height_of(int j) const { return j + 1 == rows ? last_height : height; }
};

template <int D>
class MeshCorrection {
 public:
  static int bins_per_cell(const Rows& rows);
  // Whether a mesh suits the points that rows say: at most `most` cells for one of them, and a thousand.
  static bool suits(const Rows& rows, int points, double most);

  // Lays the mesh over points, sorted as rows say. Allocates where the mesh or the points grow.
  void lay(const Rows& rows, const VecField<double, D>& x, int points, const Period& period);
  // The system: m_i and a_i [m2, times the conductivity] as functions of the point, once laid.
  template <class Mass, class Area>
  void set(const Mass& mass, const Area& area);
  // c := B P^T v, v a function of the point.
  template <class Value>
  void solve(const Value& value);
  // z := r + P c, the latter where weight > 0; z may be r.
  void add(const Vector& r, const Field<double>& weight, const Vector& z) const;
  // P^T v . c, of an axis that is not periodic
  double product() { return dot(multigrid_.finest().grid.size(), multigrid_.finest().right, c_); }

 private:
  MeshCells cells_;
  BoxMultigrid multigrid_;
  Field<int> first_;       // point of each cell
  Field<int> node_;        // south-west of each point
  Field<double> fx_, fy_;  // where in its cell, 0 to 1
  Vector south_, north_;   // what a row of cells gives to the nodes below and above it
  Vector c_;               // of the last cycle
  int points_ = 0;
};

}  // namespace freshet::linear
