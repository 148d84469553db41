// The smoothing kernels: norm, slope, support.
#include "kernels/smoothing/smoothing.hpp"
#include "kernels/choice.hpp"

#include <catch2/catch.hpp>

#include "tests/support/points/cloud.hpp"

using namespace freshet;

namespace {

// Integral of w over the line or the plane in units of h, by Simpson's rule between the joints of the pieces:
// exact for the cubic pieces in 1-D, error (1/1000)^4 = 1e-12 of the largest fourth derivative in 2-D (pi q w
// is of fourth order).
template <int D>
double norm() {
  constexpr int n = 2000;
  double sum = 0;
  for (int k = 0; k <= n; ++k) {
    const double q = 2.0 * k / n, weight = (k == 0 || k == n) ? 1 : (k % 2 == 1 ? 4 : 2);
    sum += weight * CubicSpline<D>::at(q).w * (D == 1 ? 2.0 : 2 * pi * q);
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
    const auto k = CubicSpline<2>::at(lanes_of<Lane>([&](int lane) { return q + 0.005 * lane; }));
    for (int l = 0; l < lanes; ++l) {
      const auto scalar = CubicSpline<2>::at(q + 0.005 * l);
      CHECK(lane_of(k.w, l) == Approx(scalar.w).margin(1e-15));  // other contractions of multiply and add
      CHECK(lane_of(k.dw, l) == Approx(scalar.dw).margin(1e-15));
    }
  }
}

namespace {

// Integral over the line or the plane by Simpson's rule with 4000 steps.
template <int D>
double general_norm(const KernelChoice& choice) {
  const auto kernel = general_kernel<D>(choice);
  constexpr int n = 4000;
  double sum = 0;
  for (int k = 0; k <= n; ++k) {
    const double q = kernel.support * k / n, weight = (k == 0 || k == n) ? 1 : (k % 2 == 1 ? 4 : 2);
    sum += weight * kernel.at(q).w * (D == 1 ? 2.0 : 2 * pi * q);
  }
  return sum * (kernel.support / n) / 3;
}

template <int D>
double general_slope_error(const KernelChoice& choice) {
  const auto kernel = general_kernel<D>(choice);
  constexpr double s = 1e-5;
  double worst = 0;
  for (double q = s; q < kernel.support - 2 * s; q += 0.0037)
    worst = std::max(worst, std::abs((kernel.at(q + s).w - kernel.at(q - s).w) / (2 * s) - kernel.slope(q)));
  return worst;
}

template <int D>
double lattice_excess(const AnyKernel<D>& kernel, double eta) {
  double sum = 0;
  for (int i = -12; i <= 12; ++i)
    for (int j = D == 1 ? 0 : -12; j <= (D == 1 ? 0 : 12); ++j)
      sum += std::visit([&](const auto& k) { return k.at(std::hypot(i, j) / eta).w; }, kernel) /
             (D == 1 ? eta : eta * eta);
  return sum - 1;
}

}  // namespace

TEST_CASE("smoothing: every kernel integrates to one and slopes as its derivative") {
  for (const KernelChoice& choice : alternatives<KernelChoice>()) {
    CAPTURE(name_of(choice));
    // The Gaussian is cut at 3: erfc(3) = 2.2e-5 is missing in 1-D, exp(-9) = 1.23e-4 in 2-D. In both the cut
    // halves one end of Simpson's rule: 1e-3/3 of a value of 1e-4.
    const double cut = std::holds_alternative<kernel::Gaussian>(choice) ? 1 : 0;
    CHECK(general_norm<1>(choice) == Approx(1 - cut * std::erfc(3.0)).epsilon(cut > 0 ? 1e-6 : 1e-9));
    CHECK(general_norm<2>(choice) == Approx(1 - cut * std::exp(-9.0)).epsilon(cut > 0 ? 1e-6 : 1e-9));
    CHECK(general_slope_error<1>(choice) <
          1e-9);  // s^2/6 of the third derivative with s = 1e-5, and rounding 1e-16/s
    CHECK(general_slope_error<2>(choice) < 1e-9);
  }
}

TEST_CASE("smoothing: the cubic spline as data is the cubic spline") {
  const auto kernel = general_kernel<2>(kernel::Cubic{});
  for (double q = 0; q < 2.5; q += 0.01) {
    CHECK(kernel.at(q).w == Approx(CubicSpline<2>::at(q).w).margin(1e-15));
    CHECK(kernel.at(q).dw == Approx(CubicSpline<2>::at(q).dw).margin(1e-15));
  }
}

TEST_CASE("smoothing: lattice bias as measured, and none with the correction") {
  // docs/formulas/swe.md (S6); half a unit of the last digit.
  CHECK(lattice_excess<2>(make_kernel<2>(kernel::Wendland{}, 1.2, false), 1.2) ==
        Approx(1.8e-2).margin(0.5e-3));
  CHECK(lattice_excess<2>(make_kernel<2>(kernel::Wendland{}, 2.0, false), 2.0) ==
        Approx(1.2e-3).margin(0.5e-4));
  CHECK(std::abs(lattice_excess<2>(make_kernel<2>(kernel::Quintic{}, 1.1, false), 1.1)) <= 1.4e-4);
  for (const KernelChoice& choice : alternatives<KernelChoice>()) {
    CHECK(std::abs(lattice_excess<1>(make_kernel<1>(choice, 1.2, true), 1.2)) < 1e-13);
    CHECK(std::abs(lattice_excess<2>(make_kernel<2>(choice, 1.2, true), 1.2)) < 1e-13);
  }
}
