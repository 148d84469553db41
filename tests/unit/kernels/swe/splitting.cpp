// Splitting: the optimal shares of the mass, the density that a split leaves, where daughters come to lie,
// regions.
#include <catch2/catch.hpp>

#include <limits>
#include <map>

#include "kernels/swe/split/refinement.hpp"
#include "kernels/water/ids.hpp"
#include "tests/support/points/cloud.hpp"

using namespace freshet;
using test::Cloud;
using test::Grain;

namespace {

constexpr double turned = pi / 12, huge = 1e300;

swe::SplitOptions split_all(const swe::SplitPattern& pattern, double alpha, double area = 1e-9) {
  return {pattern, PlacedValue(area, {}), alpha, false, 0, 1 << 30};
}

template <int D>
int split(Cloud<D>& cloud, const swe::SplitOptions& options) {
  swe::Refinement<D> refinement(options, {}, {1.2, 9.81, 1, 1e300});
  int next_id = cloud.fields.size();
  return refinement.split(
      cloud.fields, [&] { return cloud.bind(); }, {}, cloud.wall_view(), next_id);
}

// sum_j m_j W(x - x_j, h), h of the neighbours (scatter) or one for all (gather).
double density_at(const swe::Particles<2>& p, int n, int i, bool scatter) {
  double sum = 0;
  for (int j = 0; j < n; ++j) {
    const double h = p.h(scatter ? j : i);
    sum += p.m(j) * test::printed_w(2, std::hypot(p.x.x(i) - p.x.x(j), p.x.y(i) - p.x.y(j)) / h) / (h * h);
  }
  return sum;
}

}  // namespace

TEST_CASE("splitting: shares and errors of Table 3.1, to the digits of an independent computation") {
  // Vacondio 2010, Table 3.1 prints three digits of these.
  struct Row {
    double alpha, eps, error, middle, corner;
  };
  const Row row = GENERATE(Row{.9, .4, 1.759e-5, .178706, .136882}, Row{.9, .5, 3.800e-5, .447581, .092070},
                           Row{.6, .6, 2.407e-3, .120257, .146624}, Row{.8, .6, 3.309e-5, .323881, .112687},
                           Row{.85, .45, 6.89e-6, .098946, .150176}, Row{.8, .5, 7.59e-6, .096975, .150504});
  CAPTURE(row.alpha, row.eps);
  const auto pattern = swe::split_pattern<2>(7, row.alpha, row.eps, 0);
  REQUIRE(pattern.daughters.size() == 7);
  CHECK(pattern.daughters[0].share == Approx(row.middle).margin(5.1e-7));
  for (std::size_t k = 1; k < 7; ++k) CHECK(pattern.daughters[k].share == Approx(row.corner).margin(5.1e-7));
  CHECK(pattern.error == Approx(row.error).epsilon(row.error < 1e-5 ? 1e-3 : 3e-4));
}

TEST_CASE("splitting: integrals of kernel products are exact") {
  CHECK(swe::kernel_product<2>(1, 1, 0) == Approx(0.238964).margin(5e-7));  // the constant C of (3.7)
  CHECK(swe::kernel_product<2>(1, 0.7, 0.8) == Approx(swe::kernel_product<2>(0.7, 1, 0.8)).epsilon(1e-10));
  CHECK(swe::kernel_product<2>(0.6, 0.6, 2.41) == 0);
  // W * W * 1 = 1: the product integrated over the distance, by the trapezium rule (both ends flat: it
  // converges fast).
  double line = 0, plane = 0;
  const double step = 0.02;
  for (int k = 0; k < 200; ++k) {
    line += (k > 0 ? 2 : 1) * step * swe::kernel_product<1>(1, 0.8, k * step);
    plane += 2 * pi * k * step * step * swe::kernel_product<2>(1, 0.8, k * step);
  }
  CHECK(line == Approx(1).epsilon(1e-6));
  CHECK(plane == Approx(1).epsilon(1e-4));
}

