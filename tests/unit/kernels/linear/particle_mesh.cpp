// The particle-mesh preconditioner: symmetric, positive, and few iterations where plain CG takes hundreds.
#include "kernels/linear/mesh/particle_mesh.hpp"

#include <catch2/catch.hpp>

#include <Eigen/Dense>

#include "tests/support/solve/solve_cost.hpp"
#include "tests/support/watch/recording.hpp"
#include "tests/support/watch/threads.hpp"

using namespace freshet;
using linear::CgReport;
using linear::Jacobi;
using linear::JacobiPlus;
using linear::ParticleMesh;
using test::PairScene;
using test::PairSystem;
using test::RowOperator;

TEST_CASE("particle mesh: symmetric, positive, and r.z as returned") {
  PairScene scene;
  scene.n = 12;
  scene.depth = [](double x, double y) { return std::hypot(x - 0.4, y - 0.6) < 0.2 ? -1.0 : 1 + 0.5 * x; };
  const PairSystem s = test::pair_system(scene);
  const int n = static_cast<int>(s.omega.size());
  ParticleMesh<2> mesh;
  mesh.lay(s.order.rows(), s.x, s.fields.size());
  mesh.set(s.mass, s.depth_field, test::stiffness(scene));
  Eigen::MatrixXd c(n, n);
  for (int k = 0; k < n; ++k) {
    const Field<double> r("r", static_cast<size_t>(n)), z("z", static_cast<size_t>(n));
    r(k) = 1;
    const double rz = mesh(r, z);
    c.col(k) = test::to_eigen(z, n);
    CHECK(rz == Approx(z(k)).margin(1e-13));
  }
  CHECK((c - c.transpose()).norm() < 1e-12 * c.norm());
  CHECK(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(c).eigenvalues().minCoeff() > -1e-12 * c.norm());
  for (int k = 0; k < n; ++k)
    if (s.depth[static_cast<std::size_t>(k)] == 0) CHECK(c.col(k).norm() == 0);
}

TEST_CASE("particle mesh: few iterations at large steps") {
  PairScene scene;
  scene.n = 100;
  scene.courant = GENERATE(5.0, 20.0, 100.0);
  const test::SolveCost cost = test::cost_of(scene, 1e-8);
  INFO("Courant " << scene.courant << ": Jacobi " << cost.plain.iterations << ", with the mesh "
                  << cost.meshed.iterations);
  CHECK(cost.plain.converged());
  CHECK(cost.meshed.converged());
  CHECK(cost.meshed.iterations <= (scene.courant < 10 ? 13 : scene.courant < 50 ? 15 : 20));
}

TEST_CASE("particle mesh: few iterations around dry land and over slopes") {
  PairScene scene;
  scene.n = 100;
  scene.courant = GENERATE(5.0, 20.0, 100.0);
  scene.depth = [](double x, double y) {
    return 1 - 4 * (std::pow(x - 0.5, 2) + std::pow(y - 0.5, 2)) / 0.8;
  };  // a bowl
  const test::SolveCost cost = test::cost_of(scene, 1e-8);
  INFO("Courant " << scene.courant << ": Jacobi " << cost.plain.iterations << ", with the mesh "
                  << cost.meshed.iterations);
  CHECK(cost.meshed.converged());
  CHECK(cost.meshed.iterations <= (scene.courant < 10   ? 12
                                   : scene.courant < 50 ? 20
                                                        : 32));  // measured before: 10, 18, 30
}

TEST_CASE("particle mesh: allocates nothing once laid") {
  PairScene scene;
  scene.n = 20;
  const PairSystem s = test::pair_system(scene);
  ParticleMesh<2> mesh;
  mesh.lay(s.order.rows(), s.x, s.fields.size());
  const Field<double> r("r", s.omega.size()), z("z", s.omega.size());
  mesh.set(s.mass, s.depth_field, 1e-3);
  (void)mesh(r, z);
  test::Recording recording;
  mesh.lay(s.order.rows(), s.x, s.fields.size());
  mesh.set(s.mass, s.depth_field, 2e-3);
  (void)mesh(r, z);
  CHECK(recording.allocations.empty());
}

TEST_CASE("particle mesh: the worker of the test of threads", "[.]") {
  PairScene scene;
  scene.n = 60;
  const PairSystem s = test::pair_system(scene);
  ParticleMesh<2> mesh;
  mesh.lay(s.order.rows(), s.x, s.fields.size());
  mesh.set(s.mass, s.depth_field, test::stiffness(scene));
  const int n = static_cast<int>(s.omega.size());
  const Field<double> r("r", s.omega.size()), z("z", s.omega.size());
  for (int i = 0; i < n; ++i) r(i) = std::sin(0.37 * i);
  const double rz = mesh(r, z);
  test::say(z.data(), n);
  test::say(&rz, 1);
}

TEST_CASE("particle mesh: the same bits with one, two and three threads") {
  const std::string one = test::said("particle mesh: the worker of the test of threads", 1);
  CHECK_FALSE(one.empty());
  CHECK(test::said("particle mesh: the worker of the test of threads", 2) == one);
  CHECK(test::said("particle mesh: the worker of the test of threads", 3) == one);
}

TEST_CASE("particle mesh: a line of particles") {
  const int n = 400;
  const double dx = 1.0 / n;
  FieldSet fields = test::point_fields(1, test::lattice(1, {0, n, 0, 1}, dx));
  RowOrder order(1, dx, test::wide(dx));
  order.sort(fields);
  const VecField<double, 1> x{fields.real("x")};
  const double k = std::pow(50 * dx, 2);
  const RowOperator a(test::five_points(n, 1, dx, [&](int, int) { return k / dx; }));
  Field<double> mass("mass", static_cast<size_t>(n)), depth("depth", static_cast<size_t>(n)),
      b("b", static_cast<size_t>(n)), out("x", static_cast<size_t>(n));
  for (int i = 0; i < n; ++i) mass(i) = dx, depth(i) = 1, b(i) = dx * std::sin(0.3 * i);
  ParticleMesh<1> mesh;
  mesh.lay(order.rows(), x, n);
  mesh.set(mass, depth, k);
  linear::ConjugateGradients cg;
  cg.resize(n);
  const CgReport report =
      cg.solve(a, JacobiPlus<ParticleMesh<1>>{a.inverse_diagonal(), mesh}, b, out, {1e-8, 100});
  CHECK(report.converged());
  CHECK(report.iterations <= 15);
}
