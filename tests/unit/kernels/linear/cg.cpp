// Conjugate gradients against Eigen's direct and iterative solvers, and what is reported when they cannot
// converge.
#include "kernels/linear/cg.hpp"

#include <catch2/catch.hpp>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>

#include "tests/support/points/cloud.hpp"
#include "tests/support/solve/linear_systems.hpp"
#include "tests/support/watch/recording.hpp"
#include "tests/support/watch/threads.hpp"

using namespace freshet;
using Eigen::VectorXd;
using linear::CgOptions;
using linear::CgReport;
using linear::ConjugateGradients;
using linear::Jacobi;
using test::RowOperator;

namespace {

VectorXd random_vector(int n, unsigned seed) {
  test::Random random(seed);
  return VectorXd::NullaryExpr(n, [&] { return random(-1, 1); });
}

// B B^T + shift I, B sparse and random.
test::EigenRows random_spd(int n, unsigned seed) {
  test::Random random(seed);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < 5; ++k) entries.emplace_back(i, static_cast<int>(random(0, n)), random(-1, 1));
  test::EigenRows b(n, n), identity(n, n);
  b.setFromTriplets(entries.begin(), entries.end());
  identity.setIdentity();
  return test::EigenRows(b * test::EigenRows(b.transpose())) + 0.1 * identity;
}

// Conductances that jump by a factor of 100.
test::EigenRows rough_laplacian(int nx, int ny) {
  return test::five_points(nx, ny, 1e-3, [](int a, int b) { return (a + b) % 7 < 2 ? 0.1 : 10.0; });
}

struct Solved {
  CgReport report;
  VectorXd x;
};
Solved solve(const RowOperator& a, const VectorXd& b, const CgOptions& options, const VectorXd& start = {}) {
  ConjugateGradients cg;
  cg.resize(a.size());
  const Field<double> x = test::to_field(start.size() ? start : VectorXd::Constant(a.size(), 7.0));
  const CgReport report = cg.solve(a, Jacobi{a.inverse_diagonal()}, test::to_field(b), x, options);
  return {report, test::to_eigen(x, a.size())};
}

double relative_residual(const RowOperator& a, const VectorXd& b, const VectorXd& x) {
  return (b - a.matrix() * x).norm() / b.norm();
}

}  // namespace

TEST_CASE("cg: agrees with Eigen's Cholesky factorisation on random matrices") {
  const int n = GENERATE(1, 2, 37, 700, 1500);
  const RowOperator a(random_spd(n, 3));
  const VectorXd b = random_vector(n, 5);
  const Solved s = solve(a, b, {1e-12, 10 * n});
  CHECK(s.report.converged());
  CHECK(relative_residual(a, b, s.x) <
        2e-12);  // the recurrence's residual is within rounding of the true one
  const VectorXd exact = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(a.matrix()).solve(b);
  CHECK((s.x - exact).norm() < 1e-9 * exact.norm());  // tolerance x condition number (below 1e3)
}

TEST_CASE("cg: takes Eigen's number of iterations on 5-point Laplacians") {
  const int nx = GENERATE(5, 40, 120);
  const RowOperator a(rough_laplacian(nx, nx + 3));
  const VectorXd b = random_vector(a.size(), 11);
  const double tolerance = 1e-8;
  const Solved s = solve(a, b, {tolerance, 5000});
  REQUIRE(s.report.converged());
  CHECK(s.report.residual <= tolerance);
  CHECK(relative_residual(a, b, s.x) <= 1.01 * tolerance);
  Eigen::ConjugateGradient<test::EigenRows, Eigen::Lower | Eigen::Upper> eigen(a.matrix());
  eigen.setTolerance(tolerance);
  eigen.setMaxIterations(5000);
  const VectorXd theirs = eigen.solve(b);
  // Same algorithm: rounding alone moves the iteration at which the tolerance is met.
  CHECK(std::abs(s.report.iterations - static_cast<int>(eigen.iterations())) <= 2 + s.report.iterations / 50);
}

TEST_CASE("cg: starts from the given vector, measures in the given scale") {
  const RowOperator a(rough_laplacian(20, 20));
  const VectorXd exact = random_vector(a.size(), 1), b = a.matrix() * exact;
  CgOptions options{1e-8, 5000};
  options.from_zero = false;
  CHECK(solve(a, b, options, exact).report.iterations == 0);
  const Solved near = solve(a, b, options, exact + 1e-6 * random_vector(a.size(), 2));
  CHECK(near.report.converged());
  CHECK(near.report.iterations < solve(a, b, {1e-8, 5000}).report.iterations);
  CgOptions coarse{1e-8, 5000};
  coarse.scale = 1e6 * b.norm();
  const Solved rough = solve(a, b, coarse);
  CHECK(relative_residual(a, b, rough.x) <= 1.01e-2);
  CHECK(rough.report.residual <= 1e-8);
}

