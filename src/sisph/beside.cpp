#include "src/sisph/beside.hpp"

#include <algorithm>
#include <cmath>

#include "src/errors.hpp"
#include "src/scene/water_region.hpp"

namespace freshet::sisph {
namespace {

bool is_on_side(const Domain& domain, const Point& a, const Point& b, double tolerance) {
  for (int axis = 0; axis < domain.dimension; ++axis)
    for (const double side : {domain.low[axis], domain.high[axis]})
      if (std::abs(a[axis] - side) < tolerance && std::abs(b[axis] - side) < tolerance) return true;
  return false;
}

double distance_to_wall(const Scene& scene, const Point& p) {
  double least = 1e300;
  for (const Wall& wall : scene.walls) {
    if (scene.domain.dimension == 1) least = std::min(least, std::abs(wall.line[0][0] - p[0]));
    for (std::size_t k = 0; k + 1 < wall.line.size(); ++k) least = std::min(least, distance(p, wall.line[k], wall.line[k + 1]));
  }
  return least;
}

}  // namespace

// A wall that ends where an open boundary begins has the corner behind both.
Beside beside(const Scene& scene, const Point& place) {
  const double tolerance = 1e-3 * scene.water.spacing;
  Point side = place;
  for (int axis = 0; axis < scene.domain.dimension; ++axis)
    side[axis] = std::clamp(place[axis], scene.domain.low[axis], scene.domain.high[axis]);
  Beside found;
  found.wall = distance_to_wall(scene, side) < tolerance;
  for (std::size_t o = 0; o < scene.boundaries.size() && !found.wall && found.opening < 0; ++o) {
    const std::vector<Point>& line = scene.boundaries[o].line;
    for (std::size_t k = 0; k + 1 < line.size() && found.opening < 0; ++k) {
      if (distance(side, line[k], line[k + 1]) > tolerance) continue;
      const double dx = line[k + 1][0] - line[k][0], dy = line[k + 1][1] - line[k][1], length = std::hypot(dx, dy);
      found.opening = static_cast<int>(o);
      found.n = {dy / length, -dx / length};
      found.outside = (place[0] - line[k][0]) * found.n[0] + (place[1] - line[k][1]) * found.n[1];
    }
  }
  return found;
}

void require_on_sides(const Scene& scene) {
  for (const OpenBoundary& boundary : scene.boundaries)
    for (std::size_t k = 0; k + 1 < boundary.line.size(); ++k)
      if (!is_on_side(scene.domain, boundary.line[k], boundary.line[k + 1], 1e-3 * scene.water.spacing))
        throw SceneError("the method \"sisph\" knows open boundaries on the sides of the domain alone, and \"" + boundary.name +
                         "\" leaves them\n  help: boundary.side = \"left\", ..., or scene.method = \"sph-swe\"");
}

}  // namespace freshet::sisph
