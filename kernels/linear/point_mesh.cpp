#include "kernels/linear/point_mesh.hpp"

#include <cmath>
#include <string>

namespace freshet::linear {
namespace {

// Points of the cells, and the row of nodes that cell row j has below it, as rows of the mesh's grid.
struct Cells {
  MeshCells mesh;
  BoxGrid grid;
  Field<int> first;

  KOKKOS_FORCEINLINE_FUNCTION int begin(int row, int column) const { return first(row * mesh.columns + column); }
  // The row of cells whose north nodes are those of node row j, -1: none.
  KOKKOS_FORCEINLINE_FUNCTION int below(int j) const { return j > 0 ? j - 1 : grid.wrap_y ? mesh.rows - 1 : -1; }
};

// Finds each cell's first point and each point's place in its cell.
struct FindPlaces {
  Cells cells;
  Rows rows;
  int bins;
  VecField<double, 2> x;
  Field<int> node;
  Field<double> fx, fy;

  KOKKOS_FUNCTION void operator()(int row) const {
    const MeshCells m = cells.mesh;
    const double south = m.y0 + row * m.height, per_height = 1 / m.height_of(row);
    for (int column = 0; column < m.columns; ++column) {
      const int first = rows.begin(row, column * bins), end = rows.end(row, smaller((column + 1) * bins, rows.bins) - 1);
      cells.first(row * m.columns + column) = first;
      const double west = m.x0 + column * m.width, per_width = 1 / m.width_of(column);
      for (int i = first; i < end; ++i) {
        node(i) = cells.grid.start(row) + column;
        fx(i) = clamp((x.x(i) - west) * per_width);
        fy(i) = clamp((x.y(i) - south) * per_height);
      }
      if (row + 1 == m.rows && column + 1 == m.columns) cells.first(m.size()) = end;
    }
  }
  static KOKKOS_FORCEINLINE_FUNCTION double clamp(double f) { return smaller(larger(f, 0.0), 1.0); }
};

// P^T (w (value - mean)): what each row of cells gives to the nodes below and above it.
struct ToNodes {
  Cells cells;
  Field<double> fx, fy, weight, value;
  double mean;
  Vector south, north;

  KOKKOS_FUNCTION void operator()(int row) const {
    const int at = cells.grid.start(row), columns = cells.mesh.columns;
    double south_east = 0, north_east = 0;
    for (int column = 0, i = cells.begin(row, 0); column < columns; ++column) {
      double all = 0, east = 0, upper = 0, corner = 0;
      for (const int end = cells.first(row * columns + column + 1); i < end; ++i) {
        const double v = weight(i) * (value(i) - mean), e = fx(i) * v;
        all += v, east += e, upper += fy(i) * v, corner += fy(i) * e;
      }
      south(at + column) = south_east + all - east - upper + corner;
      north(at + column) = north_east + upper - corner;
      south_east = east - corner;
      north_east = corner;
    }
    if (cells.grid.wrap_x)
      south(at) += south_east, north(at) += north_east;
    else
      south(at + columns) = south_east, north(at + columns) = north_east;
  }
};

// result[j] := what the cells above and below node row j give.
struct AddRows {
  Cells cells;
  Vector south, north, result;

  KOKKOS_FUNCTION void operator()(int j) const {
    const BoxGrid g = cells.grid;
    const int at = g.start(j), below = cells.below(j), from = g.start(below < 0 ? 0 : below);
    const double has_above = j < cells.mesh.rows ? 1 : 0, has_below = below < 0 ? 0 : 1;
    const int above = j < cells.mesh.rows ? at : g.start(0);
    for (int i = 0; i < g.nx; ++i) result(at + i) = has_above * south(above + i) + has_below * north(from + i);
    g.wrap(result, j);
  }
};

// Conductances: a / width^2 of the points of a cell shared between its south and north, a / height^2 between its west and east.
struct Conductances {
  Cells cells;
  Field<double> fx, fy, area;
  Vector south, north, upwards;

  KOKKOS_FUNCTION void operator()(int row) const {
    const MeshCells m = cells.mesh;
    const int at = cells.grid.start(row);
    const double per_height2 = 1 / (m.height_of(row) * m.height_of(row));
    double east = 0;
    for (int column = 0, i = cells.begin(row, 0); column < m.columns; ++column) {
      double all = 0, right = 0, upper = 0;
      for (const int end = cells.first(row * m.columns + column + 1); i < end; ++i) all += area(i), right += fx(i) * area(i), upper += fy(i) * area(i);
      const double per_width2 = 1 / (m.width_of(column) * m.width_of(column));
      south(at + column) = per_width2 * (all - upper);
      north(at + column) = per_width2 * upper;
      upwards(at + column) = east + per_height2 * (all - right);
      east = per_height2 * right;
    }
    if (cells.grid.wrap_x) upwards(at) += east;
    else south(at + m.columns) = north(at + m.columns) = 0, upwards(at + m.columns) = east;
    cells.grid.wrap(upwards, row);
  }
};

// z = r + P c, the latter but for given points.
struct FromNodes {
  Vector c, r, z;
  Field<int> node;
  Field<double> fx, fy, weight;
  int stride, points;

