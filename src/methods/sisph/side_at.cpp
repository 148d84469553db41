#include "src/methods/sisph/side_at.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/boundaries/walls/polyline.hpp"
#include "src/errors.hpp"

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
  for (const Wall& wall : scene.walls) least = std::min(least, distance(p, wall.line));
  return least;
}

}  // namespace

// A wall that ends where an open boundary begins has the corner behind both.
SideAt side_at(const Scene& scene, const Point& place) {
  const double tolerance = 1e-3 * scene.water.spacing;
  Point side = place;
  for (int axis = 0; axis < scene.domain.dimension; ++axis)
    side[axis] = std::clamp(place[axis], scene.domain.low[axis], scene.domain.high[axis]);
  SideAt found;
  found.wall = distance_to_wall(scene, side) < tolerance;
  for (std::size_t o = 0; o < scene.boundaries.size() && !found.wall && found.opening < 0; ++o) {
    const std::vector<Point>& line = scene.boundaries[o].line;
    for (std::size_t k = 0; k + 1 < line.size() && found.opening < 0; ++k) {
      const Piece piece = piece_between(line[k], line[k + 1]);
      if (distance(side, piece) > tolerance) continue;
      found.opening = static_cast<int>(o);
      found.n = {-piece.normal.x, -piece.normal.y};
      found.outside = -foot_on(piece, to_vec<2>(place)).off;
    }
  }
  return found;
}

void require_on_sides(const Scene& scene) {
  for (const OpenBoundary& boundary : scene.boundaries)
    for (std::size_t k = 0; k + 1 < boundary.line.size(); ++k)
      if (!is_on_side(scene.domain, boundary.line[k], boundary.line[k + 1], 1e-3 * scene.water.spacing))
        throw SceneError(
            "the method \"sisph\" knows open boundaries on the sides of the domain alone, and \"" +
            boundary.name +
            "\" leaves them\n  help: boundary.side = \"left\", ..., or scene.method = \"sph-swe\"");
}

}  // namespace freshet::sisph
