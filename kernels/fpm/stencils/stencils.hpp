// Derivatives by moving least squares at every point (docs/formulas/fpm.md (F7)): the factors of gradient,
// Laplacian and fitted value are found once per step and reused by all operators. Derivatives act on
// differences to the point's own value; the fitted value counts the point itself with weight 1. The moments
// are kept for the rows of the pressure. Reads x, h; writes factors [1/m, 1/m2, 1], moments [1].
#pragma once
#include "cellgrid/particles/sums.hpp"
#include "kernels/fpm/stencils/neighbours.hpp"

namespace freshet::fpm {

// Factors of one cluster are contiguous: [cluster][term][lane].
template <int D>
struct StencilView {
  Neighbourhood<D> around;
  Kokkos::View<double***, Kokkos::LayoutRight, Memory> factors;

  static constexpr int slopes = terms<D> - 1;
  static constexpr int laplacian_first = D * slopes, value_first = laplacian_first + slopes,
                       moments_first = value_first + terms<D>, moment_count = terms<D> * (terms<D> + 1) / 2,
                       count = moments_first + moment_count;

  template <int N>
  KOKKOS_FORCEINLINE_FUNCTION Column<Lane, N> load(int c, int first) const {
    Column<Lane, N> beta;
    unroll<N>([&](auto k) { beta[k] = loaded<Lane>(&factors(c, first + k, 0)); });
    return beta;
  }
  template <int N>
  KOKKOS_FORCEINLINE_FUNCTION void store(int c, int first, const Column<Lane, N>& beta) const {
    unroll<N>([&](auto k) { freshet::store(&factors(c, first + k, 0), beta[k]); });
  }

  // sum w m m^T over the neighbours.
  KOKKOS_FORCEINLINE_FUNCTION Moments<Lane, D> moments(int c) const {
    Moments<Lane, D> kept;
    unroll<moment_count>([&](auto k) { kept.g.a[k] = loaded<Lane>(&factors(c, moments_first + k, 0)); });
    return kept;
  }
  KOKKOS_FORCEINLINE_FUNCTION void keep(int c, const Moments<Lane, D>& moments) const {
    unroll<moment_count>([&](auto k) { freshet::store(&factors(c, moments_first + k, 0), moments.g.a[k]); });
  }

  // At the cluster's points, of fields f and v.
  KOKKOS_INLINE_FUNCTION Vec<Lane, D> gradient(int c, const Field<double>& f) const {  // 1/m x f
    static_assert(D == 2, "three dimensions need a third component here");
    const auto bx = load<slopes>(c, 0), by = load<slopes>(c, slopes);
    const Lane here = around.clusters(c).load(f);
    Vec<Lane, D> sum;
    around.for_each(c, [&](int j, const Terms<Lane, D>& m, const Lane& w) {
      const Lane wd = w * (f(j) - here);
      sum.x += wd * of_slopes<Lane, D>(m, bx);
      sum.y += wd * of_slopes<Lane, D>(m, by);
    });
    return sum;
  }
  KOKKOS_INLINE_FUNCTION Vec<Lane, D> laplacian(int c, const VecField<double, D>& v) const {  // 1/m2 x v
    const auto beta = load<slopes>(c, laplacian_first);
    const Vec<Lane, D> here = around.clusters(c).load(v);
    Vec<Lane, D> sum;
    around.for_each(c, [&](int j, const Terms<Lane, D>& m, const Lane& w) {
      sum += (w * of_slopes<Lane, D>(m, beta)) * (broadcast(at(v, j)) - here);
    });
    return sum;
  }
  KOKKOS_INLINE_FUNCTION Lane divergence(int c, const VecField<double, D>& v) const {  // 1/m x v
    const auto bx = load<slopes>(c, 0), by = load<slopes>(c, slopes);
    const Vec<Lane, D> here = around.clusters(c).load(v);
    Lane sum{0.0};
    around.for_each(c, [&](int j, const Terms<Lane, D>& m, const Lane& w) {
      const Vec<Lane, D> d = broadcast(at(v, j)) - here;
      sum += w * (d.x * of_slopes<Lane, D>(m, bx) + d.y * of_slopes<Lane, D>(m, by));
    });
    return sum;
  }
  KOKKOS_INLINE_FUNCTION Lane fit(int c, const Field<double>& f) const {
    const auto beta = load<terms<D>>(c, value_first);
    Lane sum = beta[0] * around.clusters(c).load(f);
    around.for_each(c,
                    [&](int j, const Terms<Lane, D>& m, const Lane& w) { sum += w * f(j) * dot(m, beta); });
    return sum;
  }
};

struct StencilReport {
  int poor = 0;  // points whose neighbours do not determine all derivatives
};

template <int D>
class Stencils {
 public:
  StencilReport find(const Neighbourhood<D>& around);
  const StencilView<D>& view() const { return view_; }

  // Each at all points.
  void gradient(const Field<double>& f, const VecField<double, D>& result) const;
  void laplacian(const VecField<double, D>& v, const VecField<double, D>& result) const;
  void divergence(const VecField<double, D>& v, const Field<double>& result) const;
  void fit(const Field<double>& f, const Field<double>& result) const;

 private:
  StencilView<D> view_;
};

}  // namespace freshet::fpm