TEST_CASE("splitting: shares are never negative, and a daughter without mass is left out") {
  const auto pattern = swe::split_pattern<2>(7, 0.9, 0.35, 0);  // the free optimum has a negative middle
  REQUIRE(pattern.daughters.size() == 6);
  for (const auto& d : pattern.daughters) CHECK(d.share == Approx(1.0 / 6));
}

TEST_CASE("splitting: in one dimension the shares minimise the error") {
  // The functional by brute force: midpoints of 4000 cells.
  const double alpha = 0.8, eps = 0.5;
  const auto error = [&](double s) {
    double sum = 0;
    const double dx = 6.0 / 4000;
    for (int k = 0; k < 4000; ++k) {
      const double x = -3 + (k + 0.5) * dx;
      const auto w = [&](double at, double h) { return test::printed_w(1, std::abs(x - at) / h) / h; };
      const double e = w(0, 1) - (1 - s) * w(0, alpha) - 0.5 * s * (w(eps, alpha) + w(-eps, alpha));
      sum += e * e * dx;
    }
    return sum;
  };
  const auto pattern = swe::split_pattern<1>(3, alpha, eps, 0);
  REQUIRE(pattern.daughters.size() == 3);
  const double s = 1 - pattern.daughters[0].share;
  CHECK(pattern.error == Approx(error(s)).epsilon(1e-5));
  CHECK(error(s) < error(s + 1e-3));
  CHECK(error(s) < error(s - 1e-3));
  const auto pair = swe::split_pattern<1>(2, alpha, 0.3, 0);
  REQUIRE(pair.daughters.size() == 2);
  CHECK(pair.daughters[0].share == 0.5);
  CHECK(pair.daughters[0].x[0] == -pair.daughters[1].x[0]);
}

TEST_CASE("splitting: the density that is left, scatter and gather") {
  // Vacondio 2010, 3.3.1: 11 x 11 parents at 50 m in a larger lattice, h = 60 m, depth 10 m. Printed: scatter
  // 0.3 %, gather 5 %; an independent computation: scatter 0.41 %, gather 5.39 % with h fixed and 5.15 %
  // after Newton.
  const double dx = 50, depth = 10;
  Cloud<2> cloud(test::still_water(2, test::lattice(2, {-14, 15, -14, 15}, dx), dx, depth, 1.2), dx);
  const double low = -5 * dx, high = 6 * dx;
  swe::SplitOptions options = split_all(swe::split_pattern<2>(7, 0.9, 0.4, 0), 0.9);
  options.area = PlacedValue(huge, {{{{low, low}, {high, low}, {high, high}, {low, high}}, 0.9 * dx * dx}});
  for (int i = 0; i < cloud.fields.size(); ++i) cloud.bind().h(i) = 1.2 * dx;
  REQUIRE(split(cloud, options) == 121);
  REQUIRE(cloud.fields.size() == 29 * 29 + 6 * 121);
  swe::Particles<2> p = cloud.bind();
  const int n = cloud.fields.size();
  const auto whole = [&](int i) {
    return std::abs(p.x.x(i) - 25) < 11 * dx && std::abs(p.x.y(i) - 25) < 11 * dx;
  };
  double scatter = 0, gather = 0, newton = 0;
  for (int i = 0; i < n; ++i) {
    if (!whole(i)) continue;
    scatter = std::max(scatter, std::abs(density_at(p, n, i, true) / depth - 1));
    gather = std::max(gather, std::abs(density_at(p, n, i, false) / depth - 1));
  }
  cloud.solve(test::tight(2));
  p = cloud.bind();
  for (int i = 0; i < n; ++i)
    if (whole(i)) newton = std::max(newton, std::abs(p.rho(i) / depth - 1));
  CHECK(scatter == Approx(0.0041).margin(0.00005));
  CHECK(gather == Approx(0.0539).margin(0.00005));
  CHECK(newton == Approx(0.0515).margin(0.00005));
}

