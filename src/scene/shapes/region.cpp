#include "src/scene/shapes/region.hpp"

namespace freshet::input {
namespace {

std::vector<Point> box_corners(Table& region, int dimension) {
  Value<std::vector<double>> box =
      region.numbers("box", dimension == 1 ? "numbers in m: x0, x1" : "numbers in m: x0, y0, x1, y1");
  const std::vector<double> b = box.otherwise({});
  const std::size_t needed = dimension == 1 ? 2 : 4;
  const bool ordered = b.size() == needed && b[0] < b[needed / 2] && (dimension == 1 || b[1] < b[3]);
  if (box.optional() && !ordered)
    box.fail("'" + region.path_of("box") + "' must be " + (dimension == 1 ? "[x0, x1]" : "[x0, y0, x1, y1]") +
             ", its low corner first");
  if (!ordered) return {};
  if (dimension == 1) return {{b[0], 0}, {b[1], 0}};
  return {{b[0], b[1]}, {b[2], b[1]}, {b[2], b[3]}, {b[0], b[3]}};
}

std::vector<Point> polygon_corners(Table& region, int dimension) {
  Value<std::vector<Point>> polygon = region.points("polygon");
  const std::vector<Point> corners = polygon.otherwise({});
  if (dimension == 1) region.error("polygon", "a 1-D scene has no polygons", "write box = [x0, x1]");
  else if (polygon.optional() && corners.size() < 3)
    region.error("polygon", "'" + region.path_of("polygon") + "' must have three points at least");
  return corners;
}

}  // namespace

std::vector<Point> read_region(Table& region, int dimension) {
  const std::string shape = region.one_of({"box", "polygon"}, true);
  if (shape == "box") return box_corners(region, dimension);
  if (shape == "polygon") return polygon_corners(region, dimension);
  return {};
}

}  // namespace freshet::input
