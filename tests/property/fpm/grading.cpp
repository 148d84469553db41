// Spacing that varies by place (fpm.grading, here by a factor of 3): points keep to it, quadratics stay
// exact, Poisson's equation second order, still water still.
#include <catch2/catch.hpp>

#include "kernels/fpm/pressure/elliptic.hpp"
#include "src/errors.hpp"
#include "src/methods/fpm/nodes.hpp"
#include "src/methods/fpm/place.hpp"
#include "tests/support/points/cloud.hpp"
#include "tests/support/run/flow.hpp"

using namespace freshet;
using namespace freshet::fpm;

namespace {

Scene unit_square(double spacing) {
  return read_scene_text(
      "[scene]\nname = \"square\"\nmethod = \"fpm\"\n[domain]\nbox = [0, 0, 1, 1]\n[fpm]\ngrading = \"1 + "
      "2*x\"\n[water]\nspacing = " +
          std::to_string(spacing) +
          "\ndisorder = 0.1\n[[body]]\nbox = [0, 0, 1, 1]\n[time]\nend = 1\n[output]\nevery = 1\n",
      "square.toml");
}

// The square's points in order, with their supports, and the lists.
struct Graded {
  FieldSet fields;
  RowOrder order;
  NeighbourFinder<2> finder;

  explicit Graded(double spacing) : order(2, spacing, test::wide(spacing)) {
    const Scene scene = unit_square(spacing);
    std::vector<Point> places;
    for (const auto& p : place_points(scene)) places.push_back({p.x[0], p.x[1]});
    fields = test::point_fields(2, places);
    order.sort(fields);
    for (int i = 0; i < size(); ++i) fields.real("h")(i) = 3.2 * spacing_at(scene, {x(i), y(i)});
    finder.find(order.rows(), {fields.real("x"), fields.real("y")}, fields.real("h"), size());
  }
  int size() const { return fields.size(); }
  double x(int i) const { return fields.real("x")(i); }
  double y(int i) const { return fields.real("y")(i); }
  Field<double> make(const char* name) { return fields.real(name, "1", Carry::no); }

  // Root mean square of the error for psi = cos(2 x + 0.5) cos(2 y + 0.5), given on x = 0 and y = 1, its flux
  // on the other sides.
  double poisson_error() {
    const auto f = make("f"), g = make("g"), given = make("given"), psi = make("psi");
    const VecField<double, 2> normal{make("nx"), make("ny")};
    const auto row = fields.integer("row", "1", Carry::no);
    for (int i = 0; i < size(); ++i) {
      const double a = 2 * x(i) + 0.5, b = 2 * y(i) + 0.5;
      given(i) = std::cos(a) * std::cos(b);
      f(i) = -8 * given(i);
      psi(i) = 0;
      const bool right = x(i) > 1 - 1e-12, bottom = y(i) < 1e-12;
      row(i) = x(i) < 1e-12 || y(i) > 1 - 1e-12 ? row_value : right || bottom ? row_flux : row_equation;
      const double length = std::max(std::hypot(right, bottom), 1e-300);
      normal.x(i) = right / length;
      normal.y(i) = -bottom / length;
      g(i) = -2 * (normal.x(i) * std::sin(a) * std::cos(b) + normal.y(i) * std::cos(a) * std::sin(b));
    }
    Poisson<2> poisson;
    Stencils<2> stencils;
    stencils.find(finder.view());
    poisson.assemble(stencils.view(), order.rows(), {row, normal});
    const auto report = poisson.solve({f, g, given}, psi, {});
    CAPTURE(report.solve.iterations, size());
    CHECK(report.solve.converged);
    CHECK(report.solve.iterations <= 20);
    double square = 0;
    for (int i = 0; i < size(); ++i) square += std::pow(psi(i) - given(i), 2) / size();
    return std::sqrt(square);
  }
};

}  // namespace

