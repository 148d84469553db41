#include "kernels/fpm/stencils.hpp"

namespace freshet::fpm {

template <int D>
StencilReport Stencils<D>::find(const Neighbourhood<D>& around) {
  view_.around = around;
  const int clusters = around.clusters.size();
  if (view_.factors.extent_int(0) < clusters)
    view_.factors = decltype(view_.factors)(Kokkos::ViewAllocateWithoutInitializing("fpm.factors"),
                                            static_cast<size_t>(clusters + clusters / 4), StencilView<D>::count, lanes);
  StencilReport report;
  const StencilView<D> view = view_;
  Kokkos::parallel_reduce("fpm::stencils", Range(0, clusters), KOKKOS_LAMBDA(int c, int& poor) {
        const Lanes me = view.around.clusters(c);
        Moments<Lane, D> moments;
        view.around.for_each(c, [&](int, const Terms<Lane, D>& m, const Lane& w) { moments.add(w, m); });
        const Derivatives<Lane, D> d(moments, 1.0 / me.load(view.around.h));
        unroll<D>([&](auto axis) { view.store(c, axis * view.slopes, d.gradient[axis]); });
        view.store(c, view.laplacian, d.laplacian);
        moments.g(0, 0) += 1.0;  // the point itself
        view.store(c, view.value, value_factors(moments));
        for (int l = 0; l < me.count; ++l) poor += lane_of(d.complete, l) < 1 - 1e-6;
      }, report.poor);
  return report;
}

template <int D>
void Stencils<D>::gradient(const Field<double>& f, const VecField<double, D>& result) const {
  const StencilView<D> view = view_;
  Kokkos::parallel_for("fpm::gradient", Range(0, view.around.clusters.size()), KOKKOS_LAMBDA(int c) {
        view.around.clusters(c).store(result, view.gradient(c, f));
      });
}

template <int D>
void Stencils<D>::laplacian(const Field<double>& f, const Field<double>& result) const {
  const StencilView<D> view = view_;
  Kokkos::parallel_for("fpm::laplacian", Range(0, view.around.clusters.size()), KOKKOS_LAMBDA(int c) {
        const auto beta = view.template load<StencilView<D>::slopes>(c, view.laplacian);
        const Lanes me = view.around.clusters(c);
        const Lane here = me.load(f);
        Lane sum{0.0};
        view.around.for_each(c, [&](int j, const Terms<Lane, D>& m, const Lane& w) {
          sum += w * (f(j) - here) * of_slopes<Lane, D>(m, beta);
        });
        me.store(result, sum);
      });
}

template <>
void Stencils<2>::divergence(const VecField<double, 2>& v, const Field<double>& result) const {
  const StencilView<2> view = view_;
  Kokkos::parallel_for("fpm::divergence", Range(0, view.around.clusters.size()), KOKKOS_LAMBDA(int c) {
        const auto bx = view.load<StencilView<2>::slopes>(c, 0), by = view.load<StencilView<2>::slopes>(c, view.slopes);
        const Lanes me = view.around.clusters(c);
        const Vec<Lane, 2> here = me.load(v);
        Lane sum{0.0};
        view.around.for_each(c, [&](int j, const Terms<Lane, 2>& m, const Lane& w) {
          const Vec<Lane, 2> d = broadcast(at(v, j)) - here;
          sum += w * (d.x * of_slopes<Lane, 2>(m, bx) + d.y * of_slopes<Lane, 2>(m, by));
        });
        me.store(result, sum);
      });
}

template <int D>
void Stencils<D>::fit(const Field<double>& f, const Field<double>& result) const {
  const StencilView<D> view = view_;
  Kokkos::parallel_for("fpm::fit", Range(0, view.around.clusters.size()), KOKKOS_LAMBDA(int c) {
        const auto beta = view.template load<terms<D>>(c, view.value);
        const Lanes me = view.around.clusters(c);
        Lane sum = beta[0] * me.load(f);
        view.around.for_each(c, [&](int j, const Terms<Lane, D>& m, const Lane& w) { sum += w * f(j) * dot(m, beta); });
        me.store(result, sum);
      });
}

template class Stencils<2>;

}  // namespace freshet::fpm
