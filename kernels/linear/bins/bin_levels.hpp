// The levels of the bin multigrid (bin_multigrid.hpp): square bins of points, then of bins, with their
// matrices as stencils on the grid of bins.
#pragma once
#include "cellgrid/particles/order.hpp"
#include "kernels/linear/cluster_matrix.hpp"
#include "kernels/linear/vectors.hpp"

namespace freshet::linear {

// One level: the bins that hold unknowns, numbered along rows of bins.
struct BinLevel {
  int nx = 1, ny = 1;  // bins in the grid
  int rx = 1, ry = 1;  // bins that an entry reaches, along x and y
  bool wrap_x = false, wrap_y = false;
  int size = 0;          // unknowns
  Field<int> number;     // of bin [y * nx + x], -1 without unknowns
  Field<int> bin;        // of an unknown
  Field<int> parent;     // of an unknown: its number on the next level
  Field<double> weight;  // unknowns of the matrix in it
  // [unknown][slot], slot = (dy + ry) (2 rx + 1) + dx + rx
  Kokkos::View<double**, Kokkos::LayoutLeft, Memory> a;
  Kokkos::View<int**, Kokkos::LayoutLeft, Memory> column;
  // of a block of rows: 1 where the columns of each slot follow each other, as away from the rim
  Field<int> even;
  Vector inverse_diagonal;
  Vector b, x, y;  // of the cycle

  KOKKOS_FORCEINLINE_FUNCTION int width() const { return (2 * rx + 1) * (2 * ry + 1); }
  KOKKOS_FORCEINLINE_FUNCTION int centre() const { return width() / 2; }

  // The shortest way between two bins of a round of `count`.
  static KOKKOS_FORCEINLINE_FUNCTION int shortest(int d, int count) {
    if (2 * d > count) return d - count;
    return 2 * d <= -count ? d + count : d;
  }
  KOKKOS_FORCEINLINE_FUNCTION int slot(int from, int to) const {
    int dx = to % nx - from % nx, dy = to / nx - from / nx;
    if (wrap_x) dx = shortest(dx, nx);
    if (wrap_y) dy = shortest(dy, ny);
    return (dy + ry) * (2 * rx + 1) + dx + rx;
  }
  // The unknown in a slot of a bin's row, -1 if there is none.
  KOKKOS_FORCEINLINE_FUNCTION int unknown(int from, int s) const {
    int px = from % nx + s % (2 * rx + 1) - rx, py = from / nx + s / (2 * rx + 1) - ry;
    if (wrap_x) px = (px + nx) % nx;
    if (wrap_y) py = (py + ny) % ny;
    return px < 0 || px >= nx || py < 0 || py >= ny ? -1 : number(py * nx + px);
  }

  // As a matrix of rows in blocks of lanes; see ClusterMatrix.
  KOKKOS_FORCEINLINE_FUNCTION int blocks() const { return freshet::blocks(size); }
  KOKKOS_FORCEINLINE_FUNCTION Lanes block(int c) const { return freshet::block(c, size); }
  KOKKOS_FORCEINLINE_FUNCTION Lane times(int c, const Vector& v) const {
    Lane sum{0.0};
    if (even(c)) {
      for (int s = 0; s < width(); ++s) sum += entry(c, s) * loaded<Lane>(v.data() + column(c * lanes, s));
      return sum;
    }
    for (int s = 0; s < width(); ++s)
      sum += entry(c, s) * gather(v.data(), loaded<LaneIndex>(&column(c * lanes, s)));
    return sum;
  }
  KOKKOS_FORCEINLINE_FUNCTION Lane entry(int c, int s) const { return loaded<Lane>(&a(c * lanes, s)); }
  KOKKOS_FORCEINLINE_FUNCTION Lane per_diagonal(int c) const { return block(c).load(inverse_diagonal); }
};

// The run of points in a bin of the first level.
struct PointsOfBins {
  Rows rows;
  int bins;  // of the rows' in one
  int nx;
  KOKKOS_FORCEINLINE_FUNCTION int first(int bin) const { return rows.begin(bin / nx, bin % nx * bins); }
  KOKKOS_FORCEINLINE_FUNCTION int end(int bin) const {
    return rows.end(bin / nx, smaller((bin % nx + 1) * bins, rows.bins) - 1);
  }
};

// Calls see(unknown) for the unknowns of the finer level in a bin.
template <class See>
KOKKOS_FORCEINLINE_FUNCTION void for_each_child(const BinLevel& fine, const BinLevel& coarse, int bin,
                                                const See& see) {
  const int x0 = 2 * (bin % coarse.nx), y0 = 2 * (bin / coarse.nx);
  for (int y = y0; y < smaller(y0 + 2, fine.ny); ++y)
    for (int x = x0; x < smaller(x0 + 2, fine.nx); ++x)
      if (fine.number(y * fine.nx + x) >= 0) see(fine.number(y * fine.nx + x));
}

}  // namespace freshet::linear
