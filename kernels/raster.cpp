#include "kernels/raster.hpp"

#include <algorithm>
#include <cmath>

namespace freshet {
namespace {

// h may have grown since its local largest was measured (a neighbour list covers 5 %); what lies beyond a kernel adds zero.
constexpr double reach = CubicSpline<2>::support * 1.06;

// Cells are taken `lanes` along x at a time.
struct Packs {
  int i0 = 0, j0 = 0, across = 0, up = 0;  // first cell and row; packs per row, rows
  int count() const { return across * up; }
};

KOKKOS_INLINE_FUNCTION Lanes cells_of(const CellGrid& grid, int i, int j) { return {j * grid.nx + i, smaller(lanes, grid.nx - i)}; }

template <int D>
KOKKOS_INLINE_FUNCTION Vec<Lane, D> centres(const CellGrid& grid, int i, int j) {
  Vec<Lane, D> place;
  for (int l = 0; l < lanes; ++l) set_lane(place.x, l, grid.x(i + l));
  if constexpr (D == 2) place.y = Lane(grid.y(j));
  return place;
}

template <int D>
KOKKOS_FORCEINLINE_FUNCTION void add(const SortedWater<D>& water, int j, const Vec<Lane, D>& place, Cover<D>& sums) {
  const double depth = water.depth(j), h = water.h(j), per = 1.0 / (depth * h), inv_h = per * depth;
  const double volume = water.mass(j) * per * (D == 2 ? inv_h : 1.0);  // V / h^D
  const Vec<Lane, D> d = place - broadcast(at(water.x, j));
  const Lane r2 = dot(d, d), q = r2 * rsqrt(r2 + tiny_square) * inv_h;
  const Lane w = volume * CubicSpline<D>::at(q).w;
  sums.cover += w;
  sums.depth += w * depth;
  sums.flow += w * broadcast(at(water.v, j));
}

// Whether the kernel of fluid particle k reaches the segment of centres.
template <int D>
KOKKOS_FORCEINLINE_FUNCTION bool covers(const SortedWater<D>& water, int k, double xlo, double xhi, double y) {
  const double x = water.x.x(k), along = larger(0.0, larger(xlo - x, x - xhi)), support = CubicSpline<D>::support * water.h(k);
  double across = 0;
  if constexpr (D == 2) across = y - water.x.y(k);
  const bool fluid = water.kind.extent(0) == 0 || water.kind(k) == 0;
  return along * along + across * across < support * support && fluid && water.depth(k) > 0;
}

template <int D>
KOKKOS_FORCEINLINE_FUNCTION Cover<D> gather_water(const SortedWater<D>& water, const CellGrid& grid, int i, int j) {
  const Vec<Lane, D> place = centres<D>(grid, i, j);
  const double xlo = grid.x(i), xhi = grid.x(i + lanes - 1), y = grid.y(j);
  const double far = reach * water.rows.largest_h(xlo, xhi, y, y);
  Cover<D> sums;
  if (!(far > 0)) return sums;
  water.rows.for_each_run(xlo, xhi, y, y, far, [&](int begin, int end) {
    for (int k = begin; k < end; ++k)
      if (covers(water, k, xlo, xhi, y)) add(water, k, place, sums);
  });
  return sums;
}

// The packs around the particles' bounding box, widened by more than a support.
Packs packs_near(const CellGrid& grid, const Rows& rows) {
  const double margin = std::max(4 * rows.row_height, 1.1 * rows.support);
  const auto cell = [&](double at, double first, double step, int n) {
    return static_cast<int>(std::clamp(std::floor((at - first) / step), 0.0, n - 1.0));
  };
  const int i0 = cell(rows.x0 - margin, grid.x0, grid.dx, grid.nx);
  const int i1 = cell(rows.x0 + rows.bins * rows.bin_width + margin, grid.x0, grid.dx, grid.nx);
  const int j0 = grid.ny > 1 ? cell(rows.y0 - margin, grid.y0, grid.dy, grid.ny) : 0;
  const int j1 = grid.ny > 1 ? cell(rows.y0 + rows.rows * rows.row_height + margin, grid.y0, grid.dy, grid.ny) : 0;
  return {i0, j0, (i1 - i0) / lanes + 1, j1 - j0 + 1};
}

using Dynamic = Kokkos::RangePolicy<Exec, Kokkos::Schedule<Kokkos::Dynamic>>;  // dry cells cost next to nothing

// The mean over what covers the cell, finite where nothing does.
KOKKOS_FORCEINLINE_FUNCTION Lane mean(Lane value, Lane cover) { return value / larger(cover, Lane(edge_cover)); }

}  // namespace

CoverFields::CoverFields(int cells)
    : cover("raster.cover", static_cast<size_t>(cells)), depth("raster.depth", static_cast<size_t>(cells)),
      u("raster.u", static_cast<size_t>(cells)), v("raster.v", static_cast<size_t>(cells)) {}

template <int D>
CoverFields cover_cells(const CellGrid& grid, const SortedWater<D>& water) {
  const CoverFields out(grid.size());
  const Packs packs = packs_near(grid, water.rows);
  const SortedWater<D> w = water;
  Kokkos::parallel_for("raster::cover", Dynamic(0, packs.count()), KOKKOS_LAMBDA(int pack) {
        const int i = packs.i0 + pack % packs.across * lanes, j = packs.j0 + pack / packs.across;
        const Cover<D> sums = gather_water(w, grid, i, j);
        const Lanes cells = cells_of(grid, i, j);
        cells.store(out.cover, sums.cover);
        cells.store(out.depth, sums.depth);
        cells.store(out.u, sums.flow.x);
        if constexpr (D == 2) cells.store(out.v, sums.flow.y);
      });
  return out;
}

Maxima::Maxima(int cells, double wet_depth)
    : wet(wet_depth), depth("raster.max_depth", static_cast<size_t>(cells)), speed("raster.max_speed", static_cast<size_t>(cells)),
      depth_speed("raster.max_depth_speed", static_cast<size_t>(cells)), arrival("raster.arrival", static_cast<size_t>(cells)),
      last_wet("raster.last_wet", static_cast<size_t>(cells)) {
  Kokkos::deep_copy(arrival, -1.0);
  Kokkos::deep_copy(last_wet, -1.0);
}

namespace {

// Takes the cells' sums into the maxima; returns how many of them are wet, and the first and last of those.
template <int D>
KOKKOS_FORCEINLINE_FUNCTION int take(const Maxima& m, const Lanes& cells, const Cover<D>& sums, double t, int& first, int& last) {
  const Lane covered = select(sums.cover < Lane(edge_cover), Lane(0.0), Lane(1.0));
  const Lane depth = covered * mean(sums.depth, sums.cover);
  cells.store(m.depth, larger(cells.load(m.depth), depth));
  const auto wet = Lane(m.wet) < depth;
  if (!any(wet)) return 0;
  const Lane speed = select(wet, mean(root(dot(sums.flow, sums.flow)), sums.cover), Lane(0.0));
  cells.store(m.speed, larger(cells.load(m.speed), speed));
  cells.store(m.depth_speed, larger(cells.load(m.depth_speed), depth * speed));
  const Lane arrival = cells.load(m.arrival);
  cells.store(m.arrival, select(wet, select(arrival < Lane(0.0), Lane(t), arrival), arrival));
  cells.store(m.last_wet, select(wet, Lane(t), cells.load(m.last_wet)));
  const Lane marks = select(wet, Lane(1.0), Lane(0.0));
  int count = 0;
  for (int l = 0; l < cells.count; ++l)
    if (lane_of(marks, l) > 0) {
      if (count++ == 0) first = l;
      last = l;
    }
  return count;
}

}  // namespace

template <int D>
Front track_maxima(const CellGrid& grid, const SortedWater<D>& water, double t, const Maxima& maxima) {
  const Packs packs = packs_near(grid, water.rows);
  const SortedWater<D> w = water;
  const Maxima m = maxima;
  int count = 0, i_low = grid.nx, i_high = -1, j_low = grid.ny, j_high = -1;
  Kokkos::parallel_reduce(
      "raster::maxima", Dynamic(0, packs.count()),
      KOKKOS_LAMBDA(int pack, int& wet, int& west, int& east, int& south, int& north) {
        const int i = packs.i0 + pack % packs.across * lanes, j = packs.j0 + pack / packs.across;
        const Cover<D> sums = gather_water(w, grid, i, j);
        if (!any(Lane(edge_cover) < sums.cover)) return;
        int first = 0, last = 0;
        const int here = take(m, cells_of(grid, i, j), sums, t, first, last);
        if (here == 0) return;
        wet += here;
        west = smaller(west, i + first), east = larger(east, i + last);
        south = smaller(south, j), north = larger(north, j);
      },
      Kokkos::Sum<int>(count), Kokkos::Min<int>(i_low), Kokkos::Max<int>(i_high), Kokkos::Min<int>(j_low), Kokkos::Max<int>(j_high));
  if (count == 0) return {};
  return {count, grid.x(i_low), grid.x(i_high), grid.y(j_low), grid.y(j_high)};
}

template CoverFields cover_cells<1>(const CellGrid&, const SortedWater<1>&);
template CoverFields cover_cells<2>(const CellGrid&, const SortedWater<2>&);
template Front track_maxima<1>(const CellGrid&, const SortedWater<1>&, double, const Maxima&);
template Front track_maxima<2>(const CellGrid&, const SortedWater<2>&, double, const Maxima&);

}  // namespace freshet
