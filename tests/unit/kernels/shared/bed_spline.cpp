// The tabulated bed: a cubic spline through its bottom particles.
#include "kernels/ground/bed_spline.hpp"

#include <catch2/catch.hpp>

#include "tests/support/points/cloud.hpp"

using namespace freshet;

namespace {

constexpr double dx = 0.25;  // m
constexpr double low = -5, high = 5;

template <int D>
BedSpline<D> spline(const std::function<double(double, double)>& level, double filter = 0) {
  return BedSpline<D>(level, {{low, low}, {high, high}, dx, filter});
}

Vec<double, 1> at_1d(double x) { return {x}; }
Vec<double, 2> at_2d(double x, double y) { return {x, y}; }

// A bicubic polynomial: every product of powers up to three.
struct Bicubic {
  double c[4][4];
  explicit Bicubic(unsigned seed) {
    test::Random random(seed);
    for (auto& row : c)
      for (double& value : row) value = random(-1, 1);
  }
  // d^p/dx^p d^q/dy^q
  double derivative(int p, int q, double x, double y) const {
    double sum = 0;
    for (int i = p; i < 4; ++i)
      for (int j = q; j < 4; ++j)
        sum += c[i][j] * falling(i, p) * falling(j, q) * std::pow(x, i - p) * std::pow(y, j - q);
    return sum;
  }
  static double falling(int n, int k) { return k == 0 ? 1 : n * falling(n - 1, k - 1); }
};

double worst(const BedPoint<double, 2>& p, const Bicubic& b, double x, double y) {
  return std::max({std::abs(p.b - b.derivative(0, 0, x, y)), std::abs(p.slope.x - b.derivative(1, 0, x, y)),
                   std::abs(p.slope.y - b.derivative(0, 1, x, y)),
                   std::abs(p.curvature.xx - b.derivative(2, 0, x, y)),
                   std::abs(p.curvature.xy - b.derivative(1, 1, x, y)),
                   std::abs(p.curvature.yy - b.derivative(0, 2, x, y))});
}

}  // namespace

TEST_CASE("bed: cubic polynomials come back with slope and curvature, in one dimension") {
  const auto bed = spline<1>([](double x, double) { return 1 - 2 * x + 0.5 * x * x + 0.3 * x * x * x; });
  test::Random random(1);
  for (int k = 0; k < 100; ++k) {
    // The ends' condition (below) misses a curvature of 15 1/m; 18 nodes further in 0.268^18 = 5e-11 of it is
    // left.
    const double x = random(-3.5, 3.5);
    const auto p = bed.at(at_1d(x));
    CHECK(p.b == Approx(1 - 2 * x + 0.5 * x * x + 0.3 * x * x * x).margin(1e-9));
    CHECK(p.slope.x == Approx(-2 + x + 0.9 * x * x).margin(1e-9));
    CHECK(p.curvature.xx == Approx(1 + 1.8 * x).margin(1e-8));
  }
}

TEST_CASE("bed: bicubic polynomials come back with slope and curvature, in two dimensions") {
  const Bicubic polynomial(2);
  const auto bed = spline<2>([&](double x, double y) { return polynomial.derivative(0, 0, x, y); });
  test::Random random(3);
  double inside = 0, rim = 0;
  for (int k = 0; k < 200; ++k) {
    const double x = random(-3, 3), y = random(-3, 3), along = random(low, high);
    inside = std::max(inside, worst(bed.at(at_2d(x, y)), polynomial, x, y));
    rim = std::max(rim, worst(bed.at(at_2d(along, high)), polynomial, along, high));
  }
  // The ends' condition (no second difference of the coefficients there) misses b'' = 6 x 8 x 8^3 = 2.5e4 1/m
  // in curvature, and the miss falls by 0.268 from node to node: 1.4e-7 of it after 12 nodes, 3.6e-12
  // after 20.
  CHECK(inside < 1e-7);
  CHECK(rim < 4e-3);
}

