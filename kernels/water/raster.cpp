#include "kernels/water/raster.hpp"

#include <algorithm>
#include <cmath>

#include "cellgrid/parallel/assign.hpp"
#include "cellgrid/parallel/launch.hpp"

namespace freshet {
namespace {

// h may have grown since its local largest was measured (a neighbour list covers 5 %); what lies beyond a
// kernel adds zero.
constexpr double reach = CubicSpline<2>::support * 1.06;

// Cells are taken `lanes` at a time: in 2-D two rows of half as many, since a kernel that covers one cell of
// a compact block covers more of the others than of a long one.
template <int D>
constexpr int rows_of_block = D == 2 && lanes > 1 ? 2 : 1;
template <int D>
constexpr int columns_of_block = lanes / rows_of_block<D>;

struct CellBlocks {
  int i0 = 0, j0 = 0, across = 0, up = 0;  // first cell and row; blocks along x and y
  int count() const { return across * up; }
};

// The cells (i ... , j ...) of a block; lanes beyond the grid are no cells.
template <int D>
struct Block {
  int i, j, nx, ny;

  KOKKOS_FORCEINLINE_FUNCTION int column(int lane) const { return i + lane % columns_of_block<D>; }
  KOKKOS_FORCEINLINE_FUNCTION int row(int lane) const { return j + lane / columns_of_block<D>; }
  KOKKOS_FORCEINLINE_FUNCTION bool holds(int lane) const { return column(lane) < nx && row(lane) < ny; }
  KOKKOS_FORCEINLINE_FUNCTION int cell(int lane) const { return row(lane) * nx + column(lane); }
  KOKKOS_FORCEINLINE_FUNCTION Lane load(const Field<double>& f) const {
    return lanes_of<Lane>([&](int lane) { return holds(lane) ? f(cell(lane)) : 0.0; });
  }
  KOKKOS_FORCEINLINE_FUNCTION void store(const Field<double>& f, const Lane& value) const {
    for_each_lane(value, [&](int lane, double one) {
      if (holds(lane)) f(cell(lane)) = one;
    });
  }
};

template <int D>
KOKKOS_FORCEINLINE_FUNCTION Block<D> block_at(const CellGrid& grid, const CellBlocks& blocks, int k) {
  return {blocks.i0 + k % blocks.across * columns_of_block<D>,
          blocks.j0 + k / blocks.across * rows_of_block<D>, grid.nx, grid.ny};
}

template <int D>
KOKKOS_INLINE_FUNCTION Vec<Lane, D> centres(const CellGrid& grid, const Block<D>& block) {
  const Lane x = lanes_of<Lane>([&](int lane) { return grid.x(block.column(lane)); });
  if constexpr (D == 1) return {x};
  else return {x, lanes_of<Lane>([&](int lane) { return grid.y(block.row(lane)); })};
}

// The rectangle of a block's centres.
struct Rectangle {
  double xlo, xhi, ylo, yhi;  // m
};

template <int D>
KOKKOS_FORCEINLINE_FUNCTION void add(const SortedWater<D>& water, int j, const Vec<Lane, D>& place,
                                     Cover<D>& sums) {
  const double depth = water.depth(j), h = water.h(j), per = 1.0 / (depth * h), inv_h = per * depth;
  const double volume = water.mass(j) * per * (D == 2 ? inv_h : 1.0);  // V / h^D
  const Vec<Lane, D> d = place - broadcast(at(water.x, j));
  const Lane r2 = dot(d, d), q = r2 * rsqrt(r2 + tiny_square) * inv_h;
  const Lane w = volume * CubicSpline<D>::at(q).w;
  sums.cover += w;
  sums.depth += w * depth;
  sums.flow += w * broadcast(at(water.v, j));
}

// Whether the kernel of fluid particle k reaches the rectangle of centres.
template <int D>
KOKKOS_FORCEINLINE_FUNCTION bool covers(const SortedWater<D>& water, int k, const Rectangle& s) {
  const double x = water.x.x(k), along = larger(0.0, larger(s.xlo - x, x - s.xhi)),
               support = CubicSpline<D>::support * water.h(k);
  double across = 0;
  if constexpr (D == 2) across = larger(0.0, larger(s.ylo - water.x.y(k), water.x.y(k) - s.yhi));
  const bool fluid = water.kind.extent(0) == 0 || water.kind(k) == 0;
  return along * along + across * across < support * support && fluid && water.depth(k) > 0;
}

template <int D>
KOKKOS_FORCEINLINE_FUNCTION Cover<D> gather_water(const SortedWater<D>& water, const CellGrid& grid,
                                                  const Block<D>& block) {
  const Vec<Lane, D> place = centres<D>(grid, block);
  const Rectangle s{grid.x(block.column(0)), grid.x(block.column(lanes - 1)), grid.y(block.row(0)),
                    grid.y(block.row(lanes - 1))};
  const double far = reach * water.rows.largest_h(s.xlo, s.xhi, s.ylo, s.yhi);
  Cover<D> sums;
  if (!(far > 0)) return sums;
  water.rows.for_each_run(s.xlo, s.xhi, s.ylo, s.yhi, far, [&](int begin, int end) {
    for (int k = begin; k < end; ++k)
      if (covers(water, k, s)) add(water, k, place, sums);
  });
  return sums;
}

// The blocks around the particles' bounding box, widened by more than a support.
template <int D>
CellBlocks blocks_near(const CellGrid& grid, const Rows& rows) {
  const double margin = std::max(4 * rows.row_height, 1.1 * rows.support);
  const auto cell = [&](double at, double first, double step, int n) {
    return static_cast<int>(std::clamp(std::floor((at - first) / step), 0.0, n - 1.0));
  };
  const int i0 = cell(rows.x0 - margin, grid.x0, grid.dx, grid.nx);
  const int i1 = cell(rows.x0 + rows.bins * rows.bin_width + margin, grid.x0, grid.dx, grid.nx);
  const int j0 = grid.ny > 1 ? cell(rows.y0 - margin, grid.y0, grid.dy, grid.ny) : 0;
  const int j1 =
      grid.ny > 1 ? cell(rows.y0 + rows.rows * rows.row_height + margin, grid.y0, grid.dy, grid.ny) : 0;
  return {i0, j0, (i1 - i0) / columns_of_block<D> + 1, (j1 - j0) / rows_of_block<D> + 1};
}

// The mean over what covers the cell, finite where nothing does.
KOKKOS_FORCEINLINE_FUNCTION Lane mean(Lane value, Lane cover) {
  return value / larger(cover, Lane(edge_cover));
}

}  // namespace

CoverFields::CoverFields(int cells)
    : cover("raster.cover", static_cast<size_t>(cells)), depth("raster.depth", static_cast<size_t>(cells)),
      u("raster.u", static_cast<size_t>(cells)), v("raster.v", static_cast<size_t>(cells)) {}

template <int D>
CoverFields cover_cells(const CellGrid& grid, const SortedWater<D>& water) {
  const CoverFields out(grid.size());
  const CellBlocks blocks = blocks_near<D>(grid, water.rows);
  const SortedWater<D> w = water;
  launch(
      "raster::cover", DynamicRange(0, blocks.count()),
      KOKKOS_LAMBDA(int k) {  // dry cells cost next to nothing
        const Block<D> cells = block_at<D>(grid, blocks, k);
        const Cover<D> sums = gather_water(w, grid, cells);
        cells.store(out.cover, sums.cover);
        cells.store(out.depth, sums.depth);
        cells.store(out.u, sums.flow.x);
        if constexpr (D == 2) cells.store(out.v, sums.flow.y);
      });
  return out;
}

Maxima::Maxima(int cells, double wet_depth)
    : wet(wet_depth), depth("raster.max_depth", static_cast<size_t>(cells)),
      speed("raster.max_speed", static_cast<size_t>(cells)),
      depth_speed("raster.max_depth_speed", static_cast<size_t>(cells)),
      arrival("raster.arrival", static_cast<size_t>(cells)),
      last_wet("raster.last_wet", static_cast<size_t>(cells)) {
  assign(arrival, -1.0);
  assign(last_wet, -1.0);
}

namespace {

// How many cells are wet, and the first and last column and row of those.
struct WetExtent {
  int count = 0, west, east, south, north;
};

template <int D>
KOKKOS_FORCEINLINE_FUNCTION WetExtent extent_of(const Block<D>& cells, const Lane& marks) {
  WetExtent wet{0, cells.nx, -1, cells.ny, -1};
  for (int l = 0; l < lanes; ++l) {
    if (!(lane_of(marks, l) > 0) || !cells.holds(l)) continue;
    ++wet.count;
    wet.west = smaller(wet.west, cells.column(l)), wet.east = larger(wet.east, cells.column(l));
    wet.south = smaller(wet.south, cells.row(l)), wet.north = larger(wet.north, cells.row(l));
  }
  return wet;
}

// Takes the cells' sums into the maxima.
template <int D>
KOKKOS_FORCEINLINE_FUNCTION WetExtent take(const Maxima& m, const Block<D>& cells, const Cover<D>& sums,
                                           double t) {
  const Lane covered = select(sums.cover < Lane(edge_cover), Lane(0.0), Lane(1.0));
  const Lane depth = covered * mean(sums.depth, sums.cover);
  cells.store(m.depth, larger(cells.load(m.depth), depth));
  const auto wet = Lane(m.wet) < depth;
  if (!any(wet)) return extent_of(cells, Lane(0.0));
  const Lane speed = select(wet, mean(root(dot(sums.flow, sums.flow)), sums.cover), Lane(0.0));
  cells.store(m.speed, larger(cells.load(m.speed), speed));
  cells.store(m.depth_speed, larger(cells.load(m.depth_speed), depth * speed));
  const Lane arrival = cells.load(m.arrival);
  cells.store(m.arrival, select(wet, select(arrival < Lane(0.0), Lane(t), arrival), arrival));
  cells.store(m.last_wet, select(wet, Lane(t), cells.load(m.last_wet)));
  return extent_of(cells, select(wet, Lane(1.0), Lane(0.0)));
}

}  // namespace

template <int D>
Front track_maxima(const CellGrid& grid, const SortedWater<D>& water, double t, const Maxima& maxima) {
  const CellBlocks blocks = blocks_near<D>(grid, water.rows);
  const SortedWater<D> w = water;
  const Maxima m = maxima;
  int count = 0, i_low = grid.nx, i_high = -1, j_low = grid.ny, j_high = -1;
  Kokkos::parallel_reduce(
      "raster::maxima", DynamicRange(0, blocks.count()),
      KOKKOS_LAMBDA(int k, int& wet, int& west, int& east, int& south, int& north) {
        const Block<D> cells = block_at<D>(grid, blocks, k);
        const Cover<D> sums = gather_water(w, grid, cells);
        if (!any(Lane(edge_cover) < sums.cover)) return;
        const WetExtent here = take(m, cells, sums, t);
        wet += here.count;
        west = smaller(west, here.west), east = larger(east, here.east);
        south = smaller(south, here.south), north = larger(north, here.north);
      },
      Kokkos::Sum<int>(count), Kokkos::Min<int>(i_low), Kokkos::Max<int>(i_high), Kokkos::Min<int>(j_low),
      Kokkos::Max<int>(j_high));
  if (count == 0) return {};
  return {count, grid.x(i_low), grid.x(i_high), grid.y(j_low), grid.y(j_high)};
}

template CoverFields cover_cells<1>(const CellGrid&, const SortedWater<1>&);
template CoverFields cover_cells<2>(const CellGrid&, const SortedWater<2>&);
template Front track_maxima<1>(const CellGrid&, const SortedWater<1>&, double, const Maxima&);
template Front track_maxima<2>(const CellGrid&, const SortedWater<2>&, double, const Maxima&);

}  // namespace freshet
