// Local Voronoi cells (docs/formulas/fpm.md (F25), (F28)): which points lie on the free surface, and
// where points are missing. A point is on the surface iff its cell, cut by the walls, has a corner at
// `surface` or farther: then a circle of that radius through it is empty. Cells closer than that are exact;
// each point costs about a microsecond. Water that comes near other water has air between: an empty circle
// that was air stays so down to the radius `closed`, told by the sides on which its points were open when
// last looked at. At 1.3 dx a gap of 2.5 dx would be water at once.
#pragma once
#include "cellgrid/particles/near.hpp"
#include "kernels/fpm/cells/cell.hpp"
#include "kernels/fpm/tank.hpp"

namespace freshet::fpm {

// Lengths and areas in units of the spacing at the point.
struct VoronoiRule {
  double surface = 1.3;  // radius of the empty circle that makes a surface
  double closed = 0.6;   // of the one below which a gap that closes is water
  double hole = 0.9;     // circumradius beyond which a triangle is a hole; new point at its circumcentre
  double area = 0;  // > 0: the thesis' rule instead, triangles of more than this (0.76 dx^2) get a point at
                    // their centroid
  double edge = 1.45;  // surface edges and gaps on walls longer than this are halved
};

// The points of a flow, in the order of `near`.
struct Cloud {
  Near near;
  Field<int> id, kind;  // kind: PointKind
  TankView tank;
  double spacing;              // m, dx
  Field<double> dx{};          // m, that of each point where it varies
  VecField<double, 2> open{};  // 1, towards the air when last looked at: unit, all_round, or 0 inside the
                               // water; may be absent

  KOKKOS_FORCEINLINE_FUNCTION double spacing_at(int i) const { return dx.extent(0) > 0 ? dx(i) : spacing; }
};

// A point's neighbours by distance, then id; those beyond `most` are left out.
struct Around {
  static constexpr int most = 64;
  int j[most];
  double x[most], y[most], r2[most];  // m, from the point; m2
  int size = 0;
  double left_out2 = 1e300;  // m2, distance of the nearest one left out

  KOKKOS_INLINE_FUNCTION void insert(int other, const Vec<double, 2>& d, double d2, const Field<int>& id) {
    if (size == most && d2 >= r2[most - 1]) {
      left_out2 = smaller(left_out2, d2);
      return;
    }
    if (size == most) left_out2 = r2[--size];
    int k = size++;
    for (; k > 0 && (r2[k - 1] > d2 || (r2[k - 1] == d2 && id(j[k - 1]) > id(other))); --k)
      j[k] = j[k - 1], x[k] = x[k - 1], y[k] = y[k - 1], r2[k] = r2[k - 1];
    j[k] = other, x[k] = d.x, y[k] = d.y, r2[k] = d2;
  }
};

// A cell with the neighbours that its edges name.
struct PointCell {
  Cell cell;
  Around around;
  bool complete = false;  // exact within the square that it was cut from

