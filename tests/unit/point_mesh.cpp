// The multigrid cycle on a box of nodes, open and periodic, and the preconditioner that carries it to points: against dense solves, its
// symmetry, and the same bits with any number of threads.
#include "kernels/linear/point_mesh.hpp"

#include <catch2/catch.hpp>

#include <Eigen/Dense>

#include "tests/support/cloud.hpp"
#include "tests/support/threads.hpp"

using namespace freshet;
using linear::BoxGrid;
using linear::BoxLevel;
using linear::BoxMultigrid;
using linear::PointMesh;

namespace {

// A system whose coefficients differ by place; mass at some nodes, or none.
struct Box {
  BoxMultigrid multigrid;
  BoxGrid grid;

  Box(const BoxGrid& g, double mass) : grid(g) {
    multigrid.resize(g);
    const BoxLevel& a = multigrid.finest();
    for (int j = 0; j < g.ny; ++j) {
      for (int i = 0; i < g.nx; ++i) {
        const int n = g.start(j) + i;
        a.mass(n) = (i + j) % 3 == 0 ? mass : 0;
        a.east(n) = g.wrap_x || i + 1 < g.nx ? 1 + 0.5 * std::sin(0.1 * n) : 0;
        a.north(n) = g.wrap_y || j + 1 < g.ny ? 1 + 0.5 * std::cos(0.2 * n) : 0;
      }
      for (const linear::Vector* v : {&a.mass, &a.east, &a.north}) g.wrap(*v, j);
    }
    multigrid.coarsen();
  }

  int unknowns() const { return grid.nx * grid.ny; }
  int number(int i, int j) const { return (j + grid.ny) % grid.ny * grid.nx + (i + grid.nx) % grid.nx; }

  Eigen::MatrixXd matrix() const {
    const BoxLevel& a = multigrid.finest();
    Eigen::MatrixXd m = Eigen::MatrixXd::Zero(unknowns(), unknowns());
    for (int j = 0; j < grid.ny; ++j)
      for (int i = 0; i < grid.nx; ++i) {
        const int at = grid.start(j) + i, here = number(i, j);
        m(here, here) += a.mass(at);
        for (const auto& [to, k] : {std::pair(number(i + 1, j), a.east(at)), std::pair(number(i, j + 1), a.north(at))})
          m(here, here) += k, m(to, to) += k, m(here, to) -= k, m(to, here) -= k;
      }
    return m;
  }

  Eigen::VectorXd cycle(const Eigen::VectorXd& b) {
    const BoxLevel& a = multigrid.finest();
    for (int j = 0; j < grid.ny; ++j) {
      for (int i = 0; i < grid.nx; ++i) a.right(grid.start(j) + i) = b(number(i, j));
      grid.wrap(a.right, j);
    }
    const linear::Vector c = multigrid.cycle();
    Eigen::VectorXd x(unknowns());
    for (int j = 0; j < grid.ny; ++j)
      for (int i = 0; i < grid.nx; ++i) x(number(i, j)) = c(grid.start(j) + i);
    return x;
  }
};

// Disordered points in a unit square, every seventh of them given.
struct Meshed {
  FieldSet fields;
  RowOrder order;
  PointMesh mesh;
  linear::MeshWeights weights;

  Meshed(int n, bool periodic) : order(2, 1.0 / n) {
    test::Random random(5);
    std::vector<test::Point> points;
    for (int k = 0; k < n * n; ++k) points.push_back({(k % n + 0.5 + 0.4 * random(-1, 1)) / n, (k / n + 0.5 + 0.4 * random(-1, 1)) / n});
    fields = test::point_fields(2, points);
    order.sort(fields);
    weights = {make("area"), make("weight"), make("held"), periodic};
    for (int i = 0; i < count(); ++i) {
      const bool given = !periodic && i % 7 == 0;
      weights.area(i) = 1 + 0.1 * (i % 3);
      weights.weight(i) = given ? 0 : 20 + i % 5;
      weights.held(i) = periodic ? 0 : 0.1;
    }
    const Period period = periodic ? Period{{0, 0}, {1, 1}} : Period{};
    mesh.build(order.rows(), {fields.real("x"), fields.real("y")}, count(), period, weights);
  }
  int count() const { return fields.size(); }
  Field<double> make(const char* name) { return fields.real(name, "1", Carry::no); }
};

double weighted(const Meshed& m, const Field<double>& a, const Field<double>& b) {
  double sum = 0;
  for (int i = 0; i < m.count(); ++i) sum += m.weights.weight(i) * a(i) * b(i);
  return sum;
}

}  // namespace

