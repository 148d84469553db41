#include "kernels/fpm/pressure/elliptic.hpp"

#include "cellgrid/parallel/launch.hpp"

namespace freshet::fpm {
namespace {

constexpr double equation_weight = 100;  // results do not depend on it between 1 and 1e8
constexpr double even = 1.5;             // supports that differ by less are preconditioned on a mesh
constexpr double least_part = 0.01;  // of h^2: rows whose Laplacian counts for less are not looked at closer

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
  StencilView<D> stencils;
  PoissonPlaces<D> places;
  linear::ClusterMatrix matrix;
  Field<double> per_source, per_flux;
  Field<int> unknown;
  linear::MeshWeights mesh;
  bool on_mesh;

  KOKKOS_INLINE_FUNCTION Lane where(const Lanes& me, int row) const {
    return lanes_of<Lane>(
        [&](int lane) { return lane < me.count && places.row(me.first + lane) == row ? 1.0 : 0.0; });
  }

  KOKKOS_INLINE_FUNCTION void operator()(int c) const {
    const Neighbourhood<D>& around = stencils.around;
    const Lanes me = around.clusters(c);
    const Lane has_flux = where(me, row_flux), free = has_flux + where(me, row_equation),
               h = me.load(around.h);
    Moments<Lane, D> moments = stencils.moments(c);
    const Terms<Lane, D> r_p = laplace_row<Lane, D>(), r_b = flux_row(has_flux * me.load(places.normal));
    moments.add(Lane(equation_weight), r_p);
    moments.add(Lane(equation_weight), r_b);
    Terms<Lane, D> beta = value_factors(moments);
    unroll<terms<D>>([&](auto k) { beta[k] *= free; });
    me.store(per_source, equation_weight * h * h * dot(r_p, beta));
    me.store(per_flux, equation_weight * h * dot(r_b, beta));
    int k = 0;
    Lane held{0.0};
    around.for_each(c, [&](int j, const Terms<Lane, D>& m, const Lane& w) {
      const Lane share = w * dot(m, beta);
      matrix.set(c, k++, -share);
      held += share * (1.0 - unknown(j));
    });
    if (on_mesh) weigh(me, has_flux, free, h, equation_weight * dot(r_p, beta), held);
    else matrix.round(c);
  }

  // Row i is about per_laplacian h^2 lap; a wall's point stands for half a cell.
  KOKKOS_INLINE_FUNCTION void weigh(const Lanes& me, const Lane& has_flux, const Lane& free, const Lane& h,
                                    const Lane& per_laplacian, const Lane& held) const {
    const Lane part = 1.0 - 0.5 * has_flux;
    me.store(mesh.area, part * h * h);
    me.store(mesh.weight, free * part / larger(Lane(least_part), larger(per_laplacian, -per_laplacian)));
    me.store(mesh.held, held);
  }
};

}  // namespace

template <int D>
void Poisson<D>::reserve() {
  const int n = around_.points;
  for (auto* v : {&per_source_, &per_flux_, &b_, &weights_.area, &weights_.weight, &weights_.held})
    if (v->extent_int(0) < n + lanes)
      *v = Field<double>("fpm.poisson", static_cast<size_t>(n + n / 2 + lanes));
  if (free_.extent_int(0) < n) free_ = Field<int>("fpm.free", static_cast<size_t>(n + n / 2));
}

// Which values are unknown, how many, and whether a mesh suits the points; returns the longest support.
template <int D>
double Poisson<D>::look_at_points() {
  const Field<int> free = free_, row = places_.row;
  const Field<double> h = around_.h;
  double longest = 0, shortest = 0;
  Kokkos::parallel_reduce(
      "fpm::unknowns", Range(0, around_.points),
      KOKKOS_LAMBDA(int i, int& unknown, double& most, double& least) {
        free(i) = row(i) != row_value;
        unknown += free(i);
        most = larger(most, h(i));
        least = smaller(least, h(i));
      },
      unknowns_, Kokkos::Max<double>(longest), Kokkos::Min<double>(shortest));
  singular_ = unknowns_ == around_.points;
  weights_.singular = singular_;
  on_mesh_ = longest < even * shortest;
  return longest;
}

template <int D>
void Poisson<D>::assemble(const StencilView<D>& stencils, const Rows& rows, const PoissonPlaces<D>& places) {
  const TimedRegion region("fpm::assemble");
  const Neighbourhood<D>& around = stencils.around;
  around_ = around;
  places_ = places;
  reserve();
  const double reach = look_at_points();
  on_mesh_ = on_mesh_ && linear::MeshCorrection<2>::suits(rows, around.points, 6);
  matrix_.lay_out(around.clusters, around.near, around.points);
  if (!on_mesh_) matrix_.lay_out_rough();
  launch("fpm::rows", Range(0, around.clusters.size()),
         AssembleRows<D>{stencils, places, matrix_, per_source_, per_flux_, free_, weights_, on_mesh_});
  if (on_mesh_) mesh_.build(rows, around.x, around.points, around.period, weights_);
  else
    multigrid_.build(matrix_, free_, {rows, reach, around.period.length.x > 0, around.period.length.y > 0},
                     singular_);
}

template <int D>
void Poisson<D>::precondition(const Field<double>& r, const Field<double>& z) {
  if (on_mesh_) mesh_(r, z);
  else multigrid_(r, z);
}

template <int D>
void Poisson<D>::multiply(const Field<double>& x, const Field<double>& y) {
  matrix_.multiply(x, y);
  if (!singular_) return;
  const int n = matrix_.rows;
  const double mean = sum_of_values("fpm::mean", n, x) / n;
  launch(
      "fpm::add_mean", Range(0, n), KOKKOS_LAMBDA(int i) { y(i) += mean; });
}

template <int D>
void Poisson<D>::set_right_side(const PoissonData& data, const Field<double>& psi) {
  const Field<double> b = b_, per_source = per_source_, per_flux = per_flux_;
  const Field<int> row = places_.row;
  const PoissonData d = data;
  launch(
      "fpm::right_side", Range(0, matrix_.rows), KOKKOS_LAMBDA(int i) {
        if (row(i) == row_value) psi(i) = d.value(i);
        const double flux = row(i) == row_flux ? per_flux(i) * d.flux(i) : 0.0;
        b(i) = row(i) == row_value ? psi(i) : per_source(i) * d.source(i) + flux;
      });
}

template <int D>
PoissonReport Poisson<D>::solve(const PoissonData& data, const Field<double>& psi,
                                const linear::BiCgStabOptions& options) {
  const TimedRegion region("fpm::solve");
  set_right_side(data, psi);
  PoissonReport report;
  report.unknowns = unknowns_;
  report.singular = singular_;
  const int n = matrix_.rows;
  report.solve = krylov_.solve(
      n, [this](const auto& x, const auto& y) { multiply(x, y); },
      [this](const auto& r, const auto& z) { precondition(r, z); }, b_, psi, options);
  if (!singular_) return report;
  const double mean = sum_of_values("fpm::mean", n, psi) / n;
  launch(
      "fpm::take_mean", Range(0, n), KOKKOS_LAMBDA(int i) { psi(i) -= mean; });
  return report;
}

template class Poisson<2>;

}  // namespace freshet::fpm
