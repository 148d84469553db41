// What fixed places see of sorted water: for gauges and run-up points. Found on the device; the host reads
// some bytes per place.
#pragma once
#include <array>
#include <vector>

#include "kernels/ground/bed_spline.hpp"
#include "kernels/water/raster.hpp"
#include "kernels/water/wet_levels.hpp"

namespace freshet {

struct SampledDepth {
  double bed = 0;    // m
  double depth = 0;  // m, 0 if no particle reaches the place
  int reached = 0;   // whether some particle's support covers it
};

// Keeps the places on the device for the next call.
template <int D>
class Sampler {
 public:
  // Of each place [m] the Shepard mean over the water within 2h, its cover held above 1/4. No bed = flat, at
  // 0.
  std::vector<SampledDepth> sample(const SortedWater<D>& water, const BedSpline<D>* bed,
                                   const std::vector<std::array<double, 2>>& places);

 private:
  void lay(const std::vector<std::array<double, 2>>& places);

  std::vector<std::array<double, 2>> places_;
  Kokkos::View<Vec<double, D>*, Memory> place_;
  Kokkos::View<SampledDepth*, Memory> found_;
};

// Raises what each shore has seen so far to the highest of its water now. No bed = flat, at 0. spacing: of
// the particles [m].
template <int D>
void raise_wet_levels(const SortedWater<D>& water, const BedSpline<D>* bed, double spacing,
                      const Shores& shores);

}  // namespace freshet