  KOKKOS_FUNCTION void operator()(int block) const {
    const Lanes me{block * lanes, smaller(lanes, points - block * lanes)};
    const LaneIndex n = me.load(node);
    const Lane x = me.load(fx), y = me.load(fy);
    const double* const south = c.data();
    const double* const north = south + stride;
    const Lane sw = gather(south, n), nw = gather(north, n);
    const Lane lower = sw + x * (gather(south + 1, n) - sw), upper = nw + x * (gather(north + 1, n) - nw);
    me.store(z, me.load(r) + select(Lane(0.0) < me.load(weight), lower + y * (upper - lower), Lane(0.0)));
  }
};

void reserve(Field<int>& f, const std::string& label, int n) {
  if (f.extent_int(0) < n) f = Field<int>(label, static_cast<size_t>(n + n / 2));
}

}  // namespace

int PointMesh::bins_per_cell(const Rows& rows) {
  return static_cast<int>(std::fmax(1, std::round(rows.row_height / rows.bin_width)));
}

void PointMesh::lay(const Rows& rows, const Period& period) {
  const int bins = bins_per_cell(rows);
  MeshCells& m = cells_;
  m = {(rows.bins - 1) / bins + 1, rows.rows, rows.x0, rows.y0, bins * rows.bin_width, rows.row_height};
  const bool wrap_x = period.length.x > 0, wrap_y = period.length.y > 0;
  m.last_width = wrap_x ? period.length.x - (m.columns - 1) * m.width : m.width;
  m.last_height = wrap_y ? period.length.y - (m.rows - 1) * m.height : m.height;
  multigrid_.resize({m.columns + !wrap_x, m.rows + !wrap_y, wrap_x, wrap_y});
}

void PointMesh::build(const Rows& rows, const VecField<double, 2>& x, int points, const Period& period, const MeshWeights& weights) {
  const Region region("point_mesh::build");
  lay(rows, period);
  points_ = points;
  weight_ = weights.weight;
  const BoxLevel& level = multigrid_.finest();
  linear::reserve(fx_, "point_mesh.fx", points + lanes);
  linear::reserve(fy_, "point_mesh.fy", points + lanes);
  reserve(node_, "point_mesh.node", points + lanes);
  reserve(first_, "point_mesh.first", cells_.size() + 1);
  linear::reserve(south_, "point_mesh.south", level.grid.size());
  linear::reserve(north_, "point_mesh.north", level.grid.size());
  const Cells cells{cells_, level.grid, first_};
  const Range of_cells(0, cells_.rows), of_nodes(0, level.grid.ny);
  Kokkos::parallel_for("point_mesh::places", of_cells, FindPlaces{cells, rows, bins_per_cell(rows), x, node_, fx_, fy_});
  Kokkos::parallel_for("point_mesh::masses", of_cells, ToNodes{cells, fx_, fy_, weight_, weights.held, 0.0, south_, north_});
  Kokkos::parallel_for("point_mesh::add_masses", of_nodes, AddRows{cells, south_, north_, level.mass});
  Kokkos::parallel_for("point_mesh::conductances", of_cells, Conductances{cells, fx_, fy_, weights.area, south_, north_, level.north});
  Kokkos::parallel_for("point_mesh::add_conductances", of_nodes, AddRows{cells, south_, north_, level.east});
  multigrid_.coarsen();
  total_weight_ = weights.singular ? sum_of_weights() : 0;
}

double PointMesh::sum_of_weights() {
  const Field<double> weight = weight_;
  return sums_.sum<1>("point_mesh::weight", points_, KOKKOS_LAMBDA(int i) { return Kokkos::Array<double, 1>{{weight(i)}}; })[0];
}

double PointMesh::mean(const Vector& r) { return dot(sums_, points_, weight_, r) / total_weight_; }

void PointMesh::operator()(const Vector& r, const Vector& z) {
  const Region region("point_mesh::cycle");
  const BoxLevel& level = multigrid_.finest();
  const Cells cells{cells_, level.grid, first_};
  Kokkos::parallel_for("point_mesh::to_nodes", Range(0, cells_.rows), ToNodes{cells, fx_, fy_, weight_, r, total_weight_ > 0 ? mean(r) : 0.0, south_, north_});
  Kokkos::parallel_for("point_mesh::add_rows", Range(0, level.grid.ny), AddRows{cells, south_, north_, level.right});
  const Vector c = multigrid_.cycle();
  Kokkos::parallel_for("point_mesh::from_nodes", Range(0, (points_ + lanes - 1) / lanes),
                       FromNodes{c, r, z, node_, fx_, fy_, weight_, level.grid.stride(), points_});
}

}  // namespace freshet::linear
