// A start in which particles lie still along slanting and curved walls.
#pragma once
#include "src/scene/place/place.hpp"

namespace freshet::swe {

// Cells (place.hpp) pushed by the scheme's own pressure within the scene's walls and slowed down in each step
// until they lie still: the scene's own lake where its surface is level and its water at rest (shores
// included), else one metre of water over a flat bed. Masses follow until every density is the depth. Throws
// SceneError where something is open or, at the end, a particle stands where the scene's depth [m] is not
// positive: water over a dry floor would run away.
template <int D>
std::vector<Placed> relaxed_lattice(const Scene& scene);

}  // namespace freshet::swe
