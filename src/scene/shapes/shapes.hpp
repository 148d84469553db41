// Named bed shapes: `shape = { type = "hump", ... }`.
#pragma once
#include <string>

#include "src/reference/macdonald.hpp"
#include "src/scene/scene.hpp"

namespace freshet::input {

class Table;

// hump        height [m], at = x or [x, y] (the middle), width [m]: (height/2)(1 + cos(2 pi r/width)) for r <
// width/2;
//             thesis (1.13) with its c is height = 2 c, at = 0.5, width = 0.5. One number `at` in 2-D is a
//             ridge along y.
// step        at = x [m], left, right [m]: the bed left and right of it
// paraboloid  depth [m] of the vertex below z = 0, radius [m] of the contour z = 0, centre = [x, y]
// slope       gradient = dz/dx or [dz/dx, dz/dy], from = x or [x, y] [m] where the level is `level` [m]
// (default 0)
// floodplain  seed (default 1), box = [x0, y0, x1, y1] [m] (default 9 x 4 km): floodplain.hpp
// macdonald   depth (expression [m]), discharge [m2/s], manning [s/m^(1/3)], length [m]: macdonald.hpp
Function read_shape(Table& shape, int dimension, std::string& description);

// depth, discharge: the flow of a MacDonald channel; no depth after an error.
ChannelFlow read_channel_flow(Table& table);

}  // namespace freshet::input
