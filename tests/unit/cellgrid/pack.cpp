// Packs lane by lane against plain scalars, on registers of every width whatever the machine has: eight
// doubles and sixteen floats in one register of 64 bytes, two of 32 and four of 16.
#include "cellgrid/simd/distance.hpp"
#include "cellgrid/simd/lanes.hpp"

#include <catch2/catch.hpp>

#include <cstdint>
#include <limits>

#include "tests/support/points/cloud.hpp"

using namespace freshet;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
const double not_a_number = std::numeric_limits<double>::quiet_NaN();

template <class P>
struct Shape;
template <class T, int W, int B>
struct Shape<pack<T, W, B>> {
  using Element = T;
  static constexpr int width = W, bytes = B;
};
template <class P>
using Element = typename Shape<P>::Element;
template <class P>
constexpr int width = Shape<P>::width;

using Doubles1 = pack<double, 8, 64>;
using Doubles2 = pack<double, 8, 32>;
using Doubles4 = pack<double, 8, 16>;
using Floats1 = pack<float, 16, 64>;
using Floats2 = pack<float, 16, 32>;
using Floats4 = pack<float, 16, 16>;

// Different in every lane: a swapped or lost lane shows.
template <class P>
P ramp(double first, double step) {
  return P::of([&](int lane) { return static_cast<Element<P>>(first + lane * step); });
}

template <class P, class Expected>
void require_lanes(const P& a, const Expected& expected) {
  for (int l = 0; l < width<P>; ++l) {
    CAPTURE(l);
    CHECK(lane_of(a, l) == static_cast<Element<P>>(expected(l)));
  }
}

// Largest relative error of a word against a scalar one, over so many decades either side of one.
template <class P, class Word, class Exact>
double worst_over(double decades, unsigned seed, const Word& word, const Exact& exact) {
  double worst = 0;
  test::Random random(seed);
  for (double exponent = -decades; exponent <= decades; exponent += 0.0017 * decades) {
    const P a = P::of([&](int) { return static_cast<Element<P>>(random(1, 10) * std::pow(10, exponent)); });
    const P r = word(a);
    for (int l = 0; l < width<P>; ++l)
      worst = std::max(
          worst,
          std::abs(static_cast<double>(lane_of(r, l)) / exact(static_cast<double>(lane_of(a, l))) - 1));
  }
  return worst;
}

template <class P>
constexpr bool in_single = std::is_same_v<Element<P>, float>;

}  // namespace

#define EVERY_PACK Doubles1, Doubles2, Doubles4, Floats1, Floats2, Floats4
#define EVERY_DOUBLE Doubles1, Doubles2, Doubles4

TEMPLATE_TEST_CASE("pack: arithmetic lane by lane", "", EVERY_PACK) {
  const TestType a = ramp<TestType>(1, 1), b = ramp<TestType>(-3, 2);  // small integers: exact
  require_lanes(a + b, [](int l) { return (1.0 + l) + (-3.0 + 2 * l); });
  require_lanes(a - b, [](int l) { return (1.0 + l) - (-3.0 + 2 * l); });
  require_lanes(a * b, [](int l) { return (1.0 + l) * (-3.0 + 2 * l); });
  require_lanes(-a, [](int l) { return -(1.0 + l); });
  require_lanes(2.5 * a + 1.0, [](int l) { return 2.5 * (1.0 + l) + 1; });
  require_lanes(rounded(a), [](int l) { return 1.0 + l; });
  TestType c = a;
  c += b;
  c *= TestType(2.0);
  c -= a;
  require_lanes(c, [](int l) { return 2 * ((1.0 + l) + (-3.0 + 2 * l)) - (1.0 + l); });
}

TEMPLATE_TEST_CASE("pack: quotients and roots", "", EVERY_PACK) {
  const TestType a = ramp<TestType>(1, 0.37), b = ramp<TestType>(0.3, 1.1);
  const TestType quotient = a / b, root_of_b = root(b);
  // Two roundings: -freciprocal-math may turn the quotient into a product.
  const double rounding = 2 * static_cast<double>(std::numeric_limits<Element<TestType>>::epsilon());
  for (int l = 0; l < width<TestType>; ++l) {
    CHECK(lane_of(quotient, l) == Approx(lane_of(a, l) / lane_of(b, l)).epsilon(rounding).margin(0));
    CHECK(lane_of(root_of_b, l) == Approx(std::sqrt(lane_of(b, l))).epsilon(rounding).margin(0));
  }
}

TEMPLATE_TEST_CASE("pack: a scalar fills every lane, also one that is not finite", "", EVERY_PACK) {
  require_lanes(TestType(-0.75), [](int) { return -0.75; });
  require_lanes(TestType(infinity), [](int) { return infinity; });
  const TestType lost(not_a_number);
  for (int l = 0; l < width<TestType>; ++l) CHECK(std::isnan(lane_of(lost, l)));
}

