// Places and lines as scenes name them; their geometry is in polyline.hpp.
#pragma once
#include <array>
#include <vector>

namespace freshet {

using Point = std::array<double, 2>;  // x, y [m]; 1-D: y = 0
using Polyline = std::vector<Point>;  // closed if it ends where it begins; 1-D: one point

}  // namespace freshet
