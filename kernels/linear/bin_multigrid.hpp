// A multigrid preconditioner for matrices on scattered points, without graph work: unknowns of a square bin are one unknown of the next
// level, bins double in size from level to level, entries are summed (Galerkin with piecewise constants), damped Jacobi smooths, the
// coarse correction is taken 1.6 times, and the last level is inverted. Rows of Dirichlet points (`free` 0) are left out: their
// residual must be zero. Every pass is data parallel and in a fixed order. The points are in the order of cellgrid's rows.
#pragma once
#include <vector>

#include "cellgrid/order.hpp"
#include "kernels/linear/cluster_matrix.hpp"
#include "kernels/linear/vectors.hpp"

namespace freshet::linear {

struct MultigridOptions {
  double damping = 0.7;          // of Jacobi
  int sweeps = 2;                // before and after the coarse correction
  double over_correction = 1.6;
  int coarsest = 64;             // unknowns at most on the level that is inverted
};

// One level: the bins that hold unknowns, numbered along rows of bins.
struct BinLevel {
  int nx = 1, ny = 1;            // bins in the grid
  int rx = 1, ry = 1;            // bins that an entry reaches, along x and y
  bool wrap_x = false, wrap_y = false;
  int size = 0;                  // unknowns
  Field<int> number;             // of bin [y * nx + x], -1 without unknowns
  Field<int> bin;                // of an unknown
  Field<int> parent;             // of an unknown: its number on the next level
  Field<double> weight;          // unknowns of the matrix in it
  Kokkos::View<double**, Kokkos::LayoutLeft, Memory> a;  // [unknown][slot], slot = (dy + ry) (2 rx + 1) + dx + rx
  Kokkos::View<int**, Kokkos::LayoutLeft, Memory> column;
  Vector inverse_diagonal;
  Vector b, x, y;                // of the cycle

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
  KOKKOS_FORCEINLINE_FUNCTION int blocks() const { return (size + lanes - 1) / lanes; }
  KOKKOS_FORCEINLINE_FUNCTION Lanes block(int c) const { return {c * lanes, smaller(lanes, size - c * lanes)}; }
  KOKKOS_FORCEINLINE_FUNCTION Lane times(int c, const Vector& v) const {
    Lane sum{0.0};
    for (int s = 0; s < width(); ++s) {
      Lane entry;
      LaneIndex j;
      __builtin_memcpy(&entry, &a(c * lanes, s), sizeof entry);
      __builtin_memcpy(&j, &column(c * lanes, s), sizeof j);
      sum += entry * gather(v.data(), j);
    }
    return sum;
  }
  KOKKOS_FORCEINLINE_FUNCTION Lane per_diagonal(int c) const { return block(c).load(inverse_diagonal); }
};

class BinMultigrid {
 public:
  explicit BinMultigrid(const MultigridOptions& options = {}) : options_(options) {}

  struct Grid {
    Rows rows;                             // of the points
    double reach = 0;                      // m, of the matrix
    bool wrap_x = false, wrap_y = false;   // periodic
  };
  // Makes the levels of a matrix. free: 1 where a point's value is unknown. singular: constants are in its null space and
  // the operator is A + 1 1^T / n.
  void build(const ClusterMatrix& matrix, const Field<int>& free, const Grid& grid, bool singular);

  // z := one V-cycle on r from zero.
  void operator()(const Vector& r, const Vector& z);

  int levels() const { return depth_; }

 public:  // device lambdas may not live in private members
  void find_clusters();
  void number_bins(BinLevel& level);
  void sum_points(BinLevel& level);
  void sum_bins(const BinLevel& fine, BinLevel& coarse);
  void invert_last(bool singular);
  void cycle(int depth);

 private:
  MultigridOptions options_;
  ClusterMatrix matrix_;
  Field<int> free_, cluster_, parent_;  // of a point: its cluster, its unknown on the first level or -1
  Rows rows_;
  int bins_ = 4;                        // of the rows' that make one of the first level
  std::vector<BinLevel> levels_;        // of which the first depth_ are in use
  int depth_ = 0;
  using Table = Kokkos::View<double**, Kokkos::LayoutRight, Memory>;
  Table inverse_;                       // of the last level
  Vector y_;
};

}  // namespace freshet::linear
