#include "kernels/linear/mesh/mesh_correction.hpp"

#include <cmath>

#include "cellgrid/parallel/launch.hpp"
#include "cellgrid/particles/clusters.hpp"
#include "kernels/linear/mesh/mesh_passes.hpp"

namespace freshet::linear {
namespace {

// Finds each cell's first point and each point's place in its cell.
template <int D>
struct FindPlaces {
  Cells cells;
  Rows rows;
  int bins;
  VecField<double, D> x;
  Field<int> node;
  Field<double> fx, fy;

  KOKKOS_FUNCTION void operator()(int row) const {
    const MeshCells m = cells.mesh;
    const double south = m.y0 + row * m.height, per_height = 1 / m.height_of(row);
    for (int column = 0; column < m.columns; ++column) {
      const int first = rows.begin(row, column * bins),
                end = rows.end(row, smaller((column + 1) * bins, rows.bins) - 1);
      cells.first(row * m.columns + column) = first;
      const double west = m.x0 + column * m.width, per_width = 1 / m.width_of(column);
      for (int i = first; i < end; ++i) {
        node(i) = cells.grid.start(row) + column;
        fx(i) = clamp((x.x(i) - west) * per_width);
        if constexpr (D == 2) fy(i) = clamp((x.y(i) - south) * per_height);
        else fy(i) = 0;
      }
      if (row + 1 == m.rows && column + 1 == m.columns) cells.first(m.size()) = end;
    }
  }
  static KOKKOS_FORCEINLINE_FUNCTION double clamp(double f) { return smaller(larger(f, 0.0), 1.0); }
};

// z = r + P c, the latter where weight > 0.
struct FromNodes {
  Vector c, r, z;
  Field<int> node;
  Field<double> fx, fy, weight;
  int stride, points;

  KOKKOS_FUNCTION void operator()(int b) const {
    const Lanes me = block(b, points);
    const LaneIndex n = me.load(node);
    const Lane x = me.load(fx), y = me.load(fy);
    const double* const south = c.data();
    const double* const north = south + stride;
    const Lane sw = gather(south, n), nw = gather(north, n);
    const Lane lower = sw + x * (gather(south + 1, n) - sw), upper = nw + x * (gather(north + 1, n) - nw);
    me.store(z, me.load(r) + select(Lane(0.0) < me.load(weight), lower + y * (upper - lower), Lane(0.0)));
  }
};

}  // namespace

template <int D>
int MeshCorrection<D>::bins_per_cell(const Rows& rows) {
  return static_cast<int>(std::fmax(1, std::round(rows.row_height / rows.bin_width)));
}

template <int D>
bool MeshCorrection<D>::suits(const Rows& rows, int points, double most) {
  return static_cast<double>(rows.rows) * rows.bins / bins_per_cell(rows) < most * points + 1000;
}

template <int D>
void MeshCorrection<D>::lay(const Rows& rows, const VecField<double, D>& x, int points,
                            const Period& period) {
  const int bins = bins_per_cell(rows);
  MeshCells& m = cells_;
  m = {(rows.bins - 1) / bins + 1, rows.rows, rows.x0, rows.y0, bins * rows.bin_width, rows.row_height};
  const bool wrap_x = period.length.x > 0, wrap_y = period.length.y > 0;
  m.last_width = wrap_x ? period.length.x - (m.columns - 1) * m.width : m.width;
  m.last_height = wrap_y ? period.length.y - (m.rows - 1) * m.height : m.height;
  multigrid_.resize({m.columns + !wrap_x, D == 2 ? m.rows + !wrap_y : 1, wrap_x, wrap_y});
  points_ = points;
  const BoxGrid grid = multigrid_.finest().grid;
  reserve(fx_, "mesh_correction.fx", points + lanes);
  reserve(fy_, "mesh_correction.fy", points + lanes);
  reserve(node_, "mesh_correction.node", points + lanes);
  reserve(first_, "mesh_correction.first", m.size() + 1);
  reserve(south_, "mesh_correction.south", grid.size());
  reserve(north_, "mesh_correction.north", grid.size());
  launch("mesh_correction::places", Range(0, m.rows),
         FindPlaces<D>{{m, grid, first_}, rows, bins, x, node_, fx_, fy_});
}

template <int D>
void MeshCorrection<D>::add(const Vector& r, const Field<double>& weight, const Vector& z) const {
  launch("mesh_correction::from_nodes", Range(0, blocks(points_)),
         FromNodes{c_, r, z, node_, fx_, fy_, weight, multigrid_.finest().grid.stride(), points_});
}

template class MeshCorrection<1>;
template class MeshCorrection<2>;

}  // namespace freshet::linear
