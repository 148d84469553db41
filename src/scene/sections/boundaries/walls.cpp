// [[wall]]: at | line | polygon | circle.
#include <algorithm>
#include <cmath>

#include "kernels/boundaries/walls/polyline.hpp"
#include "src/scene/sections/boundaries/sides.hpp"
#include "src/scene/sections/sections.hpp"

namespace freshet::input {
namespace {

enum class WaterSide { inside, outside };

WaterSide read_side_of_water(Table& section) {
  return section.choice<WaterSide>("water", {{"inside", WaterSide::inside}, {"outside", WaterSide::outside}})
      .required(WaterSide::inside);
}

// Closed, and turned so that the water is on the left.
void add_closed(std::vector<Point> line, WaterSide side, Scene& scene) {
  if (line.front() != line.back()) line.push_back(line.front());
  const bool counter_clockwise = signed_area(line) > 0;
  if (counter_clockwise != (side == WaterSide::inside)) std::reverse(line.begin(), line.end());
  scene.walls.push_back({line});
}

void read_at(Table& section, Scene& scene) {
  Value<double> at = section.number("at", "m");
  if (scene.domain.dimension != 1)
    at.fail("'wall.at' belongs to 1-D scenes", "write line = [[x, y], [x, y]]");
  if (!at.optional()) return;
  const Point point{*at.optional(), 0};
  if (require_inside(section, "at", "the wall", point, scene)) scene.walls.push_back({{point}});
}

// The points of `key`, at least `least` of them, all in the domain; empty after an error.
std::vector<Point> read_corners(Table& section, const std::string& key, std::size_t least,
                                const Scene& scene) {
  Value<std::vector<Point>> line = section.points(key);
  if (!line.optional()) return {};
  const std::vector<Point> points = *line.optional();
  if (scene.domain.dimension == 1) {
    line.fail("a 1-D scene has no lines", "write at = x, or line = \"box\" for both ends");
  } else if (points.size() < least) {
    line.fail("a wall's " + key + " needs at least " + std::to_string(least) + " points");
  }
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    if (points[k] == points[k + 1]) {
      line.fail("point " + std::to_string(k + 2) + " of the wall repeats the one before it",
                "remove one of them");
      break;
    }
  }
  for (const Point& point : points) {
    if (!line.optional() || !require_inside(section, key, "the wall", point, scene)) return {};
  }
  return points;
}

void read_polygon(Table& section, Scene& scene) {
  const WaterSide side = read_side_of_water(section);
  const std::vector<Point> points = read_corners(section, "polygon", 3, scene);
  if (points.empty()) return;
  if (crosses_itself(points)) {
    section.error("polygon", "the wall's polygon crosses itself", "name its corners in order, once round");
    return;
  }
  add_closed(points, side, scene);
}

// A circle as a polygon whose sides are about half a spacing long; its corners lie as far outside as their
// middles inside, so that it holds the circle's area.
void read_circle(Table& section, Scene& scene) {
  const WaterSide side = read_side_of_water(section);
  Table circle = section.table("circle");
  if (!circle.given()) return;
  const Point centre = circle.point("centre", 2).required();
  const double radius = circle.number("radius", "m").positive().required(1);
  if (scene.domain.dimension == 1) {
    section.error("circle", "a 1-D scene has no circles", "write at = x");
    return;
  }
  const int sides =
      std::max(12, static_cast<int>(std::lround(2 * pi * radius / (0.5 * scene.water.spacing))));
  const double corner = radius * std::sqrt(2 * pi / (sides * std::sin(2 * pi / sides)));
  std::vector<Point> points;
  for (int k = 0; k < sides; ++k)
    points.push_back({centre[0] + corner * std::cos(2 * pi * k / sides),
                      centre[1] + corner * std::sin(2 * pi * k / sides)});
  add_closed(points, side, scene);
}

// Where the free end of an open wall meets nothing, water leaks out: the distance to what is nearest is told.
void note_leak(Table& section, const Scene& scene, std::size_t wall, const Point& end) {
  double gap = 1e300;
  for (std::size_t other = 0; other < scene.walls.size(); ++other) {
    const std::vector<Point>& line = scene.walls[other].line;
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const bool own_end =
          other == wall && (k == 0 || k + 2 == line.size()) && (line[k] == end || line[k + 1] == end);
      if (!own_end) gap = std::min(gap, distance(end, piece_between(line[k], line[k + 1])));
    }
    if (other == wall && line.size() > 2) gap = std::min(gap, distance(line.front(), Polyline{line.back()}));
  }
  for (const OpenBoundary& boundary : scene.boundaries) gap = std::min(gap, distance(end, boundary.line));
  if (gap <= 1e-6 * scene.water.spacing || gap > 1e299) return;
  section.context().notes.push_back("a wall ends at " + shown(end, scene.domain) + ", " + rounded(gap) +
                                    " m from the next wall or open boundary: water can leak out there");
}

}  // namespace

void read_wall(Table& section, Scene& scene) {
  const std::string source = section.one_of({"line", "at", "polygon", "circle"}, true);
  if (source == "at") return read_at(section, scene);
  if (source == "polygon") return read_polygon(section, scene);
  if (source == "circle") return read_circle(section, scene);
  if (source.empty()) return;
  if (section.has_text("line")) {
    if (section.choice<bool>("line", {{"box", true}}).optional()) add_box_walls(scene);
    return;
  }
  const std::vector<Point> points = read_corners(section, "line", 2, scene);
  if (!points.empty()) scene.walls.push_back({points});
}

void note_leaks(Table& root, const Scene& scene) {
  if (scene.domain.dimension == 1) return;
  for (std::size_t wall = 0; wall < scene.walls.size(); ++wall) {
    const std::vector<Point>& line = scene.walls[wall].line;
    if (line.front() == line.back()) continue;
    note_leak(root, scene, wall, line.front());
    note_leak(root, scene, wall, line.back());
  }
}

}  // namespace freshet::input
