// The least-squares fits and stencils of FPM: exact for quadratics, of their orders on smooth fields, equal
// to Eigen's QR.
#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "kernels/fpm/stencils/stencils.hpp"
#include "tests/support/points/cloud.hpp"

using namespace freshet;
using namespace freshet::fpm;
using freshet::Point;

namespace {

using Real = long double;  // references in more digits
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

constexpr double support = 3.2;  // x dx

// n x n points of the unit square times size, each off its lattice place by up to jitter dx; sorted, listed,
// with their stencils.
struct Sheet {
  FieldSet fields;
  RowOrder order;
  NeighbourFinder<2> finder;
  Stencils<2> stencils;
  double dx;

  Sheet(int n, double size, double jitter, unsigned seed = 5)
      : order(2, size / n, test::wide(size / n)), dx(size / n) {
    auto points = test::lattice(2, {0, n, 0, n}, dx);
    test::Random random(seed);
    for (Point& p : points) p = {p[0] + jitter * dx * random(-1, 1), p[1] + jitter * dx * random(-1, 1)};
    prepare(points);
  }
  Sheet(const std::vector<Point>& points, double spacing)
      : order(2, spacing, test::wide(spacing)), dx(spacing) {
    prepare(points);
  }

  void prepare(const std::vector<Point>& points) {
    fields = test::point_fields(2, points);
    order.sort(fields);
    Kokkos::deep_copy(fields.real("h"), support * dx);
    report = stencils.find(finder.find(order.rows(), x(), fields.real("h"), fields.size()));
  }
  StencilReport report;
  VecField<double, 2> x() const { return {fields.real("x"), fields.real("y")}; }
  Field<double> make(const char* name) { return fields.real(name, "1", Carry::no); }

  template <class F>
  Field<double> sample(const char* name, const F& f) {
    const auto values = make(name);
    for (int i = 0; i < fields.size(); ++i) values(i) = f(x().x(i), x().y(i));
    return values;
  }
  bool inside(int i, double margin) const {
    const double top = 1 - margin;
    return x().x(i) > margin && x().x(i) < top && x().y(i) > margin && x().y(i) < top;
  }
};

struct Errors {
  double gradient, laplacian;
};

// Root mean square errors on sin(3x + 1) cos(2y), away from the edges.
Errors errors_on_waves(int n) {
  Sheet sheet(n, 1.0, 0.3);
  const auto f = sheet.sample("f", [](double x, double y) { return std::sin(3 * x + 1) * std::cos(2 * y); });
  const VecField<double, 2> g{sheet.make("gx"), sheet.make("gy")};
  const auto lap = sheet.make("lap");
  sheet.stencils.gradient(f, g);
  sheet.stencils.laplacian({f, f}, {lap, lap});
  double g2 = 0, l2 = 0;
  int count = 0;
  for (int i = 0; i < sheet.fields.size(); ++i) {
    if (!sheet.inside(i, 0.2)) continue;
    const double a = 3 * sheet.x().x(i) + 1, b = 2 * sheet.x().y(i);
    g2 += std::pow(g.x(i) - 3 * std::cos(a) * std::cos(b), 2) +
          std::pow(g.y(i) + 2 * std::sin(a) * std::sin(b), 2);
    l2 += std::pow(lap(i) + 13 * f(i), 2);
    ++count;
  }
  return {std::sqrt(g2 / count), std::sqrt(l2 / count)};
}

// The same derivatives at point i by QR of the weighted, unscaled problem.
Vector by_qr(const Sheet& sheet, const Field<double>& f, int i) {
  std::vector<std::array<double, 6>> rows;
  const double h = support * sheet.dx;
  for (int j = 0; j < sheet.fields.size(); ++j) {
    const double dx = (sheet.x().x(j) - sheet.x().x(i)) / h, dy = (sheet.x().y(j) - sheet.x().y(i)) / h,
                 r2 = dx * dx + dy * dy;
    if (j == i || r2 >= 1) continue;
    const double w = std::exp(-3.5 * r2);  // the square root of the weight
    rows.push_back({w * dx, w * dy, w * dx * dx / 2, w * dx * dy, w * dy * dy / 2, w * (f(j) - f(i))});
  }
  Matrix m(rows.size(), 5);
  Vector b(rows.size());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (int k = 0; k < 5; ++k) m(static_cast<int>(r), k) = rows[r][static_cast<std::size_t>(k)];
    b(static_cast<int>(r)) = rows[r][5];
  }
  const Vector a = m.colPivHouseholderQr().solve(b);
  Vector d(3);
  d << a(0) / h, a(1) / h, (a(2) + a(4)) / (h * h);
  return d;
}

