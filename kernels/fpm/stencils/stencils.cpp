#include "kernels/fpm/stencils/stencils.hpp"

#include "cellgrid/parallel/launch.hpp"

namespace freshet::fpm {
namespace {

// result = at(c) at the points of each cluster c.
template <int D, class Result, class At>
void at_points(const char* label, const StencilView<D>& view, const Result& result, const At& at_cluster) {
  launch(
      label, Range(0, view.around.clusters.size()),
      KOKKOS_LAMBDA(int c) { view.around.clusters(c).store(result, at_cluster(c)); });
}

}  // namespace

template <int D>
StencilReport Stencils<D>::find(const Neighbourhood<D>& around) {
  view_.around = around;
  const int clusters = around.clusters.size();
  if (view_.factors.extent_int(0) < clusters)
    view_.factors =
        decltype(view_.factors)(Kokkos::ViewAllocateWithoutInitializing("fpm.factors"),
                                static_cast<size_t>(clusters + clusters / 4), StencilView<D>::count, lanes);
  StencilReport report;
  const StencilView<D> view = view_;
  Kokkos::parallel_reduce(
      "fpm::stencils", Range(0, clusters),
      KOKKOS_LAMBDA(int c, int& poor) {
        const Lanes me = view.around.clusters(c);
        Moments<Lane, D> moments;
        view.around.for_each(c, [&](int, const Terms<Lane, D>& m, const Lane& w) { moments.add(w, m); });
        view.keep(c, moments);
        const Derivatives<Lane, D> d(moments, 1.0 / me.load(view.around.h));
        unroll<D>([&](auto axis) { view.store(c, axis * view.slopes, d.gradient[axis]); });
        view.store(c, view.laplacian_first, d.laplacian);
        moments.g(0, 0) += 1.0;  // the point itself
        view.store(c, view.value_first, soft_value_factors(moments));
        for (int l = 0; l < me.count; ++l) poor += lane_of(d.complete, l) < 1 - 1e-6;
      },
      report.poor);
  return report;
}

template <int D>
void Stencils<D>::gradient(const Field<double>& f, const VecField<double, D>& result) const {
  const StencilView<D> view = view_;
  at_points(
      "fpm::gradient", view, result, KOKKOS_LAMBDA(int c) { return view.gradient(c, f); });
}

template <int D>
void Stencils<D>::laplacian(const VecField<double, D>& v, const VecField<double, D>& result) const {
  const StencilView<D> view = view_;
  at_points(
      "fpm::laplacian", view, result, KOKKOS_LAMBDA(int c) { return view.laplacian(c, v); });
}

template <int D>
void Stencils<D>::divergence(const VecField<double, D>& v, const Field<double>& result) const {
  const StencilView<D> view = view_;
  at_points(
      "fpm::divergence", view, result, KOKKOS_LAMBDA(int c) { return view.divergence(c, v); });
}

template <int D>
void Stencils<D>::fit(const Field<double>& f, const Field<double>& result) const {
  const StencilView<D> view = view_;
  at_points(
      "fpm::fit", view, result, KOKKOS_LAMBDA(int c) { return view.fit(c, f); });
}

template class Stencils<2>;

}  // namespace freshet::fpm
