// Errors of the fluid particles against the scene's exact solution.
#pragma once
#include <vector>

#include "src/io/fluid.hpp"
#include "src/run/record/water_grid.hpp"
#include "src/text.hpp"

namespace freshet {

struct ErrorNorms {
  double depth_l1_rel = unknown, depth_l2_rel = unknown, grid_l2_rel = unknown;
  double depth_linf = unknown;         // m
  double velocity_l2 = unknown;        // m/s
  double depth_l2_mean_rel = unknown;  // thesis (2.58): rms of (d - d_e) / d_e
  double velocity_l2_x = unknown,
         velocity_l2_y = unknown;  // thesis (2.59): rms of (v_k - v_k,e) / sqrt(g d_e)
};

// The two below together, over the particles inside scene.compare.where.
ErrorNorms error_norms(const Scene& scene, const Fluid& fluid, double t);

// sqrt(sum (d - d_e)^2 / sum d_e^2) over the particles; likewise their largest |d - d_e| [m] and rms |v -
// v_e| [m/s]. Over those with d_e above scene.compare.threshold: the rms norms of thesis (2.58) and (2.59).
ErrorNorms particle_errors(const Scene& scene, const Fluid& fluid, double t);

// Mean of |d - d_e| / d_e over the particles with d_e above scene.compare.threshold.
double depth_l1(const Scene& scene, const Fluid& fluid, double t);

double median(std::vector<double> values);  // unknown for no values

CellGrid comparison_grid(const Scene& scene);

// Relative l2 error on the grid; cells that are dry in the exact solution count as zero depth.
// (smeared_depth: the plain sum beyond the water's edge, where a Shepard mean would spread it, and normalised
// inside.)
double grid_l2(const Scene& scene, const Method& method, double t);

}  // namespace freshet
