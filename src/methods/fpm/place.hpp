// The points that a flow starts with: on the outline of each body and on a lattice (in circles: on rings)
// inside it.
#pragma once
#include <vector>

#include "src/scene/scene.hpp"

namespace freshet::fpm {

struct StartPoint {
  Point x;         // m
  Point velocity;  // m/s
};

// Throws SceneError where a body holds no point.
std::vector<StartPoint> place_points(const Scene& scene);

}  // namespace freshet::fpm
