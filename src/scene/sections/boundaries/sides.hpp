// The walls of a box with openings.
#pragma once
#include "src/scene/scene.hpp"

namespace freshet::input {

// Adds the four sides of the domain (1-D: both ends), counter-clockwise so that the water is on their left,
// less what the open boundaries occupy. Sides that meet at a corner make one line; a closed box repeats its
// first point.
void add_box_walls(Scene& scene);

}  // namespace freshet::input
