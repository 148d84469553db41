// Density by the variable-h summation (Vacondio 2010, (2.4)-(2.12)) fused with alpha (2.32), d rho/dt (2.34)
// and the least-squares gradient of v: docs/formulas/swe.md (S7) to (S14).
#pragma once
#include "kernels/boundaries/walls/walls.hpp"
#include "kernels/swe/particles.hpp"

namespace freshet::swe {

struct DensityOptions {
  double gravity;        // m/s2
  double tolerance;      // of |rho - sum m W| / rho
  double margin;         // growth of h that the neighbour list still covers
  LengthBounds bounds;   // of h
  bool gradient;         // the stabilisation reconstructs velocities
  double imposed_alpha;  // of particles with an imposed state
  double ahead;  // extrapolation of d rho/dt to the middle of the next step: 1/2 at equal steps, 0 = none
  // what the sum is multiplied by (well-balanced runs, well_balanced.hpp); empty = 1
  Field<double> calibration = {};
};

struct DensityReport {
  double newton_mean = 0;  // evaluations per cluster
  int newton_max = 0;
  int outgrown = 0;  // particles whose h outgrew the list: the list must be made again with the h found
  int capped = 0, floored = 0;
};

// 2-D, cubic spline, no walls: the first evaluation with d rho/dt, or also with the gradient, and each
// further one.
inline constexpr Cost density_gradient_cost{52, 120, 21}, density_rate_cost{43, 100, 18},
    density_again_cost{35, 40, 0};

// Reads x, v_pred, m, kh, h0, rho (predicted), h (of the list); writes rho, h, inv_h, pressure, celerity,
// weight, rate, growth, strain.
template <int D>
DensityReport solve_density(const AnyKernel<D>& kernel, const ClusterSet& clusters, const NeighbourView& near,
                            const WallView<D>& walls, const Particles<D>& p, const ImposedLanes& imposed,
                            const DensityOptions& options);

// Sets the calibration with which the sum at the particles' places gives the depths that they have; within
// 1/2 and 2, which only particles at a shore exceed.
template <int D>
void calibrate_density(const AnyKernel<D>& kernel, const ClusterSet& clusters, const NeighbourView& near,
                       const WallView<D>& walls, const Particles<D>& p, const Field<double>& calibration);

}  // namespace freshet::swe
