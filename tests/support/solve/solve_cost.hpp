// What it takes to solve the free-surface system of a scene for a wave with noise: Jacobi alone, and with the
// particle mesh.
#pragma once
#include <catch2/catch.hpp>

#include "kernels/linear/cg.hpp"
#include "kernels/linear/mesh/particle_mesh.hpp"
#include "tests/support/points/pair_system.hpp"

namespace freshet::test {

struct SolveCost {
  linear::CgReport plain, meshed;
};
SolveCost cost_of(const PairScene& scene, double tolerance);

}  // namespace freshet::test
