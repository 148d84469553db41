// Poisson's equation on jittered points: second order with mixed, pure flux and periodic boundaries, the same
// at every size, and few iterations of BiCGStab, preconditioned on a mesh.
#include <catch2/catch.hpp>

#include "kernels/fpm/pressure/elliptic.hpp"
#include "tests/support/points/cloud.hpp"

using namespace freshet;
using namespace freshet::fpm;
using freshet::Point;

namespace {

enum class Edges { mixed, flux, periodic };

// n x n cells of the unit square times size. mixed: psi is given at x = 0 and y = 1, its flux on the others.
struct Square {
  FieldSet fields;
  RowOrder order;
  NeighbourFinder<2> finder;
  Stencils<2> stencils;
  Poisson<2> poisson;
  Edges edges;
  double dx, size;

  Square(int n, double side, Edges e, double jitter = 0.3)
      : order(2, side / n, test::wide(side / n)), edges(e), dx(side / n), size(side) {
    test::Random random(3);
    std::vector<Point> points;
    const int last = e == Edges::periodic ? n : n + 1;
    for (int j = 0; j < last; ++j)
      for (int i = 0; i < last; ++i) {
        const bool edge_x = e != Edges::periodic && (i == 0 || i == n),
                   edge_y = e != Edges::periodic && (j == 0 || j == n);
        points.push_back({dx * (i + (edge_x ? 0 : jitter * random(-1, 1))),
                          dx * (j + (edge_y ? 0 : jitter * random(-1, 1)))});
      }
    if (e == Edges::periodic)
      for (Point& p : points) p = {p[0] + 0.5 * dx, p[1] + 0.5 * dx};
    fields = test::point_fields(2, points);
    order.sort(fields);
    Kokkos::deep_copy(fields.real("h"), 3.2 * dx);
    assemble();
  }

  void assemble() {
    const Period period = edges == Edges::periodic ? Period{{0, 0}, {size, size}} : Period{};
    const auto row = fields.integer("row", "1", Carry::no);
    const VecField<double, 2> normal{make("nx"), make("ny")};
    for (int i = 0; i < count(); ++i) {
      const double a = x(i) / size, b = y(i) / size;
      const bool left = a == 0, right = a > 1 - 1e-9, bottom = b == 0, top = b > 1 - 1e-9;
      const bool given = edges == Edges::mixed && (left || top),
                 edge = edges != Edges::periodic && (left || right || bottom || top);
      row(i) = given ? row_value : edge ? row_flux : row_equation;
      const double nx = right - left, ny = top - bottom, length = std::max(std::hypot(nx, ny), 1e-300);
      normal.x(i) = nx / length;
      normal.y(i) = ny / length;
    }
    stencils.find(
        finder.find(order.rows(), {fields.real("x"), fields.real("y")}, fields.real("h"), count(), period));
    poisson.assemble(stencils.view(), order.rows(), {row, normal});
  }

  int count() const { return fields.size(); }
  double x(int i) const { return fields.real("x")(i); }
  double y(int i) const { return fields.real("y")(i); }
  Field<double> make(const char* name) { return fields.real(name, "1", Carry::no); }

  struct Result {
    double l2;
    PoissonReport report;
  };
  // Against psi = cos(k x + shift) cos(k y + shift), whose flux through the edges and mean are those of the
  // problem.
  Result solve() {
    const double k = (edges == Edges::periodic ? 2 * pi : 2.0) / size,
                 s = edges == Edges::periodic ? 0.3 : 0.5;
    const auto f = make("f"), g = make("g"), given = make("given"), psi = make("psi"), exact = make("exact");
    double mean = 0;
    for (int i = 0; i < count(); ++i) {
      const double a = k * x(i) + s, b = k * y(i) + s;
      exact(i) = given(i) = std::cos(a) * std::cos(b);
      mean += exact(i) / count();
      f(i) = -2 * k * k * exact(i);
      g(i) = -k * (fields.real("nx")(i) * std::sin(a) * std::cos(b) +
                   fields.real("ny")(i) * std::cos(a) * std::sin(b));
      psi(i) = 0;
    }
    Result result{0, poisson.solve({f, g, given}, psi, {})};
    for (int i = 0; i < count(); ++i)
      result.l2 += std::pow(psi(i) - exact(i) + (poisson.singular() ? mean : 0), 2) / count();
    result.l2 = std::sqrt(result.l2);
    return result;
  }
};

}  // namespace