TEST_CASE("bed: packs give what scalars give, also beyond the lattice") {
  const auto bed = spline<2>([](double x, double y) { return std::sin(3 * x) * std::cos(2 * y); });
  test::Random random(5);
  for (int n = 0; n < 20; ++n) {
    Vec<Lane, 2> x;  // the lattice ends at 8 m
    for (int l = 0; l < lanes; ++l) set_lane(x.x, l, random(-8.5, 8.5)), set_lane(x.y, l, random(-8.5, 8.5));
    const auto packed = bed.at(x);
    for (int l = 0; l < lanes; ++l) {
      const auto p = bed.at(at_2d(lane_of(x.x, l), lane_of(x.y, l)));
      CHECK(std::isfinite(p.b));
      // Sixteen terms added in another order; beyond the lattice the cubic's weights reach 100.
      CHECK(lane_of(packed.b, l) == Approx(p.b).margin(1e-12));
      CHECK(lane_of(packed.slope.y, l) == Approx(p.slope.y).margin(1e-12 / dx));
      CHECK(lane_of(packed.curvature.xx, l) == Approx(p.curvature.xx).margin(1e-12 / (dx * dx)));
    }
  }
}

TEST_CASE("bed: a plane is exact everywhere, to the rim and beyond") {
  const auto bed = spline<2>([](double x, double y) { return 0.1 * x - 0.3 * y + 2; });
  for (const double x : {-7.0, low, -1.3, 0.0, high, 7.5}) {
    const auto p = bed.at(at_2d(x, 0.7 * x));
    CHECK(p.b == Approx(0.1 * x - 0.21 * x + 2).margin(1e-13));
    CHECK(p.slope.x == Approx(0.1).margin(1e-13));
    CHECK(p.slope.y == Approx(-0.3).margin(1e-13));
    CHECK(std::abs(p.curvature.xx) + std::abs(p.curvature.xy) + std::abs(p.curvature.yy) < 1e-12);
  }
}

TEST_CASE("bed: slope and curvature are the derivatives of the level between the nodes") {
  const auto rough = [](double x, double y) { return std::sin(3 * x) * std::cos(2 * y); };
  const auto bed = spline<2>(rough);
  constexpr double s = 1e-5;
  double slope = 0, curvature = 0;
  for (int k = 0; k < 50; ++k) {
    const double x = -2 + 0.083 * k, y = 1.1 - 0.047 * k;
    const auto p = bed.at(at_2d(x, y)), east = bed.at(at_2d(x + s, y)), west = bed.at(at_2d(x - s, y)),
               north = bed.at(at_2d(x, y + s)), south = bed.at(at_2d(x, y - s));
    slope = std::max({slope, std::abs(p.slope.x - (east.b - west.b) / (2 * s)),
                      std::abs(p.slope.y - (north.b - south.b) / (2 * s))});
    curvature = std::max({curvature, std::abs(p.curvature.xx - (east.slope.x - west.slope.x) / (2 * s)),
                          std::abs(p.curvature.xy - (north.slope.x - south.slope.x) / (2 * s)),
                          std::abs(p.curvature.yy - (north.slope.y - south.slope.y) / (2 * s))});
  }
  CHECK(slope < 1e-8);      // s^2/6 of a third derivative of 30, 1e-16/s of rounding
  CHECK(curvature < 4e-4);  // where s straddles a node the third derivative jumps by some 30: s 30
}

TEST_CASE("bed: raising the datum by 100 m changes the level alone") {
  const auto rough = [](double x, double y) { return 0.3 * std::sin(2 * x) * std::cos(3 * y); };
  const auto bed = spline<2>(rough, 0.4),
             raised = spline<2>([&](double x, double y) { return 100 + rough(x, y); }, 0.4);
  test::Random random(6);
  for (int k = 0; k < 100; ++k) {
    const Vec<double, 2> x = at_2d(random(low, high), random(low, high));
    const auto p = bed.at(x), q = raised.at(x);
    CHECK(q.b - p.b == Approx(100).margin(1e-12));        // a hundred metres round by 1.4e-14, some ten times
    CHECK(q.slope.x == Approx(p.slope.x).margin(1e-12));  // 1.4e-14 / dx, some ten times
    CHECK(q.slope.y == Approx(p.slope.y).margin(1e-12));
    CHECK(q.curvature.xx == Approx(p.curvature.xx).margin(1e-11));  // 1.4e-14 / dx^2, likewise
    CHECK(q.curvature.xy == Approx(p.curvature.xy).margin(1e-11));
  }
}

