// The multigrid cycle on a box of nodes, open and periodic: against dense solves, symmetric and, around empty
// nodes too, near the inverse.
#include "kernels/linear/mesh/box_multigrid.hpp"

#include <catch2/catch.hpp>

#include <functional>

#include <Eigen/Dense>

#include "tests/support/points/cloud.hpp"

using namespace freshet;
using linear::BoxGrid;
using linear::BoxLevel;
using linear::BoxMultigrid;

namespace {

using At = std::function<double(int, int)>;  // of node (i, j)

// A system whose coefficients differ by place; nodes where `dry` have none.
struct Boxed {
  BoxMultigrid multigrid;
  BoxGrid grid;

  Boxed(
      const BoxGrid& g, const At& mass, const At& dry = [](int, int) { return 0; })
      : grid(g) {
    multigrid.resize(g);
    const BoxLevel& a = multigrid.finest();
    for (int j = 0; j < g.ny; ++j) {
      for (int i = 0; i < g.nx; ++i) {
        const int n = g.start(j) + i;
        const bool here = dry(i, j) == 0, east = g.wrap_x || i + 1 < g.nx, north = g.wrap_y || j + 1 < g.ny;
        a.mass(n) = here ? mass(i, j) : 0;
        a.east(n) = east && here && dry(i + 1, j) == 0 ? 1 + 0.5 * std::sin(0.1 * n) : 0;
        a.north(n) = north && here && dry(i, j + 1) == 0 ? 1 + 0.5 * std::cos(0.2 * n) : 0;
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
        for (const auto& [to, k] :
             {std::pair(number(i + 1, j), a.east(at)), std::pair(number(i, j + 1), a.north(at))})
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

  // B as a matrix, a unit vector at a time.
  Eigen::MatrixXd cycles() {
    Eigen::MatrixXd b(unknowns(), unknowns());
    for (int k = 0; k < unknowns(); ++k) b.col(k) = cycle(Eigen::VectorXd::Unit(unknowns(), k));
    return b;
  }
};

At every_third(double mass) {
  return [mass](int i, int j) { return (i + j) % 3 == 0 ? mass : 0.0; };
}

// The spectrum of B A: that of L^T B L, A = L L^T.
Eigen::VectorXd spectrum(const Eigen::MatrixXd& b, const Eigen::MatrixXd& a) {
  const Eigen::MatrixXd l = a.llt().matrixL();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(l.transpose() * b * l).eigenvalues();
}

}  // namespace

TEST_CASE("box multigrid: cycles converge to the dense solution on open and periodic boxes of any size") {
  const BoxGrid grid =
      GENERATE(BoxGrid{16, 16, false, false}, BoxGrid{17, 12, false, false}, BoxGrid{16, 9, true, false},
               BoxGrid{13, 11, true, true}, BoxGrid{2, 7, true, true}, BoxGrid{5, 1, false, false},
               BoxGrid{1, 1, false, false});
  const double mass = GENERATE(0.0, 0.2);
  CAPTURE(grid.nx, grid.ny, grid.wrap_x, grid.wrap_y, mass);
  Boxed box(grid, every_third(mass));
  const Eigen::MatrixXd a = box.matrix();
  Eigen::VectorXd b(box.unknowns()), x = Eigen::VectorXd::Zero(box.unknowns());
  test::Random random(7);
  for (int k = 0; k < box.unknowns(); ++k) b(k) = random(-1, 1);
  if (mass == 0) b.array() -= b.mean();
  const double start = b.norm();
  for (int k = 0; k < 12; ++k) x += box.cycle(b - a * x);
  CHECK((b - a * x).norm() <=
        std::pow(0.35, 12) * start + 1e-13);  // a cycle takes two thirds of the residual away at least
}

TEST_CASE("box multigrid: a periodic cycle is symmetric") {
  Boxed box(BoxGrid{9, 14, true, false}, every_third(0.1));
  const Eigen::MatrixXd b = box.cycles();
  CHECK((b - b.transpose()).norm() <= 1e-13 * b.norm());
}

TEST_CASE("box multigrid: the cycle is symmetric and close to the inverse") {
  const auto [nx, ny] = GENERATE(std::pair(16, 16), std::pair(17, 9), std::pair(31, 1), std::pair(50, 3),
                                 std::pair(21, 24), std::pair(1, 1));
  const double mass = GENERATE(1e-4, 1e-1, 10.0);
  Boxed box(BoxGrid{nx, ny, false, false}, [m = mass](int, int) { return m; });
  const Eigen::MatrixXd b = box.cycles();
  CHECK((b - b.transpose()).norm() < 1e-12 * b.norm());
  const Eigen::VectorXd s = spectrum(b, box.matrix());
  INFO(nx << " x " << ny << " mass " << mass << ": eigenvalues of B A from " << s.minCoeff() << " to "
          << s.maxCoeff());
  CHECK(s.minCoeff() > 0.5);  // condition number of the preconditioned system below 4
  CHECK(s.maxCoeff() < 2.0);
}

TEST_CASE("box multigrid: the rest is solved around empty nodes") {
  const int nx = 40, ny = 30;
  Boxed box(
      BoxGrid{nx, ny, false, false}, [](int, int) { return 1e-2; },
      [](int i, int j) { return std::abs(i - nx / 3) < nx / 8 && std::abs(j - ny / 2) <= ny / 5; });
  const Eigen::MatrixXd b = box.cycles(), full = box.matrix();
  std::vector<int> wet;
  for (int n = 0; n < box.unknowns(); ++n)
    if (full(n, n) > 0) wet.push_back(n);
  const Eigen::MatrixXd inner = b(wet, wet);  // nothing ever pulls at an empty node
  CHECK((inner - inner.transpose()).norm() < 1e-12 * inner.norm());
  const Eigen::VectorXd s = spectrum(inner, full(wet, wet));
  INFO("eigenvalues of B A from " << s.minCoeff() << " to " << s.maxCoeff());
  CHECK(s.minCoeff() > 0.2);  // interpolation runs across the island's rim
  CHECK(s.maxCoeff() < 2.5);
}
