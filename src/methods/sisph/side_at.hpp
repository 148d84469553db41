// What lies on the side of the domain that a place outside it stands behind: a wall, an open boundary, or
// neither.
#pragma once
#include "src/scene/scene.hpp"

namespace freshet::sisph {

struct SideAt {
  bool wall = false;
  int opening = -1;    // index of the boundary
  Point n{};           // its normal out of the water
  double outside = 0;  // m, behind its line
};

SideAt side_at(const Scene& scene, const Point& place);

// Throws SceneError where an open boundary is not on a side of the domain.
void require_on_sides(const Scene& scene);

}  // namespace freshet::sisph