namespace {

struct Moments {
  double mass = 0, mean = 0, variance = 0;
};

// Of what a spike of 1 m at the node x = 1, y = -0.5 becomes, over the nodes along x (or y) through all
// others.
Moments spike_response(int dimension, double filter, bool along_y) {
  const auto spike = [=](double x, double y) {
    return std::abs(x - 1) < 1e-9 && (dimension == 1 || std::abs(y + 0.5) < 1e-9) ? 1.0 : 0.0;
  };
  const auto line = spline<1>(spike, filter);
  const auto plane = spline<2>(spike, filter);
  Moments m;
  const int nodes = static_cast<int>((high - low) / dx);
  for (int j = 0; j <= (dimension == 2 ? nodes : 0); ++j)
    for (int i = 0; i <= nodes; ++i) {
      const double x = low + i * dx, y = low + j * dx, from = along_y ? y + 0.5 : x - 1;
      const double b = dimension == 1 ? line.at(at_1d(x)).b : plane.at(at_2d(x, y)).b;
      m.mass += b, m.mean += b * from, m.variance += b * from * from;
    }
  return m;
}

}  // namespace

TEST_CASE("bed: the filter has the promised standard deviation, keeps volumes and moves nothing") {
  const double filter = GENERATE(0.1, 0.25, 0.3, 0.6);  // m: 0.4 to 2.4 spacings
  CAPTURE(filter);
  for (const auto& [dimension, along_y] :
       {std::make_pair(1, false), std::make_pair(2, false), std::make_pair(2, true)}) {
    const Moments m = spike_response(dimension, filter, along_y);
    // The spline passes through the filtered levels, and these have the variance exactly: round-off of 1600
    // nodes.
    CHECK(m.mass == Approx(1).epsilon(1e-11));
    CHECK(std::abs(m.mean) < 1e-11);
    CHECK(std::sqrt(m.variance) == Approx(filter).epsilon(1e-10));
  }
}

TEST_CASE("bed: without a filter it passes through its bottom particles") {
  test::Random random(7);
  std::vector<double> levels(200 * 200);
  for (double& level : levels) level = random(-1, 1);
  const auto node = [](double x) { return static_cast<size_t>(std::lround((x - low) / dx) + 100); };
  const auto bed = spline<2>([&](double x, double y) { return levels[node(y) * 200 + node(x)]; });
  double off = 0;
  for (int k = 0; k < 40; ++k)
    off = std::max(off, std::abs(bed.at(at_2d(low + k * dx, high - k * dx)).b -
                                 levels[node(high - k * dx) * 200 + node(low + k * dx)]));
  CHECK(off < 1e-13);  // round-off of levels of order one
  CHECK(bed.range()[0] < -0.9);
  CHECK(bed.range()[1] > 0.9);
}

TEST_CASE("bed: level and slope without the curvature are those with it") {
  const auto level = [](double x, double y) { return std::sin(3 * x) * std::cos(2 * y); };
  const auto bed = spline<2>(level);
  const auto line = spline<1>(level);
  test::Random random(7);
  double worst = 0, steepest = 0;
  for (int k = 0; k < 200; ++k) {
    const double x = random(low, high), y = random(low, high);
    const auto full = bed.at(at_2d(x, y)), part = bed.sloped_at(at_2d(x, y));
    worst = std::max({worst, std::abs(full.b - part.b), std::abs(full.slope.x - part.slope.x),
                      std::abs(full.slope.y - part.slope.y)});
    worst = std::max(worst, std::abs(line.at(at_1d(x)).slope.x - line.sloped_at(at_1d(x)).slope.x));
    CHECK((part.curvature.xx == 0 && part.curvature.xy == 0 && part.curvature.yy == 0));
    steepest = std::max(steepest, std::sqrt(dot(full.slope, full.slope)));
  }
  CHECK(worst < 1e-14);  // the same sums, perhaps in another order
  CHECK(bed.steepest() >= steepest);
  CHECK(bed.steepest() <
        1.2 * std::hypot(3, 2));  // the largest slopes along each axis, 3 and 2, met at different places
}
