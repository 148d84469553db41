#include "kernels/linear/particle_mesh.hpp"

namespace freshet::linear {
namespace {

constexpr int bins_per_cell = 4;  // of dx / 2; a divisor of a block's bins, so that a cell is one run
static_assert(Rows::block_bins % bins_per_cell == 0);

// The mesh over the sorted particles: cells of one row (1-D: the line) times four bins; corners are numbered
// south-west, south-east, north-west, north-east, edges south, north, west, east.
template <int D>
struct Mesh {
  Rows rows;
  VecField<double, D> x;
  Field<double> mass;
  int cells_x, cells_y;
  double per_width, per_height;  // 1/m

  Mesh(const Rows& r, const VecField<double, D>& positions, const Field<double>& m)
      : rows(r), x(positions), mass(m), cells_x((r.bins - 1) / bins_per_cell + 1), cells_y(r.rows),
        per_width(r.per_bin_width / bins_per_cell), per_height(r.per_row_height) {}

  int cells() const { return cells_x * cells_y; }
  KOKKOS_INLINE_FUNCTION int nodes_x() const { return cells_x + 1; }
  KOKKOS_INLINE_FUNCTION int nodes_y() const { return D == 2 ? cells_y + 1 : 1; }

  // Calls at(i, fx, fy) for the wet particles of a cell; fx, fy: where in the cell, 0 to 1.
  template <class At>
  KOKKOS_FORCEINLINE_FUNCTION void for_each_in(int row, int column, const At& at) const {
    const int first = column * bins_per_cell, last = smaller(first + bins_per_cell, rows.bins) - 1, end = rows.end(row, last);
    const double west = rows.x0 + column / per_width, south = rows.y0 + row * rows.row_height;
    for (int i = rows.begin(row, first); i < end; ++i) {
      if (!(mass(i) > 0)) continue;
      const double fx = (x.x(i) - west) * per_width;
      double fy = 0;
      if constexpr (D == 2) fy = (x.y(i) - south) * per_height;
      at(i, clamp(fx), clamp(fy));
    }
  }

  // The sum over the four cells around node (i, j) of what each holds for it.
  KOKKOS_FORCEINLINE_FUNCTION double at_node(const Field<double>& corner, int i, int j) const {
    return of_cell(corner, i, j, 0) + of_cell(corner, i - 1, j, 1) + of_cell(corner, i, j - 1, 2) + of_cell(corner, i - 1, j - 1, 3);
  }
  KOKKOS_FORCEINLINE_FUNCTION double of_cell(const Field<double>& values, int i, int j, int which) const {
    return i >= 0 && i < cells_x && j >= 0 && j < cells_y ? values(4 * (j * cells_x + i) + which) : 0.0;
  }

 private:
  static KOKKOS_FORCEINLINE_FUNCTION double clamp(double f) { return smaller(larger(f, 0.0), 1.0); }
};

// What the particles of each cell give to its corners: w_i P.
template <int D>
struct ToCorners {
  Mesh<D> mesh;
  Field<double> value, corner;

  KOKKOS_FUNCTION void operator()(int row) const {
    for (int column = 0; column < mesh.cells_x; ++column) {
      double sw = 0, se = 0, nw = 0, ne = 0;
      mesh.for_each_in(row, column, [&](int i, double fx, double fy) {
        const double east = fx * value(i), west = value(i) - east;
        ne += fy * east, se += east - fy * east;
        nw += fy * west, sw += west - fy * west;
      });
      double* const to = &corner(4 * (row * mesh.cells_x + column));
      to[0] = sw, to[1] = se, to[2] = nw, to[3] = ne;
    }
  }
};

// m H to the edges.
template <int D>
struct ToEdges {
  Mesh<D> mesh;
  Field<double> depth, edge;

  KOKKOS_FUNCTION void operator()(int row) const {
    for (int column = 0; column < mesh.cells_x; ++column) {
      double all = 0, north = 0, east = 0;
      mesh.for_each_in(row, column, [&](int i, double fx, double fy) {
        const double volume = mesh.mass(i) * depth(i);
        all += volume, north += fy * volume, east += fx * volume;
      });
      double* const to = &edge(4 * (row * mesh.cells_x + column));
      to[0] = all - north, to[1] = north, to[2] = all - east, to[3] = east;
    }
  }
};

template <int D>
struct FillSystem {
  Mesh<D> mesh;
  Field<double> corner, edge;
  FivePoint a;
  double kx, ky;  // k / width^2, k / height^2

