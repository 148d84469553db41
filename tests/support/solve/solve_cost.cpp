#include "tests/support/solve/solve_cost.hpp"

#include <catch2/catch.hpp>

namespace freshet::test {

SolveCost cost_of(const PairScene& scene, double tolerance) {
  const PairSystem s = pair_system(scene);
  const RowOperator a(s.matrix);
  Random random(3);
  Field<double> b("b", static_cast<size_t>(a.size())), x("x", static_cast<size_t>(a.size()));
  for (int i = 0; i < a.size(); ++i)  // a wave and noise
    b(i) = s.mass(i) * (std::exp(-30 * std::pow(s.x.x(i) - 0.4, 2) - 20 * std::pow(s.x.y(i) - 0.5, 2)) +
                        0.1 * random(-1, 1));
  const Field<double> d = a.inverse_diagonal();
  linear::ParticleMesh<2> mesh;
  mesh.lay(s.order.rows(), s.x, a.size());
  mesh.set(s.mass, s.depth_field, stiffness(scene));
  linear::ConjugateGradients cg;
  cg.resize(a.size());
  const linear::CgReport meshed =
      cg.solve(a, linear::JacobiPlus<linear::ParticleMesh<2>>{d, mesh}, b, x, {tolerance, 500});
  const Eigen::VectorXd residual = to_eigen(b, a.size()) - a.matrix() * to_eigen(x, a.size());
  CHECK(residual.norm() < 1.1 * tolerance * to_eigen(b, a.size()).norm());
  const linear::CgReport plain = cg.solve(a, linear::Jacobi{d}, b, x, {tolerance, 2000});
  return {plain, meshed};
}

}  // namespace freshet::test
