// The free-surface system of the semi-implicit method over disordered particles, made directly from its
// formulas (not by the project's kernels): omega_i x_i + sum_j a_ij (x_i - x_j), a_ij = k A_ij H_ij / d_ij,
// A_ij = omega_i omega_j G_ij (1/s_i + 1/s_j).
#pragma once
#include <cmath>
#include <functional>

#include "cellgrid/particles/order.hpp"
#include "tests/support/points/cloud.hpp"
#include "tests/support/solve/linear_systems.hpp"

namespace freshet::test {

struct PairSystem {
  FieldSet fields;
  RowOrder order;
  VecField<double, 2> x;
  std::vector<double> omega, depth;
  EigenRows matrix;
  Field<double> mass, depth_field;  // of wet particles; 0 elsewhere
};

struct PairScene {
  int n = 50;             // particles along each side of the unit square
  double disorder = 0.2;  // x dx
  double courant = 20;    // dt sqrt(g 1 m) / dx
  std::function<double(double, double)> depth = [](double, double) { return 1.0; };  // m; <= 0: dry
};

PairSystem pair_system(const PairScene& scene);

// k = g theta^2 dt^2 of the scene, as the preconditioner asks for it [m, for depths in m].
inline double stiffness(const PairScene& scene) { return std::pow(0.55 * scene.courant / scene.n, 2); }

}  // namespace freshet::test
