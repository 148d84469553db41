// Packs lane by lane against plain doubles.
#include "cellgrid/pack.hpp"

#include <catch2/catch.hpp>

#include <limits>

#include "tests/support/cloud.hpp"
#include "tests/support/pack_border.hpp"

using namespace freshet;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Different in every lane: a swapped or lost lane shows.
Lane ramp(double first, double step) {
  Lane a;
  for (int l = 0; l < lanes; ++l) set_lane(a, l, first + l * step);
  return a;
}

template <class Expected>
void require_lanes(Lane a, const Expected& expected) {
  for (int l = 0; l < lanes; ++l) {
    CAPTURE(l);
    CHECK(lane_of(a, l) == expected(l));
  }
}

}  // namespace

TEST_CASE("pack: arithmetic lane by lane") {
  const Lane a = ramp(1, 1), b = ramp(-3, 2);  // small integers: exact
  require_lanes(a + b, [](int l) { return (1.0 + l) + (-3.0 + 2 * l); });
  require_lanes(a - b, [](int l) { return (1.0 + l) - (-3.0 + 2 * l); });
  require_lanes(a * b, [](int l) { return (1.0 + l) * (-3.0 + 2 * l); });
  require_lanes(-a, [](int l) { return -(1.0 + l); });
  require_lanes(2.5 * a + 1.0, [](int l) { return 2.5 * (1.0 + l) + 1; });
  Lane c = a;
  c += b;
  c *= Lane(2.0);
  c -= a;
  require_lanes(c, [](int l) { return 2 * ((1.0 + l) + (-3.0 + 2 * l)) - (1.0 + l); });
}

TEST_CASE("pack: quotients and roots") {
  const Lane a = ramp(1, 0.37), b = ramp(0.3, 1.1);
  const Lane quotient = a / b, root_of_b = root(b);
  for (int l = 0; l < lanes; ++l) {
    // Two roundings: -freciprocal-math may turn the quotient into a product.
    CHECK(lane_of(quotient, l) == Approx((1 + 0.37 * l) / (0.3 + 1.1 * l)).epsilon(4.5e-16).margin(0));
    CHECK(lane_of(root_of_b, l) == Approx(std::sqrt(0.3 + 1.1 * l)).epsilon(4.5e-16).margin(0));
  }
}

TEST_CASE("pack: a scalar fills every lane, also one that is not finite") {
  require_lanes(Lane(-0.75), [](int) { return -0.75; });
  require_lanes(Lane(infinity), [](int) { return infinity; });
  const Lane lost(std::numeric_limits<double>::quiet_NaN());
  for (int l = 0; l < lanes; ++l) CHECK(std::isnan(lane_of(lost, l)));
}

TEST_CASE("pack: smaller, larger, clamp") {
  const Lane a = ramp(-3, 1), b(0.5);
  require_lanes(smaller(a, b), [](int l) { return std::min(-3.0 + l, 0.5); });
  require_lanes(larger(a, b), [](int l) { return std::max(-3.0 + l, 0.5); });
  require_lanes(clamp(a, Lane(-1.5), Lane(1.5)), [](int l) { return std::min(std::max(-3.0 + l, -1.5), 1.5); });
  require_lanes(larger(-a, Lane(0.0)), [](int l) { return std::max(3.0 - l, 0.0); });
}

TEST_CASE("pack: sizes, signs and the larger where a mask says so") {
  const Lane a = ramp(-3, 1), b = ramp(1.5, -1);
  require_lanes(size_of(a), [](int l) { return std::abs(-3.0 + l); });
  require_lanes(turned_by(a, b), [](int l) { return 1.5 - l < 0 ? 3.0 - l : -3.0 + l; });
  require_lanes(larger_where(b < Lane(0.0), a, Lane(2.0)), [](int l) { return 1.5 - l < 0 ? std::max(-3.0 + l, 2.0) : -3.0 + l; });
  CHECK(size_of(-2.0) == 2);
  CHECK(turned_by(3.0, -1.0) == -3);
  CHECK(larger_where(false, 1.0, 2.0) == 1);
  CHECK(larger_where(true, 1.0, 2.0) == 2);
}

TEST_CASE("pack: select, any and count follow the mask") {
  const Lane a = ramp(0, 1), b = ramp(100, 1);
  for (int k = 0; k <= lanes; ++k) {
    const auto below = a < Lane(static_cast<double>(k));  // the first k lanes
    require_lanes(select(below, a, b), [k](int l) { return l < k ? l : 100.0 + l; });
    CHECK(any(below) == (k > 0));
    CHECK(count(below) == k);
    CHECK(count(!below) == lanes - k);
    CHECK(count(first_lanes(k) & (Lane(-1.0) < a)) == k);
    CHECK(count(first_lanes(k) & !below) == 0);
    const auto first = a < Lane(1.0);
    CHECK(count(below & first) == (k > 0 ? 1 : 0));
    CHECK(count(below | first) == std::max(k, 1));
  }
  const Lane lost(std::numeric_limits<double>::quiet_NaN());
  CHECK_FALSE(any(lost < a));
  CHECK_FALSE(any(a < lost));
}

