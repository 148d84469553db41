// Water on a regular grid of cells (thesis 2.6): sums over the particles whose kernel covers a cell's centre,
// their Shepard means where there is enough water, and the largest values so far.
#pragma once
#include "cellgrid/particles/clusters.hpp"
#include "kernels/smoothing/smoothing.hpp"

namespace freshet {

// Cells by the centre of the first (lowest x and y); 1-D: ny = 1 and y0 = 0.
struct CellGrid {
  double x0 = 0, y0 = 0, dx = 1, dy = 1;  // m
  int nx = 1, ny = 1;

  KOKKOS_INLINE_FUNCTION double x(int i) const { return x0 + i * dx; }
  KOKKOS_INLINE_FUNCTION double y(int j) const { return y0 + j * dy; }
  int size() const { return nx * ny; }
};

// The particles, sorted: rows says who is where.
template <int D>
struct SortedWater {
  Rows rows;
  VecField<double, D> x, v;      // m, m/s
  Field<double> mass, depth, h;  // m3, m, m
  Field<int> kind;               // not 0: no water (boundary particles); empty: all are water
};
template <int D>
SortedWater<D> sorted_water(const Rows& rows, const FieldSet& f) {
  return {rows,        f.vector<D>("x", "y"),    f.vector<D>("u", "v"), f.real("mass"), f.real("depth"),
          f.real("h"), f.integer_or_none("kind")};
}

// Sums at a place: cover is 1 inside the water, 1/2 at its edge, and 0 beyond the particles' kernels.
template <int D>
struct Cover {
  Lane cover{0.0};    // sum V W [1], V = m / d
  Lane depth{0.0};    // sum V W d [m]
  Vec<Lane, D> flow;  // sum V W v [m/s]
};

constexpr double edge_cover = 0.5;  // less than this is no water: the cell is blank
// from here on a depth is the Shepard mean where the edge may be smeared
constexpr double inner_cover = 0.95;

// The Shepard mean of the depth inside, falling to zero beyond the edge: for norms over wet and dry [m].
KOKKOS_INLINE_FUNCTION double smeared_depth(double cover, double depth_sum) {
  return depth_sum / larger(cover, inner_cover);
}

// One value per cell, x fastest. u, v: sum V W v.
struct CoverFields {
  Field<double> cover, depth, u, v;
  explicit CoverFields(int cells);
};

// The sums at every cell's centre.
template <int D>
CoverFields cover_cells(const CellGrid& grid, const SortedWater<D>& water);

// The largest so far, per cell; arrival and last_wet are -1 where the cell was never wet. Depths above `wet`
// count as wet; speed and depth x speed are taken there only, and a Shepard mean needs edge_cover.
struct Maxima {
  double wet;                               // m
  Field<double> depth, speed, depth_speed;  // m, m/s, m2/s
  Field<double> arrival, last_wet;          // s, first and last time when it was wet
  Maxima(int cells, double wet_depth);
};

// Where the wet cells are now.
struct Front {
  int cells = 0;
  double x_low = 0, x_high = 0, y_low = 0, y_high = 0;  // m, outermost centres; zero where none is wet
};

// Takes the state at time t [s] into the maxima; visits cells near water only.
template <int D>
Front track_maxima(const CellGrid& grid, const SortedWater<D>& water, double t, const Maxima& maxima);

}  // namespace freshet