TEST_CASE("splitting: no daughter lies on top of another, on a square and on a hexagonal lattice") {
  const double dx = 1, h = 1.2 * dx, fine = dx / std::sqrt(7.0);
  const auto pattern = swe::split_pattern<2>(7, 0.92, 0.36, turned);
  const bool square = GENERATE(true, false);
  double nearest = huge;
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j)
      for (std::size_t k = 0; k < 7; ++k)
        for (std::size_t l = 0; l < 7; ++l) {
          if (i == 0 && j == 0 && k == l) continue;
          const auto *a = pattern.daughters[k].x, *b = pattern.daughters[l].x;
          const double x = square ? i : i + 0.5 * j, y = square ? j : j * std::sqrt(0.75);
          nearest = std::min(nearest, std::hypot(x * dx + h * (b[0] - a[0]), y * dx + h * (b[1] - a[1])));
        }
  CHECK(nearest > 0.6 * fine);  // 0.1 dx with the corners along the axes of the square
}

TEST_CASE("splitting: a daughter has alpha times its parent's h and, summed alone, its parent's depth") {
  Cloud<2> cloud({Grain{{3, 4}, {1, 2}, 5.0, 2.0, 1.5}}, 1.0);
  const auto parent = cloud.bind();
  parent.h(0) = 1.7;
  const double depth = parent.rho(0);
  REQUIRE(split(cloud, split_all(swe::split_pattern<2>(7, 0.9, 0.4, turned), 0.9, 2.0)) == 1);
  const auto p = cloud.bind();
  REQUIRE(cloud.fields.size() == 7);
  for (int i = 0; i < 7; ++i) {
    CHECK(p.h(i) == Approx(0.9 * 1.7));
    CHECK(p.h0(i) == p.h(i));
    CHECK(swe::smoothing_length<2>(p.kh(i), depth) == Approx(p.h(i)));
    CHECK(p.id(i) == i);
    CHECK(p.v.x(i) == 1);
    CHECK(p.v_pred.y(i) == 2);
    CHECK(std::hypot(p.x.x(i) - 3, p.x.y(i) - 4) == Approx(i == 0 ? 0 : 0.4 * 1.7).margin(1e-15));
  }
}

TEST_CASE("splitting: only what covers the area, is deep enough, is fluid and fits is split") {
  const double dx = 0.1;
  const auto water = test::still_water(2, test::lattice(2, {0, 4, 0, 4}, dx), dx, 0.3, 1.2);
  const auto pattern = swe::split_pattern<2>(7, 0.92, 0.36, turned);
  const auto count = [&](const swe::SplitOptions& options, const Field<int>& kind) {
    Cloud<2> cloud(water, dx);
    swe::Refinement<2> refinement(options, {}, {1.2, 9.81, 1, 1e300});
    int next_id = 16;
    const int splits = refinement.split(
        cloud.fields, [&] { return cloud.bind(); }, kind, {}, next_id);
    CHECK(next_id == 16 + 6 * splits);
    return splits;
  };
  swe::SplitOptions options = split_all(pattern, 0.92, 0.99 * dx * dx);
  CHECK(count(options, {}) == 16);
  CHECK(count(split_all(pattern, 0.92, 1.01 * dx * dx), {}) == 0);
  Field<int> kind("kind", 16);
  for (int i = 0; i < 5; ++i) kind(i) = 1;
  CHECK(count(options, kind) == 11);
  options.most_particles = 16 * 7 - 1;
  CHECK(count(options, {}) == 0);
  options.most_particles = 16 * 7;
  CHECK(count(options, {}) == 16);
  options.least_depth = 0.31;
  CHECK(count(options, {}) == 0);
}