// Largest deviation of gradient and Laplacian of a quadratic from the exact ones, relative to those.
double quadratic_deviation(Sheet& sheet) {
  const double s = 1 / (sheet.dx * 40);
  const auto f = sheet.sample("f", [s](double x, double y) {
    const double a = s * x, b = s * y;
    return 1 + 2 * a - 3 * b + 0.7 * a * a - 1.1 * a * b + 2.3 * b * b;
  });
  const VecField<double, 2> g{sheet.make("gx"), sheet.make("gy")};
  const auto lap = sheet.make("lap"), fit = sheet.make("fit");
  sheet.stencils.gradient(f, g);
  sheet.stencils.laplacian({f, f}, {lap, lap});
  sheet.stencils.fit(f, fit);
  double worst = 0;
  for (int i = 0; i < sheet.fields.size(); ++i) {
    const double a = s * sheet.x().x(i), b = s * sheet.x().y(i);
    worst = std::max({worst, std::abs(g.x(i) / s - (2 + 1.4 * a - 1.1 * b)) / 3,
                      std::abs(g.y(i) / s - (-3 - 1.1 * a + 4.6 * b)) / 3,
                      std::abs(lap(i) / (s * s) - 6.0) / 6, std::abs(fit(i) - f(i)) / 5});
  }
  return worst;
}

}  // namespace

TEST_CASE("MLS stencils reproduce quadratics at every point, whatever the size of the domain") {
  const double size = GENERATE(0.01, 1.0, 100.0), jitter = GENERATE(0.0, 0.3, 0.45);
  Sheet sheet(40, size, jitter);
  CAPTURE(size, jitter);
  CHECK(sheet.report.poor == 0);
  CHECK(quadratic_deviation(sheet) <
        1e-11);  // normal equations of cond <= 74^2 at corners, and the Laplacian divides by h^2
}

TEST_CASE("MLS stencils equal a QR of the unscaled problem") {
  Sheet sheet(24, 1.0, 0.3);
  const auto f = sheet.sample("f", [](double x, double y) { return std::exp(x) * std::sin(4 * y); });
  const VecField<double, 2> g{sheet.make("gx"), sheet.make("gy")};
  const auto lap = sheet.make("lap");
  sheet.stencils.gradient(f, g);
  sheet.stencils.laplacian({f, f}, {lap, lap});
  for (int i = 0; i < sheet.fields.size(); i += 17) {
    const Vector d = by_qr(sheet, f, i);
    CHECK(g.x(i) == Approx(static_cast<double>(d(0))).epsilon(1e-9).margin(1e-10));
    CHECK(g.y(i) == Approx(static_cast<double>(d(1))).epsilon(1e-9).margin(1e-10));
    CHECK(lap(i) == Approx(static_cast<double>(d(2))).epsilon(1e-9).margin(1e-8));
  }
}

TEST_CASE("MLS gradients are of order 2, Laplacians at least of order 1") {
  const Errors coarse = errors_on_waves(30), fine = errors_on_waves(120);
  CHECK(std::log(coarse.gradient / fine.gradient) / std::log(4.0) > 1.9);
  CHECK(std::log(coarse.laplacian / fine.laplacian) / std::log(4.0) > 0.95);
}

TEST_CASE("The divergence is that of both gradients") {
  Sheet sheet(20, 1.0, 0.3);
  const VecField<double, 2> v{sheet.sample("u", [](double x, double y) { return x * x - 2 * x * y; }),
                              sheet.sample("v", [](double x, double y) { return 3 * y + x * y; })};
  const auto div = sheet.make("div");
  sheet.stencils.divergence(v, div);
  for (int i = 0; i < sheet.fields.size(); ++i)
    CHECK(div(i) == Approx(3 * sheet.x().x(i) - 2 * sheet.x().y(i) + 3).margin(1e-11));
}

TEST_CASE("Few neighbours or neighbours in a line leave derivatives bounded and are reported") {
  Sheet line({{0, 0}, {1, 0}, {2, 0}, {0.5, 30}, {0.5, 31}}, 1.0);
  const auto f = line.sample("f", [](double x, double) { return 5 * x; });
  const VecField<double, 2> g{line.make("gx"), line.make("gy")};
  line.stencils.gradient(f, g);
  CHECK(line.report.poor == 5);
  for (int i = 0; i < 5; ++i) {
    CHECK(std::abs(g.x(i)) < 10);
    CHECK(std::abs(g.y(i)) < 10);
  }
}

