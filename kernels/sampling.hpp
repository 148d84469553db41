// What a fixed place sees of sorted water: for gauges and run-up points. Reads the views on the host.
#pragma once
#include <array>

#include "kernels/raster.hpp"

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

// Highest level [m] under water at least min_depth deep within radius of the place; -1e300 if none. No levels = a flat bed at 0.
template <int D>
double highest_wet_level(const SortedWater<D>& water, const Field<double>& level, const Vec<double, D>& place, double radius,
                         double min_depth);

}  // namespace freshet
