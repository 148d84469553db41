// The additive particle-mesh preconditioner of sum_j a_ij (x_i - x_j) + m_i x_i, a_ij ~ k H over particles:
//   z = D^-1 r + Pw B Pw^T r
// P: bilinear (cloud-in-cell) weights of a particle in the nodes of its mesh cell (mesh_correction.hpp), rows
// of particles with m_i = 0 (dry) left out; B: one V-cycle of the 5-point system with mass sum_i P m_i and
// conductance k sum_i P m_i H_i / spacing^2 along each edge, that is the lumped Galerkin form of m - div k H
// grad over the wet particles, so shores need nothing else.
#pragma once
#include "kernels/linear/mesh/mesh_correction.hpp"

namespace freshet::linear {

template <int D>
class ParticleMesh {
 public:
  // rows: the order that x is in; x must not have changed since it was sorted. Allocates when the mesh grows.
  void lay(const Rows& rows, const VecField<double, D>& x, int particles) {
    mesh_.lay(rows, x, particles, {});
  }

  // The system at hand: m_i (0: left out), H_i [m] where m_i > 0, and k. To be called when any of them
  // changed.
  void set(const Field<double>& mass, const Field<double>& depth, double k);

  // Adds Pw B Pw^T r to z and returns r . Pw B Pw^T r.
  double operator()(const Vector& r, const Vector& z);

 private:
  MeshCorrection<D> mesh_;
  Field<double> mass_;
};

}  // namespace freshet::linear
