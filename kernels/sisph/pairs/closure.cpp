#include "kernels/sisph/pairs/closure.hpp"

#include "kernels/linear/cg.hpp"
#include "kernels/sisph/pairs/parts.hpp"

namespace freshet::sisph {
namespace {

constexpr double closed_already = 1e-12;  // of sum_j A_ij: round-off

// y = sum_j A n n . (x_i - x_j); returns the slice's part of x . y.
template <int D>
struct Springs {
  Geometry<D> g;
  VecField<double, D> x, y;

  KOKKOS_FUNCTION LaneAddends<1> operator()(int k) const {
    const int s = g.slices(k);
    const Lanes me = g.pairs(s);
    const Vec<Lane, D> xi = me.load(x);
    Vec<Lane, D> sum;
    g.pairs.for_each(s, [&](int e, PairIndex j) {
      const Vec<Lane, D> n = PairView::load(g.n, e);
      sum += (PairView::load(g.area, e) * dot(n, xi - gather(x, j))) * n;
    });
    sum = free_lanes(g, me) * sum;
    me.store(y, sum);
    return {{counted(me, dot(xi, sum))}};
  }
};

KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 1> diagonal(const Sym<Lane, 1>& m) { return {m.xx}; }
KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 2> diagonal(const Sym<Lane, 2>& m) { return {m.xx, m.yy}; }
KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 1> reciprocal(const Vec<Lane, 1>& a) { return {1.0 / a.x}; }
KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 2> reciprocal(const Vec<Lane, 2>& a) { return {1.0 / a.x, 1.0 / a.y}; }

// -sum_j A_ij n_ij, the inverse diagonal, and the largest |sum A n| / sum A of the slice.
template <int D>
struct Openness {
  Geometry<D> g;
  VecField<double, D> right, inverse;

  KOKKOS_FUNCTION void operator()(int k, double& worst) const {
    const int s = g.slices(k);
    const Lanes me = g.pairs(s);
    Vec<Lane, D> sum;
    Sym<Lane, D> springs;
    Lane total(1e-300);
    g.pairs.for_each(s, [&](int e, PairIndex) {
      const Vec<Lane, D> n = PairView::load(g.n, e);
      const Lane area = PairView::load(g.area, e);
      sum += area * n;
      springs += outer(n, area);
      total += area;
    });
    const Lane free = free_lanes(g, me);
    me.store(right, (-free) * sum);
    me.store(inverse, free * reciprocal(diagonal(springs)));
    worst = larger(worst, largest(free * root(dot(sum, sum)) / total));
  }
};

template <int D>
struct Shift {
  Geometry<D> g;
  VecField<double, D> lambda;

  KOKKOS_FUNCTION void operator()(int s, double& change, int& negative) const {
    const Vec<Lane, D> li = g.pairs(s).load(lambda);
    g.pairs.for_each(s, [&](int e, PairIndex j) {
      const Lane area = PairView::load(g.area, e),
                 share = closing<D>(li, gather(lambda, j), PairView::load(g.n, e)), closed = area * share;
      PairView::store(g.area, e, closed);
      const Lane size = select(Lane(0.0) < area, larger(share - 1.0, 1.0 - share), Lane(0.0));
      change = larger(change, largest(size));
      negative += count(closed < Lane(0.0));
    });
  }
};

template <int D>
double openness(const Geometry<D>& g, const VecField<double, D>& right, const VecField<double, D>& inverse) {
  double worst = 0;
  Kokkos::parallel_reduce("sisph::openness", Range(0, g.slices.count), Openness<D>{g, right, inverse},
                          Kokkos::Max<double>(worst));
  return worst;
}

}  // namespace

template <int D>
ClosureReport close_areas(const Geometry<D>& g) {
  const int stride = g.images.slots(), size = D * stride;
  const auto vector = [&](const std::string& label) {
    return Field<double>(label, static_cast<size_t>(size) + lanes);
  };
  const Field<double> right = vector("sisph.closure_right"), inverse = vector("sisph.closure_inverse"),
                      lambda = vector("sisph.lambda");
  const Vec<double, D> dimension;
  ClosureReport report;
  report.unclosed = openness<D>(g, parts(right, stride, dimension), parts(inverse, stride, dimension));
  if (report.unclosed < closed_already) return report;
  const auto springs = [&](const Field<double>& x, const Field<double>& y) {
    g.images.fill(parts(x, stride, dimension));
    return sum_of_slices<1>("sisph::springs", g.slices.count,
                            Springs<D>{g, parts(x, stride, dimension), parts(y, stride, dimension)})[0];
  };
  linear::ConjugateGradients cg;
  cg.resize(size);
  linear::CgOptions options;
  options.tolerance = 1e-11;
  options.max_iterations = 20000;
  report.iterations = cg.solve(springs, linear::Jacobi{inverse}, right, lambda, options).iterations;
  g.images.fill(parts(lambda, stride, dimension));
  int negative = 0;
  Kokkos::parallel_reduce("sisph::close", Range(0, g.pairs.slices()),
                          Shift<D>{g, parts(lambda, stride, dimension)}, Kokkos::Max<double>(report.change),
                          Kokkos::Sum<int>(negative));
  report.negative = negative / 2;  // each stands in both rows
  report.unclosed = openness<D>(g, parts(right, stride, dimension), parts(inverse, stride, dimension));
  report.lambda = lambda;
  return report;
}

template ClosureReport close_areas(const Geometry<1>&);
template ClosureReport close_areas(const Geometry<2>&);

}  // namespace freshet::sisph
