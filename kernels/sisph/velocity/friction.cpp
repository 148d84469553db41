#include "kernels/sisph/velocity/friction.hpp"

#include "cellgrid/parallel/launch.hpp"

namespace freshet::sisph {

template <int D>
void find_drag(int particles, const Layer<D>& water, const Field<double>& g_n2, double dt,
               const Field<double>& drag) {
  constexpr double least = 1e-6;  // m: below this a film has all but stopped, and 1 / H^(4/3) stays finite
  const Layer<D> w = water;
  launch(
      "sisph::drag", Range(0, particles), KOKKOS_LAMBDA(int i) {
        const Vec<double, D> v = at(w.v, i);
        const double h = larger(w.depth(i), least);
        drag(i) = dt * g_n2(i) * root(dot(v, v)) / (h * ::cbrt(h));
      });
}

template void find_drag<1>(int, const Layer<1>&, const Field<double>&, double, const Field<double>&);
template void find_drag<2>(int, const Layer<2>&, const Field<double>&, double, const Field<double>&);

}  // namespace freshet::sisph