TEST_CASE(
    "Gradients in layers of two rows stay within the slopes that there are, whichever way the layer lies") {
  const double angle = GENERATE(0.0, 0.5, 1.2, 1.57), thick = 0.6, c = std::cos(angle), s = std::sin(angle);
  std::vector<Point> places;
  test::Random random(5);
  for (int k = 0; k < 40; ++k) {
    const double along = 0.5 * k + random(-0.1, 0.1),
                 across = k % 2 == 0 ? 0.0 : thick * (1 + random(-0.1, 0.1));
    places.push_back({c * along - s * across, s * along + c * across});
  }
  Sheet layer(places, 1.0);
  const auto f = layer.sample("f", [&](double, double) { return random(-1, 1); });
  const VecField<double, 2> g{layer.make("gx"), layer.make("gy")};
  layer.stencils.gradient(f, g);
  // Values differ by up to 2 over 0.54 across; 1e3 and more without soft pivots.
  for (int i = 0; i < 40; ++i) CHECK(std::hypot(g.x(i), g.y(i)) < 4 * 2 / 0.54);
}

TEST_CASE("FPM lists hold exactly the neighbours within h") {
  Sheet sheet(25, 1.0, 0.45);
  std::vector<int> found(static_cast<std::size_t>(sheet.fields.size()), 0);
  const auto& around = sheet.finder.view();
  for (int c = 0; c < around.clusters.size(); ++c)
    around.for_each(c, [&](int, const Terms<Lane, 2>&, const Lane& w) {
      for (int l = 0; l < around.clusters(c).count; ++l)
        found[static_cast<std::size_t>(around.clusters(c).first + l)] += lane_of(w, l) > 0;
    });
  for (int i = 0; i < sheet.fields.size(); ++i) {
    int near = 0;
    for (int j = 0; j < sheet.fields.size(); ++j)
      near += j != i && std::hypot(sheet.x().x(j) - sheet.x().x(i), sheet.x().y(j) - sheet.x().y(i)) <
                            support * sheet.dx;
    CHECK(found[static_cast<std::size_t>(i)] == near);
  }
}

TEST_CASE("MLS in three dimensions reproduces a quadratic") {
  Moments<double, 3> moments;
  test::Random random(3);
  std::vector<Vec<double, 3>> places(60);
  const auto f = [](const Vec<double, 3>& s) {
    return 2 + s.x - s.y * s.z + 0.5 * s.z * s.z - 2 * s.x * s.x;
  };
  for (auto& s : places) {
    s = {random(-0.55, 0.55), random(-0.55, 0.55), random(-0.55, 0.55)};
    moments.add(weight(dot(s, s)), basis(s));
  }
  const Derivatives<double, 3> d(moments, 1.0);
  const auto value = value_factors(moments);
  double gx = 0, lap = 0, at_centre = 0;
  for (const auto& s : places) {
    gx += weight(dot(s, s)) * (f(s) - 2) * of_slopes<double, 3>(basis(s), d.gradient[0]);
    lap += weight(dot(s, s)) * (f(s) - 2) * of_slopes<double, 3>(basis(s), d.laplacian);
    at_centre += weight(dot(s, s)) * f(s) * dot(basis(s), value);
  }
  CHECK(gx == Approx(1).epsilon(1e-11));
  CHECK(lap == Approx(-3).epsilon(1e-11));
  CHECK(at_centre == Approx(2).epsilon(1e-11));
}

TEST_CASE("The MLS weight is exp(-7 R^2) within the support and zero beyond") {
  for (double s = 0; s < 1; s += 0.01) CHECK(weight(s) == Approx(std::exp(-7 * s)).epsilon(2e-13));
  CHECK(weight(1.0) == 0);
  CHECK(weight(1e6) == 0);
}

TEST_CASE("Small symmetric systems are solved as by Eigen, in every lane") {
  test::Random random(11);
  Symmetric<Lane, 6> g;
  Column<Lane, 6> b;
  Matrix reference[lanes];
  Vector right[lanes];
  for (int l = 0; l < lanes; ++l) {
    Matrix a(6, 6);
    for (int k = 0; k < 36; ++k) a(k) = random(-1, 1);
    reference[l] = a * a.transpose();
    right[l].resize(6);
    for (int i = 0; i < 6; ++i) {
      right[l](i) = random(-1, 1);
      set_lane(b[i], l, static_cast<double>(right[l](i)));
      for (int j = 0; j <= i; ++j) set_lane(g(i, j), l, static_cast<double>(reference[l](i, j)));
    }
  }
  const Column<Lane, 6> x = Factored<Lane, 6>(g, {1e-14}).solve(b);
  for (int l = 0; l < lanes; ++l) {
    const Vector exact = reference[l].fullPivLu().solve(right[l]);
    for (int i = 0; i < 6; ++i)
      CHECK(lane_of(x[i], l) == Approx(static_cast<double>(exact(i))).epsilon(1e-7));
  }
}
