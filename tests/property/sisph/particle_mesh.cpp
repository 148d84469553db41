// The free-surface solver at size: iterations to 1e-8 with 125,316 particles moved by up to 0.2 dx.
#include "tests/support/solve/solve_cost.hpp"

using namespace freshet;

TEST_CASE("particle mesh: iterations at 125,316 particles") {
  test::PairScene scene;
  scene.n = 354;
  scene.courant = GENERATE(20.0, 100.0);
  const test::SolveCost cost = test::cost_of(scene, 1e-8);
  INFO("Courant " << scene.courant << ": Jacobi " << cost.plain.iterations << ", with the mesh "
                  << cost.meshed.iterations);
  CHECK(cost.meshed.converged());
  CHECK(cost.plain.iterations > 100);  // plain CG was measured to take 132 and 483
  CHECK(cost.meshed.iterations <= (scene.courant < 50 ? 15 : 20));
}
