#include "kernels/fpm/cells/voronoi.hpp"

#include "cellgrid/parallel/launch.hpp"

namespace freshet::fpm {
namespace {

// Looks at one point's cell for places where a point is missing, and keeps the one of the greatest kind, then
// size.
struct Searcher {
  Cloud cloud;
  VoronoiRule rule;

  struct Look {
    int i;
    Vec<double, 2> p;
    const PointCell& c;
    double dx;  // m
    Gap best;

    KOKKOS_FORCEINLINE_FUNCTION void offer(int kind, double size, const Vec<double, 2>& from_p,
                                           int side = -1) {
      if (size <= 1 || kind < best.kind || (kind == best.kind && size <= best.size)) return;
      best = {kind, side, p + from_p, size};
    }
    KOKKOS_FORCEINLINE_FUNCTION Vec<double, 2> corner(int k) const { return {c.cell.x[k], c.cell.y[k]}; }
    KOKKOS_FORCEINLINE_FUNCTION Vec<double, 2> to(int number) const {
      return {c.around.x[number], c.around.y[number]};
    }
  };

  KOKKOS_FORCEINLINE_FUNCTION double half(int i) const { return rule.surface * cloud.spacing_at(i); }

  // The smallest id of those that see the same place speaks for them.
  KOKKOS_FORCEINLINE_FUNCTION bool speaks(const Look& l, int number) const {
    return cloud.id(l.i) < cloud.id(l.c.around.j[number]);
  }

  KOKKOS_INLINE_FUNCTION void triangle(Look& l, int a, int b, double r2, int k) const {
    if (!speaks(l, a) || !speaks(l, b)) return;
    const Vec<double, 2> da = l.to(a), db = l.to(b);
    if (rule.area > 0) {
      const double area = 0.5 * (da.x * db.y - da.y * db.x);
      l.offer(Gap::in_bulk, area / (rule.area * l.dx * l.dx), (1.0 / 3) * (da + db));
    } else if (dot(da, db) > 0 && dot(da, da - db) > 0 && dot(db, db - da) > 0) {
      // Only where it holds its own circumcentre is that the middle of a hole; of others it may lie outside
      // the water.
      l.offer(Gap::in_bulk, root(r2) / (rule.hole * l.dx), l.corner(k));
    }
  }

  KOKKOS_FORCEINLINE_FUNCTION bool stands_on(const Side& s, const Vec<double, 2>& p) const {
    const double off = foot_on(s, p).off;
    return off < 1e-6 * cloud.spacing && off > -1e-6 * cloud.spacing;
  }

  // A circle centred on a wall through the point and one neighbour, with nothing in it.
  KOKKOS_INLINE_FUNCTION void wall_gap(Look& l, int side, int number, double r2, int k) const {
    if (!speaks(l, number)) return;
    const Side& s = cloud.tank.sides(side);
    const Vec<double, 2> x = l.p + l.corner(k);
    const double along = foot_on(s, x).along;
    if (along < 0 || along > s.length) return;
    const bool both = stands_on(s, l.p) && stands_on(s, l.p + l.to(number));
    l.offer(Gap::at_wall, root(r2) / ((both ? 0.5 * rule.edge : rule.hole) * l.dx), l.corner(k), side);
  }

  KOKKOS_INLINE_FUNCTION void wall_corner(Look& l, int a, int b, double r2, int k) const {
    const int first = cloud.tank.sides(a).after == b ? a : b;
    if (cloud.tank.sides(first).after != (first == a ? b : a) || !cloud.tank.sides(first).corner_b) return;
    l.offer(Gap::at_corner, root(r2) / (0.5 * rule.edge * l.dx), l.corner(k), first);
  }

  // The Delaunay edge to a neighbour, one of whose empty circles is as large as the surface's.
  KOKKOS_INLINE_FUNCTION void surface_edge(Look& l, int k) const {
    const Cell& cell = l.c.cell;
    const int number = cell.edge[k];
    const Radii radii(rule, l.dx);
    const double longest = rule.edge * l.dx;
    if (number < 0 || l.c.around.r2[number] < longest * longest || !speaks(l, number)) return;
    if (!is_air(l.c, cloud, l.i, k, radii) && !is_air(l.c, cloud, l.i, cell.after(k), radii)) return;
    if (l.c.around.r2[number] >= 4 * radii.open2 || crosses_air(l.c, cloud, l.i, number)) return;
    const Vec<double, 2> middle = 0.5 * l.to(number);
    const NearestPiece under = cloud.tank.nearest(l.p + middle, 1e-3 * l.dx);
    if (under.piece < 0) l.offer(Gap::on_surface, root(l.c.around.r2[number]) / longest, middle);
  }

  KOKKOS_INLINE_FUNCTION Gap search(int i, const PointCell& c) const {
    Look l{i, at(cloud.near.x, i), c, cloud.spacing_at(i), {}};
    const Radii radii(rule, l.dx);
    for (int k = 0; k < c.cell.size; ++k) {
      surface_edge(l, k);
      const int a = c.cell.edge[c.cell.before(k)], b = c.cell.edge[k];
      const double r2 = c.cell.distance2(k);
      if (a == Cell::open || b == Cell::open || is_air(c, cloud, i, k, radii)) continue;
      if (a >= 0 && b >= 0) triangle(l, a, b, r2, k);
      else if (a < 0 && b < 0) wall_corner(l, Cell::segment_of(a), Cell::segment_of(b), r2, k);
      else wall_gap(l, Cell::segment_of(a < 0 ? a : b), a < 0 ? b : a, r2, k);
    }
    l.best.x = cloud.near.period.wrap(l.best.x);
    return l.best;
  }
};

}  // namespace

VoronoiReport Voronoi::find(const Cloud& cloud, int n, const Field<int>& surface, bool flags_only) {
  if (!flags_only) reserve(missing_, "fpm.missing", n);
  for (Field<double>* f : {&open_.x, &open_.y}) reserve(*f, "fpm.open", n);
  const VecField<double, 2> open = open_, seen = cloud.open;
  const auto missing = missing_;
  const Searcher searcher{cloud, rule_};
  VoronoiReport r;
  Kokkos::parallel_reduce(
      "fpm::voronoi", Range(0, n),
      KOKKOS_LAMBDA(int i, int& surfaces, int& holes, int& failures) {
        const double half = searcher.half(i);
        const PointCell c = cell_of(cloud, i, half);
        const Vec<double, 2> air = open_side(c, cloud, i, Radii(searcher.rule, cloud.spacing_at(i)));
        put(open, i, air);
        surface(i) = air.x != 0 || air.y != 0;
        surfaces += surface(i);
        failures += !c.complete;
        if (flags_only) return;
        missing(i) = searcher.search(i, c);
        holes += missing(i).kind != Gap::none;
      },
      r.surface, r.missing, r.failed);
  if (seen.x.extent(0) > 0)
    launch(
        "fpm::remember_air", Range(0, n), KOKKOS_LAMBDA(int i) { put(seen, i, at(open, i)); });
  return r;
}

}  // namespace freshet::fpm
