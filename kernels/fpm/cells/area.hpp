// The water's area, point by point (docs/formulas/fpm.md (F26)): each corner of a point's cell without air is
// the centre of a triangle of points that belongs to the water, of which the point owns the part towards
// itself. The parts of all points make up those triangles, walls included, also where four points share a
// circle.
#pragma once
#include "kernels/fpm/cells/voronoi.hpp"

namespace freshet::fpm {

// The middle of what an edge of the cell stands for, seen from the point at p: half-way to a neighbour, the
// foot on a wall.
KOKKOS_INLINE_FUNCTION Vec<double, 2> middle_of(const PointCell& c, const Cloud& cloud,
                                                const Vec<double, 2>& p, int edge) {
  if (edge >= 0) return {0.5 * c.around.x[edge], 0.5 * c.around.y[edge]};
  const Side& s = cloud.tank.sides(Cell::segment_of(edge));
  return -foot_on(s, p).off * s.normal;
}

// m2
KOKKOS_INLINE_FUNCTION double wet_area(const PointCell& c, const Cloud& cloud, int i, const Radii& radii) {
  const Vec<double, 2> p = at(cloud.near.x, i);
  double twice = 0;
  for (int k = 0; k < c.cell.size; ++k) {
    const int from = c.cell.edge[c.cell.before(k)], to = c.cell.edge[k];
    if (from == Cell::open || to == Cell::open || is_air(c, cloud, i, k, radii)) continue;
    const Vec<double, 2> a = middle_of(c, cloud, p, from), b = middle_of(c, cloud, p, to);
    twice += a.x * c.cell.y[k] - a.y * c.cell.x[k] + c.cell.x[k] * b.y - c.cell.y[k] * b.x;
  }
  return 0.5 * twice;
}

}  // namespace freshet::fpm
