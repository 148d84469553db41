// Sums of particles: the same bits in any order, and as near as doubles get.
#include "cellgrid/particles/sums.hpp"

#include <catch2/catch.hpp>

#include <limits>
#include <numeric>

#include "tests/support/points/cloud.hpp"

using namespace freshet;

namespace {

Field<double> field(const std::vector<double>& values) {
  Field<double> f("test.terms", values.size() + lanes);
  for (std::size_t i = 0; i < values.size(); ++i) f(i) = values[i];
  return f;
}

double sum(const std::vector<double>& values) {
  const Field<double> f = field(values);
  return sum_of_values("test::sum", static_cast<int>(values.size()), f);
}

std::vector<double> shuffled(const std::vector<double>& values, unsigned seed) {
  std::vector<double> other;
  for (const int k : test::shuffled(test::numbers(static_cast<int>(values.size())), seed))
    other.push_back(values[static_cast<std::size_t>(k)]);
  return other;
}

// Of both signs, over many orders of magnitude: sums of doubles in another order differ.
std::vector<double> wild(int n, double decades, unsigned seed) {
  test::Random random(seed);
  std::vector<double> values;
  for (int i = 0; i < n; ++i) values.push_back(random(-1, 1) * std::pow(10.0, random(-decades, decades)));
  return values;
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

}  // namespace

TEST_CASE("sums: a shuffled array gives the same bits") {
  const int n = GENERATE(1, 7, 8, 9, 511, 513, 4097, 100003);
  const double decades = GENERATE(0.0, 3.0, 12.0, 100.0);
  CAPTURE(n, decades);
  const std::vector<double> values = wild(n, decades, 3);
  const double expected = sum(values);
  int differ = 0, plain_differ = 0;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const std::vector<double> other = shuffled(values, seed);
    differ += !same_bits(sum(other), expected);
    plain_differ += std::accumulate(other.begin(), other.end(), 0.0) !=
                    std::accumulate(values.begin(), values.end(), 0.0);
  }
  CHECK(differ == 0);
  if (n > 500) CHECK(plain_differ > 0);  // the test does look at something
}

TEST_CASE(
    "sums: what a term adds does not depend on who stands beside it, on the rows of slices, on the largest's "
    "place") {
  // The largest term comes early, late, or alone in its slice; every place asks the sum to begin anew at
  // another moment.
  std::vector<double> values = wild(3000, 2.0, 11);
  values.push_back(3e19);
  const double expected = sum(values);
  for (const std::size_t at : {0u, 1u, 7u, 8u, 63u, 511u, 512u, 2999u}) {
    std::vector<double> other = values;
    std::swap(other[at], other.back());
    CHECK(same_bits(sum(other), expected));
  }
}

TEST_CASE("sums: terms 2^64 smaller than the largest count alike before it and after it") {
  const double big = 0x1p96,
               small = 4e9;  // small lies in the upper half of what the third part below big's holds
  const std::vector<double> alone{sum({small, big, -big}), sum({big, small, -big}), sum({big, -big, small})};
  // One a slice: in slices of eight the largest of them decides at once.
  std::vector<double> apart(3 * 8, 0.0), turned(3 * 8, 0.0);
  apart[0] = small, apart[8] = big, apart[16] = -big;
  turned[0] = big, turned[8] = small, turned[16] = -big;
  CHECK(same_bits(sum(apart), sum(turned)));
  for (const double s : alone) CHECK(same_bits(s, sum(apart)));
  // Many of them, each half a unit of what is kept, and one large: first, in the middle, last.
  std::vector<double> values(100000, 1.5 * 0x1p-65);
  values[0] = 1;
  const double expected = sum(values);
  for (const std::size_t at : {1u, 700u, 50000u, 99999u}) {
    std::vector<double> other = values;
    std::swap(other[0], other[at]);
    CHECK(same_bits(sum(other), expected));
  }
}

