// What a fixed place sees of sorted water: for gauges and run-up points. Reads the views on the host.
#pragma once
#include <array>

#include "kernels/bed_spline.hpp"
#include "kernels/raster.hpp"
#include "kernels/wet_levels.hpp"

namespace freshet {

// x and, in 2-D, y [m].
template <int D>
Vec<double, D> to_vec(const std::array<double, 2>& point) {
  Vec<double, D> place;
  place.x = point[0];
  if constexpr (D == 2) place.y = point[1];
  return place;
}

struct SampledDepth {
  double depth = 0;      // m, 0 if no particle reaches the place
  bool reached = false;  // some particle's support covers it
};

// Shepard mean over the water within 2h, its cover held above 1/4.
template <int D>
SampledDepth sample_depth(const SortedWater<D>& water, const Vec<double, D>& place);

// Which water counts: at least min_depth [m] deep, within radius [m] of the place.
template <int D>
struct Shore {
  Vec<double, D> place;
  double radius, min_depth;
  double spacing;  // m, of the particles
};

// The highest of it. No bed = flat, at 0.
template <int D>
WetLevels highest_wet_levels(const SortedWater<D>& water, const BedSpline<D>* bed, const Shore<D>& shore);

}  // namespace freshet
