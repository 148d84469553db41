// Errors of the fluid particles against the scene's exact solution.
#pragma once
#include <vector>

#include "src/io/fluid.hpp"
#include "src/io/summary.hpp"
#include "src/run/water_grid.hpp"

namespace freshet {

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
// (smeared_depth: the plain sum beyond the water's edge, where a Shepard mean would spread it, and normalised inside.)
double grid_l2(const Scene& scene, const Method& method, double t);

}  // namespace freshet
