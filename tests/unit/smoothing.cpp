// The smoothing kernels: norm, slope, support.
#include "kernels/smoothing.hpp"

#include <catch2/catch.hpp>

#include "tests/support/cloud.hpp"

using namespace freshet;

namespace {

// Integral of w over the line or the plane in units of h, by Simpson's rule between the joints of the pieces: exact for the
// cubic pieces in 1-D, error (1/1000)^4 = 1e-12 of the largest fourth derivative in 2-D (pi q w is of fourth order).
template <int D>
double norm() {
  constexpr int n = 2000;
  double sum = 0;
  for (int k = 0; k <= n; ++k) {
    const double q = 2.0 * k / n, weight = (k == 0 || k == n) ? 1 : (k % 2 == 1 ? 4 : 2);
    sum += weight * CubicSpline<D>::at(q).w * (D == 1 ? 2.0 : 2 * std::acos(-1.0) * q);
  }
  return sum * (2.0 / n) / 3;
}

template <int D>
double worst_against_printed() {
  double worst = 0;
  for (double q = 0; q < 2.2; q += 0.0037) {
    const auto k = CubicSpline<D>::at(q);
    worst = std::max({worst, std::abs(k.w - test::printed_w(D, q)), std::abs(k.dw - test::printed_dw(D, q))});
  }
  return worst;
}

template <int D>
double worst_slope() {
  constexpr double s = 1e-5;
  double worst = 0;
  for (double q = s; q < 2.2; q += 0.0037) {
    const double difference = (CubicSpline<D>::at(q + s).w - CubicSpline<D>::at(q - s).w) / (2 * s);
    worst = std::max(worst, std::abs(difference - CubicSpline<D>::at(q).dw));
  }
  return worst;
}

}  // namespace

TEST_CASE("smoothing: the cubic spline integrates to one") {
  CHECK(norm<1>() == Approx(1).epsilon(1e-12));
  CHECK(norm<2>() == Approx(1).epsilon(1e-11));
}

TEST_CASE("smoothing: the branch-free form is the printed one") {
  CHECK(worst_against_printed<1>() < 1e-15);  // a few roundings of values below 1
  CHECK(worst_against_printed<2>() < 1e-15);
}

TEST_CASE("smoothing: dw is the derivative of w") {
  // Central differences: s^2/6 |w'''| = 1e-10/6 x 3, and a rounding of 1e-16/s = 1e-11.
  CHECK(worst_slope<1>() < 1e-10);
  CHECK(worst_slope<2>() < 1e-10);
}

TEST_CASE("smoothing: exactly nothing outside the support, a decreasing positive bump inside") {
  for (const double q : {2.0, 2.0 + 1e-15, 2.5, 1e3, 1e100}) {
    CHECK(CubicSpline<2>::at(q).w == 0);
    CHECK(CubicSpline<2>::at(q).dw == 0);
    CHECK(CubicSpline<1>::slope(q) == 0);
  }
  for (double q = 0.01; q < 1.99; q += 0.01) {
    CHECK(CubicSpline<1>::at(q).w > 0);
    CHECK(CubicSpline<1>::at(q).dw < 0);
  }
  CHECK(CubicSpline<1>::at(0.0).dw == 0);
  CHECK(CubicSpline<2>::at(0.0).dw == 0);
}

TEST_CASE("smoothing: packs give what scalars give") {
  for (double q = 0; q < 2.2; q += 0.05) {
    Lane v;
    for (int l = 0; l < lanes; ++l) v.set(l, q + 0.005 * l);
    const auto k = CubicSpline<2>::at(v);
    for (int l = 0; l < lanes; ++l) {
      const auto scalar = CubicSpline<2>::at(q + 0.005 * l);
      CHECK(k.w[l] == Approx(scalar.w).margin(1e-15));  // other contractions of multiply and add
      CHECK(k.dw[l] == Approx(scalar.dw).margin(1e-15));
    }
  }
}
