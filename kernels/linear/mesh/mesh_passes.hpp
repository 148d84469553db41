// The passes of MeshCorrection from points to its nodes, for what functions of the point its users carry.
#pragma once
#include "cellgrid/parallel/launch.hpp"
#include "kernels/linear/mesh/mesh_correction.hpp"

namespace freshet::linear {

// Points of the cells, and the row of nodes that cell row j has below it, as rows of the mesh's grid.
struct Cells {
  MeshCells mesh;
  BoxGrid grid;
  Field<int> first;

  KOKKOS_FORCEINLINE_FUNCTION int begin(int row, int column) const {
    return first(row * mesh.columns + column);
  }
  // The row of cells whose north nodes are those of node row j, -1: none.
  KOKKOS_FORCEINLINE_FUNCTION int below(int j) const {
    return j > 0 ? j - 1 : grid.wrap_y ? mesh.rows - 1 : -1;
  }
  // Whether all nodes are on one line: the cells have no north.
  KOKKOS_FORCEINLINE_FUNCTION bool line() const { return grid.ny == 1 && !grid.wrap_y; }
};

// P^T value: what each row of cells gives to the nodes below and above it.
template <class Value>
struct ToNodes {
  Cells cells;
  Field<double> fx, fy;
  Value value;
  Vector south, north;

  KOKKOS_FUNCTION void operator()(int row) const {
    const int at = cells.grid.start(row), columns = cells.mesh.columns;
    double south_east = 0, north_east = 0;
    for (int column = 0, i = cells.begin(row, 0); column < columns; ++column) {
      double all = 0, east = 0, upper = 0, corner = 0;
      for (const int end = cells.first(row * columns + column + 1); i < end; ++i) {
        const double v = value(i), e = fx(i) * v;
        all += v, east += e, upper += fy(i) * v, corner += fy(i) * e;
      }
      south(at + column) = south_east + all - east - upper + corner;
      north(at + column) = north_east + upper - corner;
      south_east = east - corner;
      north_east = corner;
    }
    if (cells.grid.wrap_x) south(at) += south_east, north(at) += north_east;
    else south(at + columns) = south_east, north(at + columns) = north_east;
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
    for (int i = 0; i < g.nx; ++i)
      result(at + i) = has_above * south(above + i) + has_below * north(from + i);
    g.wrap(result, j);
  }
};

// Conductances: a / width^2 of the points of a cell shared between its south and north, a / height^2 between
// its west and east.
template <class Area>
struct Conductances {
  Cells cells;
  Field<double> fx, fy;
  Area area;
  Vector south, north, upwards;

  KOKKOS_FUNCTION void operator()(int row) const {
    const MeshCells m = cells.mesh;
    const int at = cells.grid.start(row);
    const double per_height2 = cells.line() ? 0 : 1 / (m.height_of(row) * m.height_of(row));
    double east = 0;
    for (int column = 0, i = cells.begin(row, 0); column < m.columns; ++column) {
      double all = 0, right = 0, upper = 0;
      for (const int end = cells.first(row * m.columns + column + 1); i < end; ++i) {
        const double a = area(i);
        all += a, right += fx(i) * a, upper += fy(i) * a;
      }
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

template <int D>
template <class Mass, class Area>
void MeshCorrection<D>::set(const Mass& mass, const Area& area) {
  const BoxLevel& level = multigrid_.finest();
  const Cells cells{cells_, level.grid, first_};
  const Range of_cells(0, cells_.rows), of_nodes(0, level.grid.ny);
  launch("mesh_correction::masses", of_cells, ToNodes<Mass>{cells, fx_, fy_, mass, south_, north_});
  launch("mesh_correction::add_masses", of_nodes, AddRows{cells, south_, north_, level.mass});
  launch("mesh_correction::conductances", of_cells,
         Conductances<Area>{cells, fx_, fy_, area, south_, north_, level.north});
  launch("mesh_correction::add_conductances", of_nodes, AddRows{cells, south_, north_, level.east});
  multigrid_.coarsen();
}

template <int D>
template <class Value>
void MeshCorrection<D>::solve(const Value& value) {
  const BoxLevel& level = multigrid_.finest();
  const Cells cells{cells_, level.grid, first_};
  launch("mesh_correction::to_nodes", Range(0, cells_.rows),
         ToNodes<Value>{cells, fx_, fy_, value, south_, north_});
  launch("mesh_correction::add_rows", Range(0, level.grid.ny), AddRows{cells, south_, north_, level.right});
  c_ = multigrid_.cycle();
}

}  // namespace freshet::linear