  KOKKOS_FUNCTION void operator()(int j) const {
    for (int i = 0; i < a.nx; ++i) {
      const int n = j * a.nx + i;
      a.mass(n) = mesh.at_node(corner, i, j);
      a.east(n) = kx * (mesh.of_cell(edge, i, j, 0) + mesh.of_cell(edge, i, j - 1, 1));
      a.north(n) = D == 2 ? ky * (mesh.of_cell(edge, i, j, 2) + mesh.of_cell(edge, i - 1, j, 3)) : 0.0;
    }
  }
};

template <int D>
struct ToNodes {
  Mesh<D> mesh;
  Field<double> corner;
  Vector right;

  KOKKOS_FUNCTION void operator()(int j) const {
    for (int i = 0; i < mesh.nodes_x(); ++i) right(j * mesh.nodes_x() + i) = mesh.at_node(corner, i, j);
  }
};

// z += P c
template <int D>
struct FromNodes {
  Mesh<D> mesh;
  Vector c, z;

  KOKKOS_FUNCTION void operator()(int row) const {
    const int up = D == 2 ? mesh.nodes_x() : 0;
    for (int column = 0; column < mesh.cells_x; ++column) {
      const int n = row * mesh.nodes_x() + column;
      const double sw = c(n), se = c(n + 1), nw = c(n + up), ne = c(n + up + 1);
      mesh.for_each_in(row, column, [&](int i, double fx, double fy) {
        const double south = sw + fx * (se - sw), north = nw + fx * (ne - nw);
        z(i) += south + fy * (north - south);
      });
    }
  }
};

}  // namespace

template <int D>
void ParticleMesh<D>::lay(const Rows& rows, const VecField<double, D>& x) {
  rows_ = rows;
  x_ = x;
  const Mesh<D> mesh(rows_, x_, mass_);
  reserve(corner_, "particle_mesh.corner", 4 * mesh.cells());
  reserve(edge_, "particle_mesh.edge", 4 * mesh.cells());
  multigrid_.resize(mesh.nodes_x(), mesh.nodes_y());
}

template <int D>
void ParticleMesh<D>::set(const Field<double>& mass, const Field<double>& depth, double k) {
  mass_ = mass;
  const Mesh<D> mesh(rows_, x_, mass_);
  const Range rows(0, mesh.cells_y), node_rows(0, mesh.nodes_y());
  Kokkos::parallel_for("particle_mesh::masses", rows, ToCorners<D>{mesh, mass, corner_});
  Kokkos::parallel_for("particle_mesh::edges", rows, ToEdges<D>{mesh, depth, edge_});
  const double kx = k * mesh.per_width * mesh.per_width, ky = k * mesh.per_height * mesh.per_height;
  Kokkos::parallel_for("particle_mesh::system", node_rows, FillSystem<D>{mesh, corner_, edge_, multigrid_.finest(), kx, ky});
  multigrid_.coarsen();
}

template <int D>
double ParticleMesh<D>::operator()(const Vector& r, const Vector& z) {
  const Mesh<D> mesh(rows_, x_, mass_);
  Kokkos::parallel_for("particle_mesh::to_corners", Range(0, mesh.cells_y), ToCorners<D>{mesh, r, corner_});
  Kokkos::parallel_for("particle_mesh::to_nodes", Range(0, mesh.nodes_y()), ToNodes<D>{mesh, corner_, multigrid_.right()});
  const Vector& c = multigrid_.cycle();
  Kokkos::parallel_for("particle_mesh::from_nodes", Range(0, mesh.cells_y), FromNodes<D>{mesh, c, z});
  return dot(sums_, multigrid_.finest().size(), multigrid_.right(), c);
}

template class ParticleMesh<1>;
template class ParticleMesh<2>;

}  // namespace freshet::linear