TEST_CASE("box multigrid: cycles converge to the dense solution on open and periodic boxes of any size") {
  const BoxGrid grid = GENERATE(BoxGrid{16, 16, false, false}, BoxGrid{17, 12, false, false}, BoxGrid{16, 9, true, false},
                                BoxGrid{13, 11, true, true}, BoxGrid{2, 7, true, true}, BoxGrid{5, 1, false, false}, BoxGrid{1, 1, false, false});
  const double mass = GENERATE(0.0, 0.2);
  CAPTURE(grid.nx, grid.ny, grid.wrap_x, grid.wrap_y, mass);
  Box box(grid, mass);
  const Eigen::MatrixXd a = box.matrix();
  Eigen::VectorXd b(box.unknowns()), x = Eigen::VectorXd::Zero(box.unknowns());
  test::Random random(7);
  for (int k = 0; k < box.unknowns(); ++k) b(k) = random(-1, 1);
  if (mass == 0) b.array() -= b.mean();
  const double start = b.norm();
  for (int k = 0; k < 12; ++k) x += box.cycle(b - a * x);
  CHECK((b - a * x).norm() <= std::pow(0.35, 12) * start + 1e-13);  // a cycle takes two thirds of the residual away at least
}

TEST_CASE("box multigrid: a cycle is symmetric") {
  Box box(BoxGrid{9, 14, true, false}, 0.1);
  Eigen::MatrixXd m(box.unknowns(), box.unknowns());
  for (int k = 0; k < box.unknowns(); ++k) m.col(k) = box.cycle(Eigen::VectorXd::Unit(box.unknowns(), k));
  CHECK((m - m.transpose()).norm() <= 1e-13 * m.norm());
}

TEST_CASE("point mesh: it adds a correction that is symmetric in the weights, nothing to given points and to constants that are free") {
  const bool periodic = GENERATE(false, true);
  Meshed m(21, periodic);
  const auto a = m.make("a"), b = m.make("b"), za = m.make("za"), zb = m.make("zb"), one = m.make("one");
  test::Random random(11);
  for (int i = 0; i < m.count(); ++i) {
    const bool given = m.weights.weight(i) == 0;
    a(i) = given ? 0 : random(-1, 1);
    b(i) = given ? 0 : random(-1, 1);
    one(i) = 3;
  }
  const auto correction = [&](const Field<double>& r, const Field<double>& z) {
    m.mesh(r, z);
    for (int i = 0; i < m.count(); ++i) z(i) -= r(i);
  };
  correction(a, za);
  correction(b, zb);
  const double there = weighted(m, a, zb), back = weighted(m, b, za);
  // The mean is taken off before the mesh, not behind it.
  const double mean_a = weighted(m, a, one) / weighted(m, one, one), mean_b = weighted(m, b, one) / weighted(m, one, one);
  const double off = periodic ? mean_a * weighted(m, one, zb) - mean_b * weighted(m, one, za) : 0;
  CHECK(there - back - off == Approx(0).margin(1e-10 * (std::abs(there) + 1)));
  for (int i = 0; i < m.count(); ++i)
    if (m.weights.weight(i) == 0) CHECK(za(i) == 0);
  if (!periodic) return;
  correction(one, za);
  for (int i = 0; i < m.count(); ++i) CHECK(std::abs(za(i)) <= 1e-10);
}

TEST_CASE("point mesh bits", "[.]") {
  Meshed m(60, true);
  const auto r = m.make("r"), z = m.make("z");
  for (int i = 0; i < m.count(); ++i) r(i) = std::sin(3.0 * i);
  m.mesh(r, z);
  test::say(z.data(), m.count());
}

TEST_CASE("point mesh: the same bits with one and two threads") {
  const std::string one = test::said("point mesh bits", 1);
  CHECK(one != "");
  CHECK(test::said("point mesh bits", 2) == one);
}
