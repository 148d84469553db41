// Poisson's equation on scattered points (docs/formulas/fpm.md (F9) to (F12)): at each point the fitted
// polynomial obeys, beside its neighbours' values, lap psi = f and on walls n . grad psi = g, each with
// weight 100:
//   G = sum w m m^T + 100 r_p r_p^T + 100 r_b r_b^T,  G beta = e1,  r_p = [0, 0, 0, 1, 0, 1],  r_b = [0, nx,
//   ny, 0, 0, 0] psi_i - sum_j w_j (m_j . beta) psi_j = 100 (r_p . beta) h^2 f + 100 (r_b . beta) h g
// Where psi is given the row is psi_i = that. Without any such point constants are free: the system is A + 1
// 1^T / n, which has the bordered system's solution, and the mean is taken off. Solved by BiCGStab,
// preconditioned on a mesh, or where supports differ by bins.
#pragma once
#include "kernels/fpm/stencils/stencils.hpp"
#include "kernels/linear/bicgstab.hpp"
#include "kernels/linear/bins/bin_multigrid.hpp"
#include "kernels/linear/mesh/point_mesh.hpp"

namespace freshet::fpm {

// What is known at a point.
enum PoissonRow : int { row_equation = 0, row_flux = 1, row_value = 2 };  // flux: beside the equation

template <int D>
struct PoissonPlaces {
  Field<int> row;              // PoissonRow
  VecField<double, D> normal;  // unit, of points with a flux
};

struct PoissonData {
  Field<double> source;  // f
  Field<double> flux;    // g, at points with a flux
  Field<double> value;   // psi, where it is given
};

struct PoissonReport {
  linear::BiCgStabReport solve;
  int unknowns = 0;
  bool singular = false;
};

template <int D>
class Poisson {
 public:
  // The rows, and the levels of the preconditioner. rows: the order of the points.
  void assemble(const StencilView<D>& stencils, const Rows& rows, const PoissonPlaces<D>& places);

  // psi holds the first guess. floor: a residual of psi (root of the sum of squares) that is always good
  // enough.
  PoissonReport solve(const PoissonData& data, const Field<double>& psi,
                      const linear::BiCgStabOptions& options);

  bool singular() const { return singular_; }
  const linear::ClusterMatrix& matrix() const { return matrix_; }
  bool on_mesh() const { return on_mesh_; }
  // m2, of each point: what its row has per unit of source.
  const Field<double>& per_source() const { return per_source_; }

  void multiply(const Field<double>& x, const Field<double>& y);
  void precondition(const Field<double>& r, const Field<double>& z);
  void set_right_side(const PoissonData& data, const Field<double>& psi);
  double look_at_points();

 private:
  void reserve();

  Neighbourhood<D> around_;
  PoissonPlaces<D> places_;
  linear::ClusterMatrix matrix_;
  linear::PointMesh mesh_;
  linear::BinMultigrid multigrid_;
  linear::BiCgStab krylov_;
  Field<double> per_source_, per_flux_, b_;
  linear::MeshWeights weights_;
  Field<int> free_;  // 1 where psi is unknown
  int unknowns_ = 0;
  bool singular_ = false;
  bool on_mesh_ = true;
};

}  // namespace freshet::fpm
