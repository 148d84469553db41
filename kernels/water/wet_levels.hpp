// How high water has come at a place [m]; -1e300: there was none.
//   bed:  under the highest wet particle: where its centre stands
//   line: where its surface meets the bed: bed + min(depth, spacing |grad b|), the surface of that water, no
//   higher than the bed a spacing
//         up the slope. Particles at rest are wet or dry, so that `bed` rises in steps of spacing |grad b|;
//         `line` does not.
#pragma once
#include "cellgrid/parallel/types.hpp"

namespace freshet {

struct WetLevels {
  double bed = -1e300, line = -1e300;
};

// Which water counts: at least min_depth [m] deep, within radius [m] of the place (1-D: y = 0).
struct ShorePlace {
  double x, y, radius, min_depth;
};

// Shores and the highest water that each has seen so far, on the device.
struct Shores {
  Kokkos::View<ShorePlace*, Memory> shore;
  Kokkos::View<WetLevels*, Memory> highest;
};

}  // namespace freshet
