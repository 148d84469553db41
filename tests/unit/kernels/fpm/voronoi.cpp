// Voronoi cells against all triples and all pairs of points, and the surfaces that they find.
#include <catch2/catch.hpp>

#include <functional>

#include "tests/support/points/fpm_points.hpp"

using namespace freshet;
using test::FlowPoints;

namespace {

constexpr double dx = 0.1;  // m

struct Triangle {
  double area, radius;  // m2, m
};

// Circumcentre of three points.
Point centre_of(const Point& a, const Point& b, const Point& c) {
  const double bx = b[0] - a[0], by = b[1] - a[1], cx = c[0] - a[0], cy = c[1] - a[1],
               twice = 2 * (bx * cy - by * cx);
  const double b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
  return {a[0] + (cy * b2 - by * c2) / twice, a[1] + (bx * c2 - cx * b2) / twice};
}

bool is_empty(const FlowPoints& s, const Point& centre, double radius2, std::initializer_list<int> but) {
  for (int k = 0; k < s.size(); ++k)
    if (std::find(but.begin(), but.end(), k) == but.end() && test::squared(s.at(k), centre) < radius2)
      return false;
  return true;
}

// Delaunay triangles by their definition: triples whose circumcircle is empty.
std::vector<Triangle> delaunay(const FlowPoints& s, double half) {
  std::vector<Triangle> all;
  for (int i = 0; i < s.size(); ++i)
    for (int j = i + 1; j < s.size(); ++j)
      for (int k = j + 1; k < s.size(); ++k) {
        const Point a = s.at(i), b = s.at(j), c = s.at(k), m = centre_of(a, b, c);
        const double r2 = test::squared(a, m);
        if (!(r2 < half * half) || !is_empty(s, m, r2, {i, j, k})) continue;
        all.push_back(
            {0.5 * std::abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])), std::sqrt(r2)});
      }
  return all;
}

// The same from the cells: each triangle as the smallest id of its corners sees it.
std::vector<Triangle> from_cells(const FlowPoints& s, double half) {
  std::vector<Triangle> all;
  const fpm::Cloud cloud = s.cloud();
  for (int i = 0; i < s.size(); ++i) {
    const fpm::PointCell c = fpm::cell_of(cloud, i, half);
    CHECK(c.complete);
    fpm::for_each_triangle(c, half, [&](int a, int b, double r2, int) {
      if (cloud.id(i) > cloud.id(c.around.j[a]) || cloud.id(i) > cloud.id(c.around.j[b])) return;
      const double area = 0.5 * (c.around.x[a] * c.around.y[b] - c.around.x[b] * c.around.y[a]);
      all.push_back({area, std::sqrt(r2)});
    });
  }
  return all;
}

std::vector<double> sorted_areas(const std::vector<Triangle>& all) {
  std::vector<double> areas;
  for (const Triangle& t : all) areas.push_back(t.area);
  std::sort(areas.begin(), areas.end());
  return areas;
}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

// Area of the convex hull (monotone chain).
double hull_area(std::vector<Point> points) {
  std::sort(points.begin(), points.end());
  double twice = 0;
  for (const int turn : {1, -1}) {
    std::vector<Point> chain;
    for (const Point& p : points) {
      const auto bends = [&] {
        const Point &a = chain[chain.size() - 2], &b = chain.back();
        return turn * ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])) <= 0;
      };
      while (chain.size() > 1 && bends()) chain.pop_back();
      chain.push_back(p);
    }
    for (std::size_t k = 0; k + 1 < chain.size(); ++k)
      twice += turn * (chain[k][0] * chain[k + 1][1] - chain[k + 1][0] * chain[k][1]);
  }
  return 0.5 * twice;
}

// The literal rule: a pair of points both of whose circles of radius r are looked at; one that is empty flags
// both. A point that no such pair holds is alone in the air.
std::vector<bool> flags_by_pairs(const FlowPoints& s, double r) {
  std::vector<bool> flagged(static_cast<std::size_t>(s.size())), paired = flagged;
  for (int i = 0; i < s.size(); ++i)
    for (int j = i + 1; j < s.size(); ++j) {
      const Point a = s.at(i), b = s.at(j);
      const double d2 = test::squared(a, b);
      if (d2 >= 4 * r * r || d2 == 0) continue;
      paired[static_cast<std::size_t>(i)] = paired[static_cast<std::size_t>(j)] = true;
      const double up = std::sqrt((r * r - 0.25 * d2) / d2);
      for (const double side : {up, -up}) {
        const Point m{0.5 * (a[0] + b[0]) - side * (b[1] - a[1]), 0.5 * (a[1] + b[1]) + side * (b[0] - a[0])};
        if (is_empty(s, m, r * r, {i, j}))
          flagged[static_cast<std::size_t>(i)] = flagged[static_cast<std::size_t>(j)] = true;
      }
    }
  for (std::size_t i = 0; i < flagged.size(); ++i) flagged[i] = flagged[i] || !paired[i];
  return flagged;
}

std::vector<Point> square_of(int nx, int ny) { return test::lattice(2, {0, nx, 0, ny}, dx); }

// Flags of points that `counts` selects.
int flagged_where(const FlowPoints& s, const std::vector<bool>& flags,
                  const std::function<bool(const Point&)>& counts) {
  int n = 0;
  for (int i = 0; i < s.size(); ++i) n += flags[static_cast<std::size_t>(i)] && counts(s.at(i));
  return n;
}

}  // namespace

TEST_CASE("voronoi: triangles of random clouds are those of the empty circumcircle") {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const FlowPoints s(test::random_points(2, 150, 0.6, seed), dx);
    const auto expected = sorted_areas(delaunay(s, 1.3 * dx)), found = sorted_areas(from_cells(s, 1.3 * dx));
    REQUIRE(found.size() == expected.size());
    REQUIRE(found.size() > 100);
    for (std::size_t k = 0; k < found.size(); ++k) CHECK(found[k] == Approx(expected[k]).epsilon(1e-9));
  }
}