TEST_CASE("sums: products are terms of their own, whole slices and the last one alike") {
  // In lanes beside each other a and b swapped: contracted into multiply-adds, a b would leave another rest
  // in a slice that is not full.
  for (const int n : {5, 8, 13, 1000, 1003}) {
    const std::vector<double> a = wild(n, 5, 21), b = wild(n, 5, 22);
    std::vector<double> products;
    for (int i = 0; i < n; ++i)
      products.push_back(a[static_cast<std::size_t>(i)] * b[static_cast<std::size_t>(i)]);
    const Field<double> fa = field(a), fb = field(b);
    const double together = sum_of_particles<1>(
        "test::dot", n,
        KOKKOS_LAMBDA(const Lanes& me) { return LaneAddends<1>{{me.load(fa) * me.load(fb)}}; })[0];
    const double apart = sum_of_particles<1>(
        "test::dot", n, KOKKOS_LAMBDA(int i) { return Addends<1>{{fa(i) * fb(i)}}; })[0];
    CHECK(same_bits(together, sum(products)));
    CHECK(same_bits(apart, sum(products)));
  }
}

TEST_CASE("sums: as near to the true sum as a double is") {
  const double decades = GENERATE(0.0, 3.0, 8.0);
  const std::vector<double> values = wild(50000, decades, 5);
  // The true sum by doubles that carry their errors (Neumaier): to 1e-16 of the result and n 1e-32 of the
  // sizes.
  double s = 0, c = 0, size = 0;
  for (const double v : values) {
    const double t = s + v;
    c += std::abs(s) >= std::abs(v) ? (s - t) + v : (v - t) + s;
    s = t, size = std::max(size, std::abs(v));
  }
  // Each term is cut by 2^-64 of the largest at most; the result is rounded twice.
  CHECK(sum(values) == Approx(s + c).epsilon(4 * 0x1p-53).margin(50000 * size * 0x1p-64));
}

TEST_CASE("sums: exact where doubles are not") {
  std::vector<double> values(3000, 1.0);
  values[100] = 1e16;
  values[2000] = -1e16;
  CHECK(sum(values) == 2998.0);  // from left to right 1e16 + 1 = 1e16: 999 ones and more are lost
  CHECK(sum(std::vector<double>(1000, 0.1)) == Approx(100).epsilon(1e-16));
  CHECK(sum({}) == 0.0);
  CHECK(sum({0.0, -0.0, 0.0}) == 0.0);
  CHECK(sum({-5.0, 2.0}) == -3.0);
  CHECK(sum({1e-200, 3e-200}) == Approx(4e-200).epsilon(1e-15));
  CHECK(sum({1e280, -0.5e280}) == Approx(0.5e280).epsilon(1e-15));
}

TEST_CASE("sums: what is not finite is seen, whatever else there is") {
  const double infinite = std::numeric_limits<double>::infinity(),
               nan = std::numeric_limits<double>::quiet_NaN();
  const std::size_t at = GENERATE(0u, 5u, 600u, 999u);
  std::vector<double> values = wild(1000, 1, 7);
  values[at] = nan;
  CHECK(std::isnan(sum(values)));
  values[at] = infinite;
  CHECK(sum(values) == infinite);
  values[at] = -infinite;
  CHECK(sum(values) == -infinite);
  values[(at + 17) % 1000] = infinite;
  CHECK(std::isnan(sum(values)));
}

TEST_CASE("sums: several at once are the same as each alone") {
  const int n = 1013;
  const std::vector<double> a = wild(n, 1, 31), b = wild(n, 9, 32), c = wild(n, 20, 33);
  const Field<double> fa = field(a), fb = field(b), fc = field(c);
  const auto all = sum_of_particles<3>(
      "test::three", n, KOKKOS_LAMBDA(int i) {
        return Addends<3>{{fa(i), fb(i), fc(i)}};
      });
  CHECK(same_bits(all[0], sum(a)));
  CHECK(same_bits(all[1], sum(b)));
  CHECK(same_bits(all[2], sum(c)));
}