TEMPLATE_TEST_CASE("pack: smaller, larger, clamp", "", EVERY_PACK) {
  const TestType a = ramp<TestType>(-3, 1), b(0.5);
  require_lanes(smaller(a, b), [](int l) { return std::min(-3.0 + l, 0.5); });
  require_lanes(larger(a, b), [](int l) { return std::max(-3.0 + l, 0.5); });
  require_lanes(larger(a, TestType(0.0)), [](int l) { return std::max(-3.0 + l, 0.0); });
  require_lanes(clamp(a, TestType(-1.5), TestType(1.5)),
                [](int l) { return std::min(std::max(-3.0 + l, -1.5), 1.5); });
  require_lanes(larger(-a, TestType(0.0)), [](int l) { return std::max(3.0 - l, 0.0); });
}

TEMPLATE_TEST_CASE("pack: sizes, signs and the larger where a mask says so", "", EVERY_PACK) {
  const TestType a = ramp<TestType>(-3, 1), b = ramp<TestType>(1.5, -1);
  require_lanes(size_of(a), [](int l) { return std::abs(-3.0 + l); });
  require_lanes(turned_by(a, b), [](int l) { return 1.5 - l < 0 ? 3.0 - l : -3.0 + l; });
  require_lanes(larger_where(b < TestType(0.0), a, TestType(2.0)),
                [](int l) { return 1.5 - l < 0 ? std::max(-3.0 + l, 2.0) : -3.0 + l; });
}

TEMPLATE_TEST_CASE("pack: select, any and count follow the mask", "", EVERY_PACK) {
  const TestType a = ramp<TestType>(0, 1), b = ramp<TestType>(100, 1);
  const int n = width<TestType>;
  for (int k = 0; k <= n; ++k) {
    const auto below = a < TestType(static_cast<Element<TestType>>(k));  // the first k lanes
    require_lanes(select(below, a, b), [k](int l) { return l < k ? l : 100.0 + l; });
    CHECK(any(below) == (k > 0));
    CHECK(count(below) == k);
    CHECK(count(!below) == n - k);
    CHECK(count(below & !below) == 0);
    const auto first = a < TestType(1.0);
    CHECK(count(below & first) == (k > 0 ? 1 : 0));
    CHECK(count(below | first) == std::max(k, 1));
  }
  for (int k = 0; k < n; ++k) {  // any one lane is seen
    TestType one(0.0);
    set_lane(one, k, Element<TestType>(-1));
    CHECK(any(one < TestType(0.0)));
    CHECK(count(one < TestType(0.0)) == 1);
  }
  const TestType lost(not_a_number);
  CHECK_FALSE(any(lost < a));
  CHECK_FALSE(any(a < lost));
}

TEMPLATE_TEST_CASE("pack: largest and smallest lane", "", EVERY_PACK) {
  for (int k = 0; k < width<TestType>; ++k) {
    TestType a = ramp<TestType>(-1, 0.01);
    set_lane(a, k, Element<TestType>(7));
    CHECK(largest(a) == 7);
    set_lane(a, k, Element<TestType>(-7));
    CHECK(smallest(a) == -7);
  }
  CHECK(largest(TestType(-2.0)) == -2);
  CHECK(smallest(TestType(2.0)) == 2);
}

TEMPLATE_TEST_CASE("pack: reciprocal square root over the range of its numbers", "", EVERY_PACK) {
  // AVX-512: 14-bit estimate (relative error e <= 2^-14) and one third-order step, (5/2) e^3 = 5.7e-13 at
  // most; elsewhere a root and a quotient, three roundings. In single precision: 3/2 e^2 = 5.6e-9 and four
  // roundings of 6e-8.
  const double worst = worst_over<TestType>(
      in_single<TestType> ? 30 : 200, 1, [](const TestType& a) { return rsqrt(a); },
      [](double a) { return 1 / std::sqrt(a); });
  CHECK(worst < (in_single<TestType> ? 2.5e-7 : 1e-12));
}

TEMPLATE_TEST_CASE("pack: lengths of a pair, and of a particle with itself", "", EVERY_PACK) {
  const double bound = in_single<TestType> ? 3e-7 : 2e-12;  // of rsqrt, and two products
  const Vec<TestType, 2> x{ramp<TestType>(0.3, 0.1), ramp<TestType>(-2, 0.4)};
  const TestType factor = ramp<TestType>(0.5, 0.25);
  const auto apart = distance(x);
  const auto plain = length(apart), scaled = length(apart, factor);
  for (int l = 0; l < width<TestType>; ++l) {
    const double r = std::hypot(static_cast<double>(lane_of(x.x, l)), static_cast<double>(lane_of(x.y, l)));
    for (const auto& found : {plain, scaled}) {
      CHECK(lane_of(found.r, l) == Approx(r).epsilon(bound).margin(0));
      CHECK(lane_of(found.per_r, l) == Approx(1 / r).epsilon(bound).margin(0));
    }
    CHECK(lane_of(scaled.per_factor, l) == Approx(1 / (lane_of(factor, l) * r)).epsilon(bound).margin(0));
  }
  // The first product inside rsqrt is the square of its result, at any depth that occurs.
  for (const double depth : {1e-6, 1.0, 1e5}) {
    const auto self = length(distance(Vec<TestType, 2>{}), TestType(static_cast<Element<TestType>>(depth)));
    CHECK(std::isfinite(largest(self.per_factor)));
    CHECK(largest(self.per_factor) == Approx(1 / (depth * std::sqrt(least_square<TestType>))).epsilon(bound));
    CHECK(largest(self.r) == Approx(std::sqrt(least_square<TestType>)).epsilon(bound).margin(0));
  }
}