TEST_CASE("splitting: daughters are numbered by their parents, not by where these stand in memory") {
  const int n = 40;
  test::Random random(9);
  std::vector<Grain> grains;
  for (int i = 0; i < n; ++i)  // every third is too small to be split
    grains.push_back({{random(-1, 1), random(-1, 1)}, {0, 0}, i % 3 == 0 ? 0.5 : 2.0, 1.0, 0.12});
  const auto options = split_all(swe::split_pattern<2>(7, 0.9, 0.4, 0), 0.9, 1.0);
  const auto places = [&](const std::vector<int>& order) {  // of each id
    std::vector<Grain> stored;
    for (const int k : order) stored.push_back(grains[static_cast<std::size_t>(k)]);
    Cloud<2> cloud(stored, 0.1);
    const Field<int> id = cloud.fields.integer("id");
    for (int i = 0; i < n; ++i) id(i) = order[static_cast<std::size_t>(i)];
    CHECK(split(cloud, options) == 26);
    std::map<int, Point> at;
    const swe::Particles<2> p = cloud.bind();
    for (int i = 0; i < cloud.fields.size(); ++i) at[p.id(i)] = {p.x.x(i), p.x.y(i)};
    return at;
  };
  const auto straight = places(test::numbers(n));
  CHECK(straight.size() == 40 + 26 * 6);
  CHECK(straight.rbegin()->first == 40 + 26 * 6 - 1);
  for (const unsigned seed : {1u, 2u}) CHECK((places(test::shuffled(test::numbers(n), seed)) == straight));
}

TEST_CASE("splitting: ids that run out are an error that says so") {
  constexpr int most = std::numeric_limits<int>::max();
  int next = most - 10;
  CHECK(take_ids(next, 10) == most - 10);
  CHECK(next == most);
  CHECK_THROWS_WITH(take_ids(next, 1), Catch::Contains("2147483647 particles"));
  CHECK(next == most);  // none is taken
}

TEST_CASE("splitting: daughters stay before the walls") {
  const double dx = 0.1;
  Cloud<2> cloud(test::random_water(2, 200, dx, 3), dx);
  const double half = 0.5 * dx * std::sqrt(200.0);
  cloud.add_walls({{{-half, -half}, {half, -half}, {half, half}, {-half, half}, {-half, -half}}}, {0, 0});
  for (int i = 0; i < 200; ++i) cloud.bind().h(i) = 1.2 * dx;
  const auto inside = [&] {
    int count = 0;
    for (int i = 0; i < cloud.fields.size(); ++i)
      count += std::abs(cloud.bind().x.x(i)) <= half && std::abs(cloud.bind().x.y(i)) <= half;
    return count;
  };
  Cloud<2> open = cloud;
  open.walls.reset();
  open.fields = FieldSet(cloud.fields);
  REQUIRE(split(cloud, split_all(swe::split_pattern<2>(7, 0.92, 0.36, turned), 0.92)) == 200);
  CHECK(inside() == 1400);
}

TEST_CASE("splitting: regions hold their places, the first of them counts") {
  const PlacedValue limit(
      5, {{{{0, 0}, {2, 0}, {2, 2}, {1, 1}, {0, 2}}, 1}, {{{-1, -1}, {3, -1}, {3, 3}, {-1, 3}}, 2}});
  CHECK(limit(Vec<double, 2>{0.5, 0.5}) == 1);
  CHECK(limit(Vec<double, 2>{1, 1.5}) == 2);  // in the notch
  CHECK(limit(Vec<double, 2>{2.5, 0.5}) == 2);
  CHECK(limit(Vec<double, 2>{3.5, 0.5}) == 5);
  const PlacedValue line(7, {{{{4, 0}, {2, 0}}, 1}});
  CHECK(line(Vec<double, 1>{3}) == 1);
  CHECK(line(Vec<double, 1>{1.9}) == 7);
  CHECK(line(Vec<double, 1>{4.1}) == 7);
}