TEST_CASE("Points of a graded cloud stand at the spacing that is asked for") {
  const Scene scene = unit_square(0.02);
  const auto points = place_points(scene);
  double integral = 0;  // of 1 / spacing^2
  for (int k = 0; k < 1000; ++k) integral += 1e-3 / std::pow(spacing_at(scene, {(k + 0.5) / 1000, 0.5}), 2);
  CHECK(static_cast<double>(points.size()) ==
        Approx(integral).epsilon(0.15));  // between a lattice at 1 and closest packing at 0.9
  for (const auto& p : points) {
    double nearest = 1e300;
    for (const auto& q : points)
      if (&p != &q) nearest = std::min(nearest, std::hypot(p.x[0] - q.x[0], p.x[1] - q.x[1]));
    const double dx = spacing_at(scene, p.x);
    CHECK(nearest > 0.6 * dx);  // 0.9 less twice the disorder
    CHECK(nearest < 1.4 * dx);
  }
}

TEST_CASE("Stencils on a graded cloud reproduce quadratics") {
  Graded cloud(0.025);
  Stencils<2> stencils;
  REQUIRE(stencils.find(cloud.finder.view()).poor == 0);
  const auto f = cloud.make("f");
  for (int i = 0; i < cloud.size(); ++i)
    f(i) = 1 + 2 * cloud.x(i) - cloud.y(i) + 3 * cloud.x(i) * cloud.x(i) - cloud.x(i) * cloud.y(i) +
           0.5 * cloud.y(i) * cloud.y(i);
  const VecField<double, 2> slope{cloud.make("sx"), cloud.make("sy")},
      lap{cloud.make("lx"), cloud.make("ly")};
  stencils.gradient(f, slope);
  stencils.laplacian({f, f}, lap);
  double worst = 0, worst_lap = 0;
  for (int i = 0; i < cloud.size(); ++i) {
    worst = std::max({worst, std::abs(slope.x(i) - (2 + 6 * cloud.x(i) - cloud.y(i))),
                      std::abs(slope.y(i) - (-1 - cloud.x(i) + cloud.y(i)))});
    worst_lap = std::max(worst_lap, std::abs(lap.x(i) - 7));
  }
  CHECK(worst < 1e-11);     // round-off over h
  CHECK(worst_lap < 1e-9);  // over h^2
}

TEST_CASE("Poisson's equation on graded clouds converges with order 2") {
  const double coarse = Graded(0.02).poisson_error(), middle = Graded(0.01).poisson_error(),
               fine = Graded(0.005).poisson_error();
  CAPTURE(coarse, middle, fine);
  // Clouds that are not refinements of each other: between two halvings the order is 1.9 in the mean.
  CHECK(0.5 * std::log2(coarse / fine) > 1.9);
}

TEST_CASE("Still water with a graded cloud stays still") {
  const std::string grading = GENERATE("fpm.grading=1 + 2*x", "fpm.grading=3 - 2*min(y, 1)");
  test::FlowRun run("fpm_still_box", {grading, "water.spacing=0.025"});
  run.run_to(2);
  double fastest = 0, off = 0;
  for (const auto& q : run.points()) {
    fastest = std::max(fastest, std::hypot(q.u, q.v));
    off = std::max(off, std::abs(q.p - 9810 * (1 - q.y)) / 9810);
  }
  CAPTURE(grading, run.points().size(), fastest, off);
  CHECK(fastest <= 1e-8);
  CHECK(off <= 1e-9);
}

TEST_CASE("A column that collapses through a graded cloud keeps its area") {
  test::FlowRun run("fpm_martin_moyce", {"fpm.grading=1 + 8*x", "water.spacing=0.003", "time.end=0.06"});
  const double before = run.solver.totals().mass;
  run.run_to(0.06);
  CHECK(std::abs(run.solver.totals().mass / before - 1) < 0.01);
  double nearest = 1e300;
  const auto points = run.points();
  for (const auto& p : points)
    for (const auto& q : points)
      if (&p != &q)
        nearest =
            std::min(nearest, std::hypot(p.x - q.x, p.y - q.y) / (0.003 * (1 + 8 * std::min(p.x, q.x))));
  CHECK(nearest > 0.2);  // pairs closer than 0.64 spacings are merged, one pair a point and step
}

TEST_CASE("A grading finer than the spacing is an error") {
  Scene scene = unit_square(0.05);
  scene.fpm->grading = [](double, double) { return 0.5; };
  CHECK_THROWS_AS(fpm::FinitePointset(scene), SceneError);
}