TEST_CASE("pack: largest and smallest lane") {
  for (int k = 0; k < lanes; ++k) {
    Lane a = ramp(-1, 0.01);
    set_lane(a, k, 7.0);
    CHECK(largest(a) == 7);
    set_lane(a, k, -7.0);
    CHECK(smallest(a) == -7);
  }
  CHECK(largest(Lane(-2.0)) == -2);
  CHECK(smallest(Lane(2.0)) == 2);
}

TEST_CASE("pack: reciprocal square root over four hundred decades") {
  // 14-bit estimate (relative error e <= 2^-14) and one third-order step: (5/2) e^3 = 5.7e-13 at most.
  double worst = 0;
  test::Random random(1);
  for (double exponent = -200; exponent <= 200; exponent += 0.37) {
    Lane a;
    for (int l = 0; l < lanes; ++l) set_lane(a, l, random(1, 10) * std::pow(10, exponent));
    const Lane r = rsqrt(a);
    for (int l = 0; l < lanes; ++l) worst = std::max(worst, std::abs(lane_of(r, l) * std::sqrt(lane_of(a, l)) - 1));
  }
  CHECK(worst < 1e-12);
  CHECK(rsqrt(4.0) == 0.5);  // the scalar form
}

TEST_CASE("pack: a pair with itself has a finite reciprocal distance at any depth that occurs") {
  // internal_force takes rsqrt((rho_i + rho_j)^2 tiny_square); its first product is the square of the result.
  for (const double rho : {1e-12, 1e-6, 1.0, 1e5}) {
    const Lane inverse = rsqrt(Lane(rho) * Lane(rho) * Lane(tiny_square));
    CHECK(largest(inverse) == Approx(1 / (rho * std::sqrt(tiny_square))).epsilon(1e-12));
  }
}

TEST_CASE("pack: whole numbers, look-ups, single lanes") {
  const Lane a = ramp(0.9, 1.2);
  const LaneIndex cut = to_index(a);
  require_lanes(to_real(cut), [](int l) { return std::floor(0.9 + 1.2 * l); });
  require_lanes(to_real(to_index(-a)), [](int l) { return -std::floor(0.9 + 1.2 * l); });  // towards zero
  double table[32];
  for (int k = 0; k < 32; ++k) table[k] = 1.5 * k * k;
  require_lanes(gather(table + 2, cut), [&](int l) { return table[2 + static_cast<int>(0.9 + 1.2 * l)]; });
  Lane b = a;
  set_lane(b, lanes - 1, -5.0);
  CHECK(lane_of(b, lanes - 1) == -5);
  if (lanes > 1) CHECK(lane_of(b, 0) == lane_of(a, 0));
}

TEST_CASE("pack: reciprocal cube root over sixty decades") {
  // The start is 8.2 % off; a Newton step leaves 2 e^2 of an error e, four of them 1.4e-2, 3.6e-4, 2.6e-7, 1.9e-13.
  double worst = 0;
  test::Random random(2);
  for (double exponent = -30; exponent <= 30; exponent += 0.13) {
    Lane a;
    for (int l = 0; l < lanes; ++l) set_lane(a, l, random(1, 10) * std::pow(10, exponent));
    const Lane r = inverse_cbrt(a);
    for (int l = 0; l < lanes; ++l) worst = std::max(worst, std::abs(lane_of(r, l) * std::cbrt(lane_of(a, l)) - 1));
  }
  CHECK(worst < 3e-13);
  CHECK(inverse_cbrt(8.0) == Approx(0.5).epsilon(1e-15).margin(0));
}

TEST_CASE("pack: passed by value between objects") {
  require_lanes(test::twice_and_once(ramp(1, 1), ramp(10, -1)), [](int l) { return 2 * (1.0 + l) + 10 - l; });
  const Lane a = ramp(1, 1);
  require_lanes(test::sum_of_ten(a, a, a, a, a, a, a, a, a, 100.0 * a), [](int l) { return 109 * (1.0 + l); });
  const Vec<Lane, 2> b = test::turned({ramp(0, 1), ramp(50, 2)});
  require_lanes(b.x, [](int l) { return -(50.0 + 2 * l); });
  require_lanes(b.y, [](int l) { return 0.0 + l; });
}
