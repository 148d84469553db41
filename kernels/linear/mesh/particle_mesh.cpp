#include "kernels/linear/mesh/particle_mesh.hpp"

#include "kernels/linear/mesh/mesh_passes.hpp"

namespace freshet::linear {
namespace {

// The values of wet particles.
struct WetCells {
  Field<double> mass, value;
  KOKKOS_FORCEINLINE_FUNCTION double operator()(int i) const { return mass(i) > 0 ? value(i) : 0.0; }
};

// k m H
struct Conducts {
  Field<double> mass, depth;
  double k;
  KOKKOS_FORCEINLINE_FUNCTION double operator()(int i) const {
    return mass(i) > 0 ? k * mass(i) * depth(i) : 0.0;
  }
};

}  // namespace

template <int D>
void ParticleMesh<D>::set(const Field<double>& mass, const Field<double>& depth, double k) {
  mass_ = mass;
  mesh_.set(WetCells{mass, mass}, Conducts{mass, depth, k});
}

template <int D>
double ParticleMesh<D>::operator()(const Vector& r, const Vector& z) {
  const TimedRegion region("particle_mesh");
  mesh_.solve(WetCells{mass_, r});
  mesh_.add(z, mass_, z);
  return mesh_.product();
}

template class ParticleMesh<1>;
template class ParticleMesh<2>;

}  // namespace freshet::linear