TEST_CASE("voronoi: triangles of any size fill the hull") {
  for (const unsigned seed : {4u, 5u, 6u, 7u}) {
    const auto points = test::random_points(2, 60, 0.5, seed);
    const FlowPoints s(points, dx);
    CHECK(sum(sorted_areas(from_cells(s, 1e4 * dx))) ==
          Approx(hull_area(points)).epsilon(1e-9));  // slivers on the hull: R up to 1e3 m
  }
}

TEST_CASE("voronoi: cells of points in a box of walls fill the box") {
  const std::vector<Polyline> walls = {{{0, 0}, {0.9, 0}, {0.9, 0.7}, {0, 0.7}, {0, 0}}};
  test::Random random(8);
  std::vector<Point> points;
  for (int k = 0; k < 60; ++k) points.push_back({random(0, 0.9), random(0, 0.7)});
  const FlowPoints s(points, dx, walls);
  double area = 0;
  for (int i = 0; i < s.size(); ++i) area += fpm::cell_of(s.cloud(), i, 2.0).cell.area();
  CHECK(area == Approx(0.9 * 0.7).epsilon(1e-12));
}

TEST_CASE("voronoi: a point is on the surface iff one of the circles through it and another one is empty") {
  const std::vector<std::vector<Point>> clouds = {
      test::random_points(2, 250, 0.7, 11), test::random_points(2, 60, 0.7, 12),
      test::jittered(square_of(15, 15), 0.3 * dx, 13), test::jittered(square_of(20, 3), 0.45 * dx, 14),
      test::jittered(square_of(30, 1), 0.4 * dx, 15)};
  for (const auto& points : clouds)
    for (const double r : {0.9, 1.3, 1.8}) {
      FlowPoints s(points, dx);
      fpm::VoronoiRule rule;
      rule.surface = r;
      CHECK(s.flags(rule) == flags_by_pairs(s, r * dx));
    }
}

TEST_CASE("voronoi: lone points, pairs and points on one place are surface") {
  FlowPoints one({{0, 0}}, dx), two({{0, 0}, {0.5 * dx, 0}}, dx), same({{0, 0}, {0, 0}, {0, 0}}, dx),
      none({}, dx);
  for (FlowPoints* s : {&one, &two, &same, &none})
    CHECK(flagged_where(*s, s->flags(), [](const Point&) { return true; }) == s->size());
}

// At r = 1.3 dx (docs/formulas/fpm.md (F25)) none of the bulk is flagged and none of the surface missed, all
// three shapes.
TEST_CASE("voronoi: nothing in the bulk is flagged, nothing on the surface is missed") {
  for (const unsigned seed : {21u, 22u, 23u, 24u}) {
    FlowPoints s(test::jittered(square_of(60, 60), 0.3 * dx, seed), dx);
    const auto inside = [](const Point& p) {
      return p[0] > 2 * dx && p[0] < 58 * dx && p[1] > 2 * dx && p[1] < 58 * dx;
    };
    CHECK(flagged_where(s, s.flags(), inside) == 0);
  }
}

TEST_CASE("voronoi: flat and wavy surfaces, rough by up to a fifth of a spacing, are found whole") {
  struct Shape {
    double rough, amplitude;
  };
  for (const Shape shape : {Shape{0.1, 0}, Shape{0.2, 0}, Shape{0, 1}}) {
    auto points = square_of(80, 12);
    test::Random random(31);
    for (Point& p : points) {
      const double wave = shape.amplitude * dx * std::sin(2 * pi * p[0] / (8 * dx)) * p[1] / (12 * dx);
      p = {p[0], p[1] + wave + random(-shape.rough, shape.rough) * dx};
    }
    FlowPoints s(points, dx);
    const auto flags = s.flags();
    int missed = 0;
    for (int i = 0; i < s.size(); ++i)
      missed += s.fields.integer("id")(i) >= 80 * 11 && !flags[static_cast<std::size_t>(i)];
    INFO("roughness " << shape.rough << ", amplitude " << shape.amplitude);
    CHECK(missed == 0);
  }
}

TEST_CASE("voronoi: water in a tank has a surface on top only") {
  const std::vector<Polyline> walls = {{{0, 2}, {0, 0}, {2, 0}, {2, 2}}};
  std::vector<Point> points;
  for (int j = 0; j <= 10; ++j)
    for (int i = 0; i <= 20; ++i) points.push_back({i * dx, j * dx});
  FlowPoints s(points, dx, walls);
  const auto flags = s.flags();
  for (int i = 0; i < s.size(); ++i) {
    INFO(s.at(i)[0] << ", " << s.at(i)[1]);
    CHECK(flags[static_cast<std::size_t>(i)] == (s.at(i)[1] > 0.95));
  }
}

TEST_CASE("voronoi: across the sides of a periodic domain there is no surface") {
  FlowPoints s(test::jittered(square_of(12, 12), 0, 0), dx);
  s.period = {{0, 0}, {1.2, 1.2}};
  CHECK(flagged_where(s, s.flags(), [](const Point&) { return true; }) == 0);
}

TEST_CASE("voronoi: crowds that do not fit the buffers are reported") {
  auto points = test::random_points(2, 400, 0.3 * dx, 41);
  points.push_back({1.0 * dx, 0});
  FlowPoints s(points, dx);
  fpm::Voronoi voronoi({});
  const auto report = voronoi.find(s.cloud(), s.size(), s.fields.integer("surface"));
  CHECK(report.failed > 0);
  CHECK(report.failed < 401);
}
