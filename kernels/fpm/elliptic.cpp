#include "kernels/fpm/elliptic.hpp"

namespace freshet::fpm {
namespace {

constexpr double equation_weight = 100;  // results do not depend on it between 1 and 1e8

template <class V, int D>
KOKKOS_FORCEINLINE_FUNCTION Terms<V, D> laplace_row() {
  Terms<V, D> r;
  unroll<terms<D>>([&](auto k) { r[k] = V(is_pure_second<D>(k) ? 1.0 : 0.0); });
  return r;
}
template <class V>
KOKKOS_FORCEINLINE_FUNCTION Terms<V, 2> flux_row(const Vec<V, 2>& n) {
  return {{V(0.0), n.x, n.y, V(0.0), V(0.0), V(0.0)}};
}

// The rows of one cluster.
template <int D>
struct AssembleRows {
  Neighbourhood<D> around;
  PoissonPlaces<D> places;
  linear::ClusterMatrix matrix;
  Field<double> per_source, per_flux;

  KOKKOS_INLINE_FUNCTION Lane where(const Lanes& me, int row) const {
    Lane yes{0.0};
    for (int l = 0; l < me.count; ++l) set_lane(yes, l, places.row(me.first + l) == row ? 1.0 : 0.0);
    return yes;
  }

  KOKKOS_INLINE_FUNCTION void operator()(int c) const {
    const Lanes me = around.clusters(c);
    const Lane has_flux = where(me, row_flux), free = has_flux + where(me, row_equation), h = me.load(around.h);
    Moments<Lane, D> moments;
    around.for_each(c, [&](int, const Terms<Lane, D>& m, const Lane& w) { moments.add(w, m); });
    const Terms<Lane, D> r_p = laplace_row<Lane, D>(), r_b = flux_row(has_flux * me.load(places.normal));
    moments.add(Lane(equation_weight), r_p);
    moments.add(Lane(equation_weight), r_b);
    Terms<Lane, D> beta = value_factors(moments);
    unroll<terms<D>>([&](auto k) { beta[k] *= free; });
    me.store(per_source, equation_weight * h * h * dot(r_p, beta));
    me.store(per_flux, equation_weight * h * dot(r_b, beta));
    int k = 0;
    around.for_each(c, [&](int, const Terms<Lane, D>& m, const Lane& w) {
      matrix.set(c, k++, -w * dot(m, beta));
    });
    matrix.round(c);
  }
};

}  // namespace

template <int D>
void Poisson<D>::reserve() {
  const int n = around_.points;
  for (auto* v : {&per_source_, &per_flux_, &b_})
    if (v->extent_int(0) < n + lanes) *v = Field<double>("fpm.poisson", static_cast<size_t>(n + n / 2 + lanes));
  if (free_.extent_int(0) < n) free_ = Field<int>("fpm.free", static_cast<size_t>(n + n / 2));
}

template <int D>
void Poisson<D>::assemble(const Neighbourhood<D>& around, const Rows& rows, const PoissonPlaces<D>& places) {
  const Region region("fpm::assemble");
  around_ = around;
  places_ = places;
  reserve();
  matrix_.lay_out(around.clusters, around.near, around.points);
  matrix_.lay_out_rough();
  const Field<int> free = free_, row = places.row;
  const Field<double> h = around.h;
  double reach = 0;
  Kokkos::parallel_reduce("fpm::unknowns", Range(0, around.points), KOKKOS_LAMBDA(int i, int& unknown, double& longest) {
        free(i) = row(i) != row_value;
        unknown += free(i);
        longest = larger(longest, h(i));
      }, unknowns_, Kokkos::Max<double>(reach));
  singular_ = unknowns_ == around.points;
  Kokkos::parallel_for("fpm::rows", Range(0, around.clusters.size()), AssembleRows<D>{around, places, matrix_, per_source_, per_flux_});
  multigrid_.build(matrix_, free_, {rows, reach, around.period.length.x > 0, around.period.length.y > 0}, singular_);
}

template <int D>
void Poisson<D>::multiply(const Field<double>& x, const Field<double>& y) {
  matrix_.multiply(x, y);
  if (!singular_) return;
  const int n = matrix_.rows;
  const double mean = sums_.sum<1>("fpm::mean", n, KOKKOS_LAMBDA(int i) { return Kokkos::Array<double, 1>{{x(i)}}; })[0] / n;
  Kokkos::parallel_for("fpm::add_mean", Range(0, n), KOKKOS_LAMBDA(int i) { y(i) += mean; });
}

template <int D>
void Poisson<D>::set_right_side(const PoissonData& data, const Field<double>& psi) {
  const Field<double> b = b_, per_source = per_source_, per_flux = per_flux_;
  const Field<int> row = places_.row;
  const PoissonData d = data;
  Kokkos::parallel_for("fpm::right_side", Range(0, matrix_.rows), KOKKOS_LAMBDA(int i) {
        if (row(i) == row_value) psi(i) = d.value(i);
        const double flux = row(i) == row_flux ? per_flux(i) * d.flux(i) : 0.0;
        b(i) = row(i) == row_value ? psi(i) : per_source(i) * d.source(i) + flux;
      });
}

template <int D>
PoissonReport Poisson<D>::solve(const PoissonData& data, const Field<double>& psi, const linear::BiCgStabOptions& options) {
  const Region region("fpm::solve");
  set_right_side(data, psi);
  PoissonReport report;
  report.unknowns = unknowns_;
  report.singular = singular_;
  const int n = matrix_.rows;
  report.solve = krylov_.solve(n, [this](const auto& x, const auto& y) { multiply(x, y); },
                               [this](const auto& r, const auto& z) { multigrid_(r, z); }, b_, psi, options);
  if (!singular_) return report;
  const double mean = sums_.sum<1>("fpm::mean", n, KOKKOS_LAMBDA(int i) { return Kokkos::Array<double, 1>{{psi(i)}}; })[0] / n;
  Kokkos::parallel_for("fpm::take_mean", Range(0, n), KOKKOS_LAMBDA(int i) { psi(i) -= mean; });
  return report;
}

template class Poisson<2>;

}  // namespace freshet::fpm
