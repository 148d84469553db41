#include "src/methods/sisph/solver.hpp"

#include <algorithm>
#include <cmath>

namespace freshet::sisph {

template <int D>
SemiImplicitSph<D>::SemiImplicitSph(const Scene& scene)
    : Base(scene, make_kernel<D>(scene.sisph.kernel, scene.sisph.smoothing, false)) {
  place_particles();
}

// What bounds the next step; thin films may run fast without harm.
template <int D>
void SemiImplicitSph<D>::measure_speeds() {
  constexpr double thin = 0.01;  // of the deepest
  const Layer<D> now = water();
  double deepest = 0, fastest2 = 0;
  Kokkos::parallel_reduce(
      "sisph::deepest", Range(0, particles_.size()),
      KOKKOS_LAMBDA(int i, double& m) { m = larger(m, now.depth(i)); }, Kokkos::Max<double>(deepest));
  const double least = thin * deepest;
  Kokkos::parallel_reduce(
      "sisph::fastest", Range(0, particles_.size()),
      KOKKOS_LAMBDA(int i, double& m) {
        const Vec<double, D> v = at(now.v, i);
        if (now.depth(i) > least) m = larger(m, dot(v, v));
      },
      Kokkos::Max<double>(fastest2));
  celerity_ = std::sqrt(scene_.gravity * deepest);
  speed_ = std::sqrt(fastest2);
}

template <int D>
double SemiImplicitSph<D>::longest_step() const {
  constexpr double rounding = 1 + 1e-9;  // a whole number of steps must not become one more
  if (scene_.time_step > 0) return rounding * scene_.time_step;
  return scene_.sisph.courant * scene_.water.spacing / std::max(celerity_, 1e-300);
}

template class SemiImplicitSph<1>;
template class SemiImplicitSph<2>;

}  // namespace freshet::sisph
