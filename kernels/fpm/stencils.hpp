// Derivatives by moving least squares at every point (thesis 5.9-5.13): the factors of gradient, Laplacian and fitted value are found once
// per step and reused by all operators. Derivatives act on differences to the point's own value; the fitted value counts the point
// itself with weight 1. Reads x, h; writes factors [1/m, 1/m2, 1].
#pragma once
#include "cellgrid/sums.hpp"
#include "kernels/fpm/neighbours.hpp"

namespace freshet::fpm {

// Factors of one cluster are contiguous: [cluster][term][lane].
template <int D>
struct StencilView {
  Neighbourhood<D> around;
  Kokkos::View<double***, Kokkos::LayoutRight, Memory> factors;

  static constexpr int slopes = terms<D> - 1;
  static constexpr int laplacian = D * slopes, value = laplacian + slopes, count = value + terms<D>;

  template <int N>
  KOKKOS_FORCEINLINE_FUNCTION Column<Lane, N> load(int c, int first) const {
    Column<Lane, N> beta;
    unroll<N>([&](auto k) { __builtin_memcpy(&beta[k], &factors(c, first + k, 0), sizeof(Lane)); });
    return beta;
  }
  template <int N>
  KOKKOS_FORCEINLINE_FUNCTION void store(int c, int first, const Column<Lane, N>& beta) const {
    unroll<N>([&](auto k) { __builtin_memcpy(&factors(c, first + k, 0), &beta[k], sizeof(Lane)); });
  }

  // Gradient [1/m x f] of a field at the cluster's points.
  KOKKOS_INLINE_FUNCTION Vec<Lane, D> gradient(int c, const Field<double>& f) const;
};

template <>
KOKKOS_INLINE_FUNCTION Vec<Lane, 2> StencilView<2>::gradient(int c, const Field<double>& f) const {
  const auto bx = load<slopes>(c, 0), by = load<slopes>(c, slopes);
  const Lane here = around.clusters(c).load(f);
  Vec<Lane, 2> sum;
  around.for_each(c, [&](int j, const Terms<Lane, 2>& m, const Lane& w) {
    const Lane wd = w * (f(j) - here);
    sum.x += wd * of_slopes<Lane, 2>(m, bx);
    sum.y += wd * of_slopes<Lane, 2>(m, by);
  });
  return sum;
}

struct StencilReport {
  int poor = 0;  // points whose neighbours do not determine all derivatives
};

template <int D>
class Stencils {
 public:
  StencilReport find(const Neighbourhood<D>& around);
  const StencilView<D>& view() const { return view_; }

  // Each for all points of the view; values in the order of the points.
  void gradient(const Field<double>& f, const VecField<double, D>& result) const;   // 1/m x f
  void laplacian(const Field<double>& f, const Field<double>& result) const;        // 1/m2 x f
  void divergence(const VecField<double, D>& v, const Field<double>& result) const;  // 1/m x v
  void fit(const Field<double>& f, const Field<double>& result) const;              // the fitted value: a filter

 private:
  StencilView<D> view_;
};

}  // namespace freshet::fpm