TEST_CASE("Poisson's equation with mixed boundaries converges with order 2 in few iterations") {
  double coarser = 0;
  for (int n : {20, 40, 80, 160}) {
    Square square(n, 1.0, Edges::mixed);
    const auto [l2, report] = square.solve();
    CAPTURE(n, l2, report.solve.iterations);
    CHECK(report.solve.converged);
    CHECK(report.solve.iterations <= 12);
    if (coarser > 0) CHECK(std::log2(coarser / l2) > 1.9);
    coarser = l2;
  }
}

TEST_CASE("Poisson's equation has the same error in squares of 0.01, 1 and 100 m") {
  const double unit = Square(40, 1.0, Edges::mixed).solve().l2;
  for (double size :
       {0.01, 100.0})  // round-off of the two sizes' coordinates, and the solver's tolerance of 1e-8
    CHECK(Square(40, size, Edges::mixed).solve().l2 == Approx(unit).epsilon(1e-6));
}

TEST_CASE("Poisson's equation without a given value: pure flux and periodic squares") {
  const Edges edges = GENERATE(Edges::flux, Edges::periodic);
  double coarser = 0;
  for (int n : {20, 40, 80}) {
    Square square(n, 1.0, edges);
    REQUIRE(square.poisson.singular());
    const auto [l2, report] = square.solve();
    CAPTURE(n, l2, report.solve.iterations, report.solve.residual, static_cast<int>(edges));
    CHECK(report.solve.converged);
    CHECK(report.solve.iterations <= 15);
    if (coarser > 0) CHECK(std::log2(coarser / l2) > 1.8);
    coarser = l2;
  }
}

TEST_CASE("A linear pressure between walls and a surface is found to the solver's tolerance") {
  Square square(30, 1.0, Edges::mixed, 0.3);
  const auto f = square.make("f"), g = square.make("g"), given = square.make("given"),
             psi = square.make("psi");
  for (int i = 0; i < square.count(); ++i) {
    given(i) = 3 - 2 * square.y(i) + square.x(i);
    f(i) = psi(i) = 0;
    g(i) = square.fields.real("nx")(i) - 2 * square.fields.real("ny")(i);
  }
  linear::BiCgStabOptions options;
  options.tolerance = 1e-12;
  REQUIRE(square.poisson.solve({f, g, given}, psi, options).solve.converged);
  for (int i = 0; i < square.count(); ++i) CHECK(psi(i) == Approx(given(i)).margin(1e-10));
}

TEST_CASE("Periodic lists hold every neighbour across the sides once") {
  Square square(20, 1.0, Edges::periodic);
  const auto& around = square.finder.view();
  for (int c = 0; c < around.clusters.size(); ++c) {
    Lane found{0.0};
    around.for_each(c, [&](int, const Terms<Lane, 2>&, const Lane& w) {
      found += select(Lane(0.0) < w, Lane(1.0), Lane(0.0));
    });
    for (int l = 0; l < around.clusters(c).count; ++l) {
      const int i = around.clusters(c).first + l;
      int near = 0;
      for (int j = 0; j < square.count(); ++j) {
        const double dx = square.x(j) - square.x(i), dy = square.y(j) - square.y(i);
        near += j != i && std::hypot(dx - std::round(dx), dy - std::round(dy)) < 3.2 * square.dx;
      }
      CHECK(lane_of(found, l) == near);
    }
  }
}
