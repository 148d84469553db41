// The additive particle-mesh preconditioner of sum_j a_ij (x_i - x_j) + m_i x_i, a_ij ~ k H over particles:
//   z = D^-1 r + Pw B Pw^T r
// P: bilinear (cloud-in-cell) weights of a particle in the four nodes of its mesh cell, rows of particles with m_i = 0 (dry) left
// out; B: one V-cycle of the 5-point system with mass sum_i P m_i and conductance k sum_i P m_i H_i / spacing^2 along each edge, that is
// the lumped Galerkin form of m - div k H grad over the wet particles, so shores need nothing else.
// The mesh is the sorted order itself: a cell is a row of particles times four bins, 2 dx x 2 dx, so both P and P^T walk
// contiguous particles and need no atomics; the same bits with any number of threads.
#pragma once
#include "cellgrid/order.hpp"
#include "cellgrid/vec.hpp"
#include "kernels/linear/multigrid5.hpp"

namespace freshet::linear {

template <int D>
class ParticleMesh {
 public:
  // rows: the order that x is in; x must not have changed since it was sorted. Allocates when the mesh grows.
  void lay(const Rows& rows, const VecField<double, D>& x);

  // The system at hand: m_i (0: left out), H_i [m] where m_i > 0, and k. To be called when any of them changed.
  void set(const Field<double>& mass, const Field<double>& depth, double k);

  // Adds Pw B Pw^T r to z and returns r . Pw B Pw^T r.
  double operator()(const Vector& r, const Vector& z);

  int nodes() const { return multigrid_.finest().size(); }

 private:
  Rows rows_;
  VecField<double, D> x_;
  Field<double> mass_;
  Field<double> corner_, edge_;  // four values per cell
  Multigrid5 multigrid_;
  OrderedSums sums_;
};

}  // namespace freshet::linear
