// Pieces found by place against all pieces asked one by one.
#include "kernels/boundaries/walls/piece_bins.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "tests/support/points/cloud.hpp"

using namespace freshet;
using V2 = Vec<double, 2>;

namespace {

// Whether the segment has a point in the box: the part of it that lies between the box's sides along x and y
// is not empty.
bool touches(const Piece& s, const Box& box) {
  double from = 0, to = 1;
  const auto keep = [&](double a, double b, double low, double high) {
    if (a == b) return a >= low && a <= high;
    const double t0 = (low - a) / (b - a), t1 = (high - a) / (b - a);
    from = std::max(from, std::min(t0, t1));
    to = std::min(to, std::max(t0, t1));
    return true;
  };
  return keep(s.a.x, s.b.x, box.xlo, box.xhi) && keep(s.a.y, s.b.y, box.ylo, box.yhi) && from <= to;
}

std::vector<int> found(const PieceBins& bins, const Box& box) {
  std::vector<int> all;
  bins.for_each(box, [&](int k) { all.push_back(k); });
  return all;
}

std::vector<int> touching(const std::vector<Piece>& segments, const Box& box) {
  std::vector<int> all;
  for (std::size_t k = 0; k < segments.size(); ++k)
    if (touches(segments[k], box)) all.push_back(static_cast<int>(k));
  return all;
}

// Every segment that touches the box is found, once, in ascending order, and any() sees the same ones at
// least.
void check(const PieceBins& bins, const std::vector<Piece>& segments, const Box& box) {
  CAPTURE(box.xlo, box.xhi, box.ylo, box.yhi);
  const std::vector<int> seen = found(bins, box), near = touching(segments, box);
  REQUIRE(std::adjacent_find(seen.begin(), seen.end(), [](int a, int b) { return a >= b; }) == seen.end());
  REQUIRE(std::includes(seen.begin(), seen.end(), near.begin(), near.end()));
  for (const int k : near) REQUIRE(bins.any(box, [k](int other) { return other == k; }));
  REQUIRE_FALSE(bins.any(box, [](int) { return false; }));
}

// Chains with shared ends, free segments of all lengths, some along the axes, some of no length at all; far
// from the origin as maps are.
std::vector<Piece> mixed(int count, double size, double x0, unsigned seed) {
  test::Random random(seed);
  std::vector<Piece> all;
  V2 end{x0, x0};
  for (int k = 0; k < count; ++k) {
    const double reach = size * std::pow(10.0, random(-3, 0));
    Piece s{{x0 + random(0, size), x0 + random(0, size)}, {}};
    if (k % 2 == 1) s.a = end;
    s.b.x = k % 7 == 0 ? s.a.x : s.a.x + random(-reach, reach);
    s.b.y = k % 5 == 0 ? s.a.y : s.a.y + random(-reach, reach);
    end = s.b;
    all.push_back(s);
  }
  return all;
}

// A closed, wavy coast of so many sides round the origin.
std::vector<Piece> coast(int sides) {
  const auto at = [&](int k) {
    const double angle = 2 * pi * (k % sides) / sides, r = 1000 * (1 + 0.1 * std::sin(17 * angle));
    return V2{r * std::cos(angle), r * std::sin(angle)};
  };
  std::vector<Piece> all;
  for (int k = 0; k < sides; ++k) all.push_back({at(k), at(k + 1)});
  return all;
}

}  // namespace

TEST_CASE("piece bins: boxes of all sizes find what asking all segments finds") {
  const double x0 = GENERATE(0.0, -3.0, 5e5), size = 10, finest = GENERATE(0.0, 0.3, 4.0, 1e3);
  const int count = GENERATE(1, 3, 40, 400);
  CAPTURE(x0, finest, count);
  const auto segments = mixed(count, size, x0, 7u + static_cast<unsigned>(count));
  const PieceBins bins(segments, finest);
  REQUIRE(bins.size() == count);
  test::Random random(5);
  for (int n = 0; n < 300; ++n) {
    const V2 p{x0 + random(-1.5 * size, 2.5 * size), x0 + random(-1.5 * size, 2.5 * size)};
    check(bins, segments, box_around(p, size * std::pow(10.0, random(-4, 0.3))));
    const V2 q{x0 + random(0, size), x0 + random(0, size)};
    check(bins, segments, box_between(p, q));
  }
}

TEST_CASE("piece bins: boxes of no size on ends and middles of segments find them") {
  const double x0 = GENERATE(0.0, 5e5);
  const auto segments = mixed(200, 10, x0, 3);
  const PieceBins bins(segments);
  for (std::size_t k = 0; k < segments.size(); ++k)
    for (const double t : {0.0, 0.5, 1.0}) {
      const Piece& s = segments[k];
      const V2 p = s.a + t * (s.b - s.a);
      const auto seen = found(bins, box_around(p, 0));
      CAPTURE(k, t);
      REQUIRE(std::count(seen.begin(), seen.end(), static_cast<int>(k)) == 1);
    }
}

TEST_CASE("piece bins: one place, one line, no segments, places that are no numbers") {
  const double nan = std::nan("");
  const PieceBins none, point({{{2, 3}, {2, 3}}, {{2, 3}, {2, 3}}});
  const PieceBins level({{{0, 1}, {4, 1}}, {{4, 1}, {9, 1}}});
  CHECK(found(none, {-1e300, 1e300, -1e300, 1e300}).empty());
  CHECK_FALSE(none.any({-1, 1, -1, 1}, [](int) { return true; }));
  CHECK(found(point, box_around(V2{2.1, 3.1}, 0.2)) == std::vector<int>{0, 1});
  CHECK(found(point, box_around(V2{2.1, 3.1}, 0.05)).empty());
  CHECK(found(level, {-1e300, 1e300, -1e300, 1e300}) == std::vector<int>{0, 1});
  CHECK(found(level, box_around(V2{4, 1}, 0)) == std::vector<int>{0, 1});
  CHECK(found(level, {0, 9, 1.5, 2}).empty());
  CHECK(found(level, box_around(V2{nan, 1}, 1)).empty());
  CHECK(found(level, box_around(V2{1, nan}, 1)).empty());
  // 1-D: walls are points at y = 0.
  const PieceBins ends({{{-1, 0}, {-1, 0}}, {{5, 0}, {5, 0}}}, 4);
  CHECK(found(ends, box_around(Vec<double, 1>{4.9}, 0.2)) == std::vector<int>{1});
  CHECK(found(ends, box_between(Vec<double, 1>{-2}, Vec<double, 1>{6})) == std::vector<int>{0, 1});
}

TEST_CASE("piece bins: a query costs what is near, however many sides a coast has") {
  double shown[2] = {0, 0};
  const int sides[2] = {1000, 100000};
  for (int n = 0; n < 2; ++n) {
    const auto segments = coast(sides[n]);
    // As wide as a side of the coast, 7 m and 0.07 m: so many sides are really near a place on it.
    const double reach = 7000.0 / sides[n];
    const PieceBins bins(segments, 2 * reach);
    for (std::size_t k = 0; k < segments.size(); k += segments.size() / 500) {
      const V2 p = segments[k].a;
      shown[n] += static_cast<double>(found(bins, box_around(p, reach)).size()) / 500;
      REQUIRE(found(bins, box_around(0.5 * p, reach)).empty());
    }
  }
  CAPTURE(shown[0], shown[1]);
  // Cells are about sqrt(area / 16 sides) wide at least, which grows as sqrt(sides) against a side's length:
  // by 10 here.
  CHECK(shown[0] < 20);
  CHECK(shown[1] < 12 * shown[0]);
}
