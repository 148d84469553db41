#include "src/scene/shapes/shapes.hpp"

#include <cmath>

#include "src/scene/shapes/floodplain.hpp"
#include "src/scene/toml/table.hpp"

namespace freshet::input {
namespace {

// A place that may be given by x alone.
struct Middle {
  Point at{};
  bool ridge = true;  // x alone counts
};

Middle read_middle(Table& shape, const std::string& key, int dimension, bool needed) {
  Middle middle;
  middle.ridge = dimension == 1 || shape.has_number(key) || !shape.has(key);
  auto at = shape.point(key, middle.ridge ? 1 : 2);
  middle.at = needed ? at.required() : at.otherwise({0, 0});
  return middle;
}

Function hump(Table& shape, int dimension) {
  const Middle middle = read_middle(shape, "at", dimension, true);
  const double height = shape.number("height", "m").required();
  const double width = shape.number("width", "m").positive().required(1);
  return [=](double x, double y) {
    const double r = std::hypot(x - middle.at[0], middle.ridge ? 0.0 : y - middle.at[1]);
    return r < 0.5 * width ? 0.5 * height * (1 + std::cos(2 * pi * r / width)) : 0.0;
  };
}

Function step(Table& shape, int) {
  const double at = shape.number("at", "m").required();
  const double left = shape.number("left", "m").required(), right = shape.number("right", "m").required();
  return [=](double x, double) { return x < at ? left : right; };
}

Function paraboloid(Table& shape, int dimension) {
  const double depth = shape.number("depth", "m").positive().required();
  const double radius = shape.number("radius", "m").positive().required(1);
  const Point centre = shape.point("centre", dimension).otherwise({0, 0});
  return [=](double x, double y) {
    const double rx = x - centre[0], ry = dimension == 1 ? 0 : y - centre[1];
    return depth * ((rx * rx + ry * ry) / (radius * radius) - 1);
  };
}

Function slope(Table& shape, int dimension) {
  const Middle from = read_middle(shape, "from", dimension, false);
  const bool along_x = dimension == 1 || shape.has_number("gradient");
  const Point gradient = shape.point("gradient", along_x ? 1 : 2).required();
  const double level = shape.number("level", "m").otherwise(0);
  return [=](double x, double y) {
    return level + gradient[0] * (x - from.at[0]) + gradient[1] * (y - from.at[1]);
  };
}

Function plain(Table& shape, int dimension) {
  Floodplain plain;
  plain.seed = shape.integer("seed").at_least(0).otherwise(plain.seed);
  const std::vector<double> box =
      shape.numbers("box", "numbers in m: x0, y0, x1, y1").otherwise({0, 0, 9000, 4000});
  if (dimension == 1 || box.size() != 4 || !(box[0] < box[2] && box[1] < box[3]))
    shape.error("box", "a flood plain has a box [x0, y0, x1, y1] in a 2-D scene, its low corner first");
  else plain.low = {box[0], box[1]}, plain.high = {box[2], box[3]};
  return floodplain(plain);
}

Function macdonald_channel(Table& shape, int) {
  const ChannelFlow flow = read_channel_flow(shape);
  const double manning = shape.number("manning", "s/m^(1/3)").at_least(0).required();
  const double length = shape.number("length", "m").positive().required(1);
  return flow.depth ? macdonald_bed(flow, manning, length, shape.context().gravity) : Function{};
}

}  // namespace

ChannelFlow read_channel_flow(Table& table) {
  return {table.function("depth").required(), table.number("discharge", "m2/s").positive().required(1)};
}

Function read_shape(Table& shape, int dimension, std::string& description) {
  using Reader = Function (*)(Table&, int);
  const Reader reader = shape
                            .choice<Reader>("type", {{"hump", hump},
                                                     {"step", step},
                                                     {"paraboloid", paraboloid},
                                                     {"slope", slope},
                                                     {"floodplain", plain},
                                                     {"macdonald", macdonald_channel}})
                            .required();
  if (!reader) {
    shape.accept_rest();  // without its type nobody knows which keys belong to it
    return {};
  }
  description = "shape " + shape.text("type").required();
  return reader(shape, dimension);
}

}  // namespace freshet::input
