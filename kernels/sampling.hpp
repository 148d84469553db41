// What a fixed place sees of sorted water: for gauges and run-up points. Reads the views on the host.
#pragma once
#include "kernels/raster.hpp"

namespace freshet {

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
