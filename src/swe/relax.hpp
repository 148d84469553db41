// A start in which particles lie still along slanting and curved walls.
#pragma once
#include "src/scene/place.hpp"

namespace freshet::swe {

// Cells (place.hpp) pushed by the scheme's own pressure: one metre of water over a flat bed within the scene's walls, slowed
// down in each step until it lies still. Each particle then stands for the area that its density gives it. depth [m] must be
// positive all over the walled basin and nothing may be open, else SceneError: the water would run away.
template <int D>
std::vector<Placed> relaxed_lattice(const Scene& scene, const Function& depth);

}  // namespace freshet::swe
