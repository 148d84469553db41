// Errors of the fluid particles against the scene's exact solution.
#pragma once
#include <vector>

#include "cellgrid/fields.hpp"
#include "src/io/fluid.hpp"
#include "src/io/summary.hpp"
#include "src/scene/scene.hpp"

namespace freshet {

// All norms below at one time, over the particles (and cells) inside scene.compare.where.
ErrorNorms error_norms(const Scene& scene, const Fluid& fluid, double t);

// sqrt(sum (d - d_e)^2 / sum d_e^2) over the particles; likewise their largest |d - d_e| [m] and rms |v -
// v_e| [m/s]. Over those with d_e above scene.compare.threshold: the rms norms of thesis (2.58) and (2.59).
ErrorNorms particle_errors(const Scene& scene, const Fluid& fluid, double t);

// Mean of |d - d_e| / d_e over the particles with d_e above scene.compare.threshold.
double depth_l1(const Scene& scene, const Fluid& fluid, double t);

double median(std::vector<double> values);  // unknown for no values

// Regular cells over the domain, values at their centres.
struct Grid {
  Point low{};                   // m
  std::array<double, 2> cell{};  // m
  std::array<int, 2> count{1, 1};
  double x(int i) const { return low[0] + (i + 0.5) * cell[0]; }
  double y(int j) const { return low[1] + (j + 0.5) * cell[1]; }
};
Grid comparison_grid(const Scene& scene);

// sum_j m_j W_j / max(sum_j V_j W_j, 0.95) with V_j = m_j / depth_j and the cubic spline of the particles' own
// h, x fastest [m]: the plain sum outside the water, where the Shepard mean would spread it, and normalised
// inside.
std::vector<double> depth_on_grid(const Grid& grid, int dimension, const Fluid& fluid);

// Relative l2 error on the grid; cells that are dry in the exact solution count as zero depth.
double grid_l2(const Scene& scene, const Fluid& fluid, double t);

}  // namespace freshet
