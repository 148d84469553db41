// A multigrid preconditioner for matrices on scattered points, without graph work: unknowns of a square bin
// are one unknown of the next level, bins double in size from level to level, entries are summed (Galerkin
// with piecewise constants), damped Jacobi smooths, the coarse correction is taken 1.7 times, and the last
// level is inverted. Rows of Dirichlet points (`free` 0) are left out: their residual must be zero. Every
// pass is data parallel and in a fixed order. The points are in the order of cellgrid's rows.
#pragma once
#include <array>
#include <vector>

#include "kernels/linear/bins/bin_levels.hpp"

namespace freshet::linear {

struct MultigridOptions {
  std::array<double, 2> damping{
      0.7, 1.5};   // of Jacobi's sweeps in turn: together they flatten what bins of two spacings do not see
  int sweeps = 2;  // before and after the coarse correction
  double over_correction = 1.7;
  int coarsest = 64;  // unknowns at most on the level that is inverted

  double damping_of(int sweep) const { return damping[static_cast<std::size_t>(sweep % 2)]; }
};

class BinMultigrid {
 public:
  explicit BinMultigrid(const MultigridOptions& options = {}) : options_(options) {}

  struct Grid {
    Rows rows;                            // of the points
    double reach = 0;                     // m, of the matrix
    bool wrap_x = false, wrap_y = false;  // periodic
  };
  // Makes the levels of a matrix. free: 1 where a point's value is unknown. singular: constants are in its
  // null space and the operator is A + 1 1^T / n.
  void build(const ClusterMatrix& matrix, const Field<int>& free, const Grid& grid, bool singular);

  // z := one V-cycle on r from zero.
  void operator()(const Vector& r, const Vector& z);

  int levels() const { return depth_; }

 public:
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
  int bins_ = 4;                  // of the rows' that make one of the first level
  std::vector<BinLevel> levels_;  // of which the first depth_ are in use
  int depth_ = 0;
  using Table = Kokkos::View<double**, Kokkos::LayoutRight, Memory>;
  Table inverse_;  // of the last level
  Vector y_;
};

}  // namespace freshet::linear
