// One-dimensional wet dam break against Stoker's exact solution (Vacondio 2010, Table 2.1, which is an L1).
#include <catch2/catch.hpp>

#include <cmath>

#include "tests/support/run/run_case.hpp"

using namespace freshet;

namespace {

struct Row {
  double eta, dx, bound;  // -, m, median relative L1 of the depth
};

double depth_l1(double eta, double dx) {
  return test::run_case("dam_break_wet",
                        {"sph.eta=" + std::to_string(eta), "water.spacing=" + std::to_string(dx)})
      .errors.depth_l1_rel;
}

}  // namespace

TEST_CASE("the wet dam break is at least as accurate as the best that is known of the scheme") {
  // eta 1.2: what the thesis prints for Lax-Friedrichs with MUSCL, the last number and half of its last
  // digit. eta 1.0: the lattice sum is exact; what holds it is the order below, beside an independent
  // prototype's 5.9e-3 ... 7.3e-4 and a sixth more.
  const Row row =
      GENERATE(Row{1.2, 20, 1.0e-2}, Row{1.2, 10, 5.9e-3}, Row{1.2, 5, 3.9e-3}, Row{1.2, 2.5, 2.65e-3},
               Row{1.0, 20, 6.8e-3}, Row{1.0, 10, 3.4e-3}, Row{1.0, 5, 1.7e-3}, Row{1.0, 2.5, 8.5e-4});
  CAPTURE(row.eta, row.dx);
  CHECK(depth_l1(row.eta, row.dx) <= row.bound);
}

TEST_CASE("the wet dam break converges with first order where the lattice sum is exact") {
  // An L1 across a captured shock is at best of first order; 0.9 leaves room for the phase of the shock
  // between particles.
  const double order = std::log2(depth_l1(1.0, 20) / depth_l1(1.0, 2.5)) / 3;
  CHECK(order >= 0.9);
}