  explicit KOKKOS_INLINE_FUNCTION PointCell(double half) : cell(half) {}
};

// The cell of point i, exact where it is nearer than half [m]. Walls cut first, then neighbours by distance.
KOKKOS_INLINE_FUNCTION void cut_walls(Cell& cell, const TankView& tank, const Vec<double, 2>& p,
                                      double half) {
  const double reach = 1.5 * half;  // beyond the corners of the square
  tank.bins.for_each(box_around(p, 1.5 * reach),
                     [&](int k) {  // a side bounds beyond its end, too: farther than reach by sqrt(2)
                       const Side& s = tank.sides(k);
                       const Foot<double> f = foot_on(s, p);
                       if (TankView::bounds(s, f, reach))
                         cell.clip(-1.0 * s.normal, larger(f.off, 0.0), Cell::wall(k));
                     });
}

KOKKOS_INLINE_FUNCTION void cut_neighbours(PointCell& c) {
  double far2 = 4 * c.cell.reach2();
  int k = 0;
  for (; k < c.around.size && c.around.r2[k] < far2; ++k) {
    c.cell.clip({c.around.x[k], c.around.y[k]}, 0.5 * c.around.r2[k], k);
    far2 = 4 * c.cell.reach2();
  }
  c.complete = !c.cell.overflow && (k < c.around.size || c.around.left_out2 >= far2);
}

// Most cells close within a good spacing: neighbours farther than twice that are asked for only where they do
// not.
KOKKOS_INLINE_FUNCTION PointCell cell_of(const Cloud& cloud, int i, double half) {
  const Vec<double, 2> p = at(cloud.near.x, i);
  const double close = smaller(0.95 * cloud.spacing_at(i), half);
  const double reaches[] = {close, half};
  for (const double reach : reaches) {
    PointCell c(half);
    cut_walls(c.cell, cloud.tank, p, half);
    cloud.near.for_each(p, 2 * reach, [&](int j, const Vec<double, 2>& d, double r2) {
      if (j != i) c.around.insert(j, d, r2, cloud.id);
    });
    cut_neighbours(c);
    if (reach == half || c.cell.reach2() <= reach * reach) return c;
  }
  return PointCell(half);
}

// Of a point with air on opposite sides.
KOKKOS_INLINE_FUNCTION Vec<double, 2> all_round() { return {2, 0}; }

// Whether point j was open towards d, within 60 degrees.
KOKKOS_INLINE_FUNCTION bool faces(const Cloud& cloud, int j, const Vec<double, 2>& d) {
  if (cloud.open.x.extent(0) == 0) return false;
  const Vec<double, 2> o = at(cloud.open, j);
  const double o2 = dot(o, o), along = dot(o, d);
  return o2 > 1.5 || (o2 > 0 && along > 0 && along * along > 0.25 * dot(d, d));
}

// Radii within which empty circles are water [m]: of gaps that close, of all others.
struct Radii {
  double closed2, open2;  // squared
  KOKKOS_INLINE_FUNCTION Radii(const VoronoiRule& rule, double dx)
      : closed2(rule.closed * rule.closed * dx * dx), open2(rule.surface * rule.surface * dx * dx) {}
};

// Whether the way from point i to its neighbour crosses a gap: both are open towards each other, and not
// threads both.
KOKKOS_INLINE_FUNCTION bool crosses_air(const PointCell& c, const Cloud& cloud, int i, int number) {
  const Vec<double, 2> way{c.around.x[number], c.around.y[number]};
  const int j = c.around.j[number];
  if (!faces(cloud, i, way) || !faces(cloud, j, -1.0 * way)) return false;
  return dot(at(cloud.open, i), at(cloud.open, i)) < 1.5 || dot(at(cloud.open, j), at(cloud.open, j)) < 1.5;
}

// Whether the empty circle round a corner of point i's cell holds air: it is as large as the surface's, or a
// gap that has not closed.
KOKKOS_INLINE_FUNCTION bool is_air(const PointCell& c, const Cloud& cloud, int i, int corner,
                                   const Radii& radii) {
  const double r2 = c.cell.distance2(corner);
  if (r2 >= radii.open2) return true;
  const int a = c.cell.edge[c.cell.before(corner)], b = c.cell.edge[corner];
  if (r2 < radii.closed2 || a < 0 || b < 0) return false;  // walls are softer the sooner they are met
  const Vec<double, 2> to{c.cell.x[corner], c.cell.y[corner]};
  const auto open = [&](int number) {
    return faces(cloud, c.around.j[number], to - Vec<double, 2>{c.around.x[number], c.around.y[number]});
  };
  return faces(cloud, i, to) && open(a) && open(b);
}

// Towards the air around point i: 0, a unit vector or all_round.
KOKKOS_INLINE_FUNCTION Vec<double, 2> open_side(const PointCell& c, const Cloud& cloud, int i,
                                                const Radii& radii) {
  Vec<double, 2> sum;
  int count = 0;
  for (int k = 0; k < c.cell.size; ++k) {
    if (!is_air(c, cloud, i, k, radii)) continue;
    sum += (1 / root(c.cell.distance2(k))) * Vec<double, 2>{c.cell.x[k], c.cell.y[k]};
    ++count;
  }
  const double length = root(dot(sum, sum));
  if (count == 0) return {};
  return length > 0.3 * count ? (1 / length) * sum : all_round();
}

// Calls visit(a, b, circumradius2, corner) for the Delaunay triangles (i, a, b) with a circumradius below
// half; a and b are numbers in c.around.
template <class Visit>
KOKKOS_INLINE_FUNCTION void for_each_triangle(const PointCell& c, double half, const Visit& visit) {
  for (int k = 0; k < c.cell.size; ++k) {
    const int a = c.cell.edge[c.cell.before(k)], b = c.cell.edge[k];
    const double r2 = c.cell.distance2(k);
    if (a >= 0 && b >= 0 && r2 < half * half) visit(a, b, r2, k);
  }
}

// Where a point is missing, as one of the points around it found. Of several in reach of each other the
// greatest rank counts.
struct Gap {
  enum Site : int { none = 0, in_bulk = 1, on_surface = 2, at_wall = 3, at_corner = 4 };
  int kind = none;
  int side = -1;     // of walls; of corners the side that ends there
  Vec<double, 2> x;  // m
  double size = 0;   // 1, by how much the rule is exceeded
};

struct VoronoiReport {
  int surface = 0, missing = 0;  // points
  int failed = 0;                // cells that did not fit their buffers
};

// What the cells tell, point by point.
class Voronoi {
 public:
  explicit Voronoi(const VoronoiRule& rule) : rule_(rule) {}

  // Writes surface (1 on the free surface, else 0) and cloud.open for all n points, and where points are
  // missing unless flags_only.
  VoronoiReport find(const Cloud& cloud, int n, const Field<int>& surface, bool flags_only = false);

  const Kokkos::View<Gap*, Memory>& missing() const { return missing_; }
  const VoronoiRule& rule() const { return rule_; }

 private:
  VoronoiRule rule_;
  Kokkos::View<Gap*, Memory> missing_;
  VecField<double, 2> open_;  // 1, found in this look
};

}  // namespace freshet::fpm
