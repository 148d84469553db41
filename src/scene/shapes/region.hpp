// Parts of the domain that a table of the scene names by `box` or `polygon`.
#pragma once
#include <vector>

#include "src/scene/toml/table.hpp"

namespace freshet::input {

// The corners of `box = [x0, y0, x1, y1]` or `polygon = [[x, y], ...]`; 1-D: both ends of `box = [x0, x1]`.
// Empty after an error.
std::vector<Point> read_region(Table& region, int dimension);

}  // namespace freshet::input