TEST_CASE("cg: a zero right-hand side gives zero at once") {
  const RowOperator a(rough_laplacian(9, 4));
  const Solved s = solve(a, VectorXd::Zero(a.size()), {});
  CHECK(s.report.converged());
  CHECK(s.report.iterations == 0);
  CHECK(s.x.norm() == 0);
}

TEST_CASE("cg: a consistent singular system is solved in the range of the operator") {
  const int n = 30;
  const RowOperator a(test::five_points(n, n, 0.0, [](int, int) { return 1.0; }));
  VectorXd b = random_vector(n * n, 4);
  b.array() -= b.mean();
  const Solved s = solve(a, b, {1e-10, 2000});
  CHECK(s.report.converged());
  CHECK(relative_residual(a, b, s.x) < 1e-9);
}

TEST_CASE("cg: says when it cannot converge") {
  const RowOperator a(rough_laplacian(40, 40));
  const VectorXd b = random_vector(a.size(), 6);
  SECTION("too few iterations") {
    const Solved s = solve(a, b, {1e-10, 5});
    CHECK(s.report.outcome == CgReport::Outcome::iteration_limit);
    CHECK(s.report.iterations == 5);
    CHECK(s.report.residual == Approx(relative_residual(a, b, s.x)).epsilon(1e-6));
    CHECK(linear::describe(s.report).find("not converged within the limit of 5 iterations") == 0);
  }
  SECTION("an indefinite operator") {
    test::EigenRows flipped = a.matrix();
    flipped.coeffRef(7, 7) = -1e3;
    ConjugateGradients cg;
    cg.resize(a.size());
    // With a positive preconditioner a negative eigenvalue shows as soon as the Krylov space has met it.
    const Field<double> x = test::to_field(VectorXd::Zero(a.size())),
                        ones = test::to_field(VectorXd::Ones(a.size()));
    const CgReport report = cg.solve(RowOperator(flipped), Jacobi{ones}, test::to_field(b), x, {1e-10, 5000});
    CHECK(report.outcome == CgReport::Outcome::not_positive);
    CHECK(test::to_eigen(x, a.size()).allFinite());
  }
  SECTION("a right-hand side that is not a number") {
    VectorXd bad = b;
    bad[17] = std::numeric_limits<double>::quiet_NaN();
    CHECK(solve(a, bad, {1e-10, 5000}).report.outcome == CgReport::Outcome::not_positive);
  }
  SECTION("an empty row with a right-hand side") {
    test::EigenRows cut = a.matrix();
    for (int k = 0; k < cut.rows(); ++k) cut.coeffRef(k, k) += 1;
    cut.prune([](int row, int column, double) { return row != 9 && column != 9; });
    ConjugateGradients cg;
    cg.resize(a.size());
    VectorXd d = VectorXd::Zero(cut.rows());
    for (int k = 0; k < cut.rows(); ++k) d[k] = k == 9 ? 0 : 1 / cut.coeff(k, k);
    const Field<double> x("x", static_cast<size_t>(a.size()));
    const CgReport report =
        cg.solve(RowOperator(cut), Jacobi{test::to_field(d)}, test::to_field(b), x, {1e-10, 50});
    CHECK_FALSE(report.converged());
    CHECK(x(9) == 0);
  }
}

TEST_CASE("cg: allocates once, and launches three passes per iteration beside the operator's sum") {
  const RowOperator a(rough_laplacian(30, 30));
  const Field<double> b = test::to_field(random_vector(a.size(), 8)), d = a.inverse_diagonal(),
                      x = test::to_field(VectorXd::Zero(a.size()));
  ConjugateGradients cg;
  cg.resize(a.size());
  (void)cg.solve(a, Jacobi{d}, b, x, {1e-3, 1});
  test::Recording recording;
  cg.resize(a.size());
  const CgReport report = cg.solve(a, Jacobi{d}, b, x, {1e-6, 1000});
  REQUIRE(report.converged());
  CHECK(recording.allocations.empty());
  CHECK(recording.launches.size() == static_cast<std::size_t>(3 + 3 * report.iterations));
}

TEST_CASE("cg: the worker of the test of threads", "[.]") {
  const RowOperator a(rough_laplacian(90, 70));
  const Solved s = solve(a, random_vector(a.size(), 12), {1e-8, 5000});
  test::say(s.x.data(), a.size());
}

TEST_CASE("cg: the same bits with one, two and three threads") {
  const std::string one = test::said("cg: the worker of the test of threads", 1);
  CHECK_FALSE(one.empty());
  CHECK(test::said("cg: the worker of the test of threads", 2) == one);
  CHECK(test::said("cg: the worker of the test of threads", 3) == one);
}
