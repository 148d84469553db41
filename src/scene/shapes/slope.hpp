// How steep a scene's bed is, as the particles will feel it.
#pragma once
#include "src/scene/scene.hpp"

namespace freshet {

// Largest |grad b| [1]: differences over windows as wide as the lattice or as the filter s [m] smears a jump:
// one of height J has the slope J / (s sqrt(2 pi)) after the filter, J / 2.5 s here. 0 without a bed.
double steepest_slope(const Scene& scene);

}  // namespace freshet
