// Places for the points of a body whose spacing varies: along its outline, and inside wherever the places
// chosen before leave room.
#pragma once
#include <vector>

#include "src/scene/scene.hpp"

namespace freshet::fpm {

struct Seed {
  Point x;      // m
  bool inside;  // off the outline: may be displaced
};

// The spacing [m] at a place.
double spacing_at(const Scene& scene, const Point& x);

std::vector<Seed> graded_nodes(const Scene& scene, const std::vector<Point>& outline);

}  // namespace freshet::fpm