TEMPLATE_TEST_CASE("pack: halves, made and used lane by lane, to and from memory", "", EVERY_PACK) {
  constexpr int n = width<TestType>;
  using T = Element<TestType>;
  const TestType a = TestType::of([](int lane) { return static_cast<T>(3 * lane + 1); });
  require_lanes(a, [](int l) { return 3.0 * l + 1; });
  require_lanes(first_half(a), [](int l) { return 3.0 * l + 1; });
  require_lanes(second_half(a), [](int l) { return 3.0 * (l + n / 2) + 1; });
  require_lanes(join(second_half(a), first_half(a)), [](int l) { return 3.0 * ((l + n / 2) % n) + 1; });
  int seen = 0;
  for_each_lane(a, [&](int lane, T value) {
    CHECK(lane == seen++);
    CHECK(value == lane_of(a, lane));
  });
  CHECK(seen == n);
  T memory[n + 2] = {};
  store(memory + 1, a);
  for (int l = 0; l < n; ++l) CHECK(memory[1 + l] == lane_of(a, l));
  CHECK((memory[0] == 0 && memory[n + 1] == 0));
  require_lanes(loaded<TestType>(memory + 1), [](int l) { return 3.0 * l + 1; });
  TestType b = a;
  set_lane(b, n - 1, T(-5));
  CHECK(lane_of(b, n - 1) == -5);
  CHECK(lane_of(b, 0) == lane_of(a, 0));
}

TEMPLATE_TEST_CASE("pack: by registers a loop sees every lane once, in its place", "", EVERY_PACK) {
  const Vec<TestType, 2> a{ramp<TestType>(0, 1), ramp<TestType>(100, 1)};
  constexpr int registers = static_cast<int>(sizeof(TestType)) / Shape<TestType>::bytes;
  int calls = 0;
  const Vec<TestType, 2> b = by_register<TestType>(a, [&](const auto& some, int part) {
    CHECK(part == (registers == 1 ? 0 : 2 * calls / registers));  // the half of the lanes
    ++calls;
    return each([](const auto& x, const auto& y) { return x + y; }, some, some);
  });
  CHECK(calls == registers);
  require_lanes(b.x, [](int l) { return 2.0 * l; });
  require_lanes(b.y, [](int l) { return 200.0 + 2 * l; });
}

TEMPLATE_TEST_CASE("pack: whole numbers and look-ups", "", EVERY_DOUBLE) {
  const TestType a = ramp<TestType>(0.9, 1.2);
  const auto cut = to_index(a);
  require_lanes(to_real(cut), [](int l) { return std::floor(0.9 + 1.2 * l); });
  require_lanes(to_real(to_index(-a)), [](int l) { return -std::floor(0.9 + 1.2 * l); });  // towards zero
  double table[32];
  for (int k = 0; k < 32; ++k) table[k] = 1.5 * k * k;
  require_lanes(gather(table + 2, cut), [&](int l) { return table[2 + static_cast<int>(0.9 + 1.2 * l)]; });
  require_lanes(gather(table + 12, to_index(-a)),
                [&](int l) { return table[12 - static_cast<int>(0.9 + 1.2 * l)]; });
}

TEMPLATE_TEST_CASE("pack: between precisions and whole numbers of 16 bits", "", EVERY_DOUBLE) {
  constexpr int bytes = Shape<TestType>::bytes;
  const TestType a = ramp<TestType>(-7.25, 2.5);
  const pack<float, 8, bytes> single = convert<float>(a);
  require_lanes(single, [](int l) { return -7.25 + 2.5 * l; });
  require_lanes(convert<double>(single), [](int l) { return -7.25 + 2.5 * l; });
  require_lanes(join(single, single), [](int l) { return -7.25 + 2.5 * (l % 8); });
  const std::int16_t ends[] = {-32768, 32767, -1, 0, 1, 12345, -12345, 256};
  const auto shorts = loaded<pack<std::int16_t, 8, bytes>>(ends);
  const auto whole = convert<int>(shorts);
  require_lanes(to_real(whole), [&](int l) { return ends[l]; });
  require_lanes(convert<std::int16_t>(whole), [&](int l) { return ends[l]; });
}

TEMPLATE_TEST_CASE("pack: reciprocal cube root over sixty decades", "", EVERY_DOUBLE) {
  // The start is 8.2 % off; a Newton step leaves 2 e^2 of an error e, four of
  // them 1.4e-2, 3.6e-4, 2.6e-7, 1.9e-13.
  const double worst = worst_over<TestType>(
      30, 2, [](const TestType& a) { return inverse_cbrt(a); }, [](double a) { return 1 / std::cbrt(a); });
  CHECK(worst < 3e-13);
}
