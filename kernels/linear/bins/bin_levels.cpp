// BinMultigrid: how the levels are made.
#define EIGEN_NO_CUDA  // used on the host alone: nvcc would take its functions for device code
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <string>

#include "cellgrid/parallel/launch.hpp"
#include "kernels/linear/bins/bin_multigrid.hpp"

namespace freshet::linear {
namespace {

void grow(Field<int>& field, const std::string& label, int n) {
  if (field.extent_int(0) < n) field = Field<int>(label, static_cast<size_t>(n + n / 2 + 16));
}
// Zero-filled, with room for a last partial block.
void grow(Vector& field, const std::string& label, int n) {
  if (field.extent_int(0) < n + lanes) field = Vector(label, static_cast<size_t>(n + n / 2 + 16 + lanes));
}
template <class View>
void grow(View& table, const std::string& label, int n, int width) {
  if (table.extent_int(0) >= n + lanes && table.extent_int(1) >= width) return;
  table = {};
  table = View(Kokkos::ViewAllocateWithoutInitializing(label), static_cast<size_t>(n + n / 2 + 16 + lanes),
               static_cast<size_t>(width));
  prefer_huge_pages(table);
  Kokkos::deep_copy(table, 0);
}

int halved(int n) { return (n + 1) / 2; }

// Bins that an entry reaches on the next level; of an odd number of bins round a period the last one stays
// half a bin.
int halved_reach(int reach, int bins, bool wrap) { return (reach + 1 + (wrap && bins % 2 == 1)) / 2; }

// Finds which bin each fine unknown's is, once the coarse bins are numbered.
void find_parents(const BinLevel& fine, const BinLevel& coarse) {
  const BinLevel f = fine, c = coarse;
  launch(
      "multigrid::parents", Range(0, fine.size),
      KOKKOS_LAMBDA(int k) { f.parent(k) = c.number(f.bin(k) / f.nx / 2 * c.nx + f.bin(k) % f.nx / 2); });
}

void reserve(BinLevel& level) {
  const int n = level.size;
  grow(level.bin, "multigrid.bin", n);
  grow(level.parent, "multigrid.parent", n);
  grow(level.weight, "multigrid.weight", n);
  grow(level.a, "multigrid.a", n, level.width());
  grow(level.column, "multigrid.column", n, level.width());
  grow(level.even, "multigrid.even", level.blocks());
  for (Vector* v : {&level.inverse_diagonal, &level.b, &level.x, &level.y}) grow(*v, "multigrid.vector", n);
}

// Zero rows with their columns; a slot without unknown refers to its own row. And which blocks can do without
// gathers.
void clear_rows(const BinLevel& level) {
  launch(
      "multigrid::clear_rows", Range(0, level.size), KOKKOS_LAMBDA(int k) {
        for (int s = 0; s < level.width(); ++s) {
          const int j = level.unknown(level.bin(k), s);
          level.a(k, s) = 0;
          level.column(k, s) = j < 0 ? k : j;
        }
      });
  launch(
      "multigrid::even", Range(0, level.blocks()), KOKKOS_LAMBDA(int c) {
        const int first = c * lanes;
        int even = first + lanes <= level.size;
        for (int s = 0; s < level.width(); ++s)
          for (int l = 1; even && l < lanes; ++l)
            even = level.column(first + l, s) == level.column(first, s) + l;
        level.even(c) = even;
      });
}

void invert_diagonal(const BinLevel& level) {
  launch(
      "multigrid::diagonal", Range(0, level.size), KOKKOS_LAMBDA(int k) {
        const double d = level.a(k, level.centre());
        level.inverse_diagonal(k) = d > 1e-3 * level.weight(k)
                                        ? 1 / d
                                        : 1 / level.weight(k);  // rows near zero are not smoothed by them
      });
}

}  // namespace

void BinMultigrid::find_clusters() {
  const ClusterMatrix m = matrix_;
  grow(cluster_, "multigrid.cluster", m.rows);
  const Field<int> cluster = cluster_;
  launch(
      "multigrid::clusters", Range(0, m.clusters.size()), KOKKOS_LAMBDA(int c) {
        const Lanes me = m.clusters(c);
        for (int l = 0; l < me.count; ++l) cluster(me.first + l) = c;
      });
}

// Numbers the bins whose `number` is not negative, in their order, and lists them.
void BinMultigrid::number_bins(BinLevel& level) {
  const Field<int> number = level.number;
  Kokkos::parallel_scan(
      "multigrid::number", Range(0, level.nx * level.ny),
      KOKKOS_LAMBDA(int bin, int& sum, bool last) {
        const bool holds = number(bin) >= 0;
        if (last && holds) number(bin) = sum;
        sum += holds;
      },
      level.size);
  reserve(level);
  const BinLevel l = level;
  launch(
      "multigrid::list_bins", Range(0, level.nx * level.ny), KOKKOS_LAMBDA(int bin) {
        if (l.number(bin) >= 0) l.bin(l.number(bin)) = bin;
      });
}

void BinMultigrid::build(const ClusterMatrix& matrix, const Field<int>& free, const Grid& grid,
                         bool singular) {
  const TimedRegion region("multigrid::build");
  matrix_ = matrix;
  free_ = free;
  rows_ = grid.rows;
  bins_ = static_cast<int>(std::fmax(1, std::round(rows_.row_height / rows_.bin_width)));
  if (levels_.empty()) levels_.resize(1);
  grow(y_, "multigrid.y", matrix.rows);
  find_clusters();
  BinLevel& first = levels_.front();
  first.nx = (rows_.bins - 1) / bins_ + 1;
  first.ny = rows_.rows;
  first.rx = static_cast<int>(std::ceil(grid.reach / (bins_ * rows_.bin_width))) +
             grid.wrap_x;  // the last bin round a period
  first.ry = static_cast<int>(std::ceil(grid.reach / rows_.row_height)) + grid.wrap_y;  // may be narrow
  first.wrap_x = grid.wrap_x;
  first.wrap_y = grid.wrap_y;
  sum_points(first);
  for (depth_ = 1; levels_[static_cast<std::size_t>(depth_ - 1)].size > options_.coarsest; ++depth_) {
    if (levels_.size() == static_cast<std::size_t>(depth_)) levels_.emplace_back();
    sum_bins(levels_[static_cast<std::size_t>(depth_ - 1)], levels_[static_cast<std::size_t>(depth_)]);
  }
  invert_last(singular);
}

void BinMultigrid::sum_points(BinLevel& level) {
  grow(level.number, "multigrid.number", level.nx * level.ny);
  grow(parent_, "multigrid.point_parent", matrix_.rows);
  const PointsOfBins points{rows_, bins_, level.nx};
  const Field<int> number = level.number, free = free_, parent = parent_, cluster = cluster_;
  launch(
      "multigrid::mark_bins", Range(0, level.nx * level.ny), KOKKOS_LAMBDA(int bin) {
        int holds = -1;
        for (int i = points.first(bin); i < points.end(bin); ++i) holds = free(i) ? 1 : holds;
        number(bin) = holds;
      });
  number_bins(level);
  const BinLevel l = level;
  const ClusterMatrix m = matrix_;
  launch(
      "multigrid::point_parents", Range(0, level.nx * level.ny), KOKKOS_LAMBDA(int bin) {
        for (int i = points.first(bin); i < points.end(bin); ++i) parent(i) = free(i) ? l.number(bin) : -1;
      });
  clear_rows(level);
  launch(
      "multigrid::sum_points", Range(0, level.size), KOKKOS_LAMBDA(int k) {
        double members = 0;
        for (int i = points.first(l.bin(k)); i < points.end(l.bin(k)); ++i) {
          if (!free(i)) continue;
          members += 1;
          const int c = cluster(i), lane = i - m.clusters(c).first;
          for (int p = 0, last = -1, slot = 0; p < m.near.length(c); ++p) {
            const int to = parent(m.near.list(c, p));
            const double entry = m.a(m.start(c) + p, lane);
            if (to < 0 || entry == 0) continue;
            if (to != last) slot = l.slot(l.bin(k), l.bin(to));  // neighbours of a bin follow each other
            last = to;
            l.a(k, slot) += entry;
          }
        }
        l.a(k, l.centre()) += members;  // the diagonal's ones
        l.weight(k) = members;
      });
  invert_diagonal(level);
}

void BinMultigrid::sum_bins(const BinLevel& fine, BinLevel& coarse) {
  coarse.nx = halved(fine.nx);
  coarse.ny = halved(fine.ny);
  coarse.rx = halved_reach(fine.rx, fine.nx, fine.wrap_x);
  coarse.ry = halved_reach(fine.ry, fine.ny, fine.wrap_y);
  coarse.wrap_x = fine.wrap_x;
  coarse.wrap_y = fine.wrap_y;
  grow(coarse.number, "multigrid.number", coarse.nx * coarse.ny);
  const BinLevel f = fine, grid = coarse;
  launch(
      "multigrid::mark_bins", Range(0, coarse.nx * coarse.ny), KOKKOS_LAMBDA(int bin) {
        grid.number(bin) = -1;
        for_each_child(f, grid, bin, [&](int) { grid.number(bin) = 1; });
      });
  number_bins(coarse);
  find_parents(fine, coarse);
  clear_rows(coarse);
  const BinLevel l = coarse;
  launch(
      "multigrid::sum_bins", Range(0, coarse.size), KOKKOS_LAMBDA(int k) {
        l.weight(k) = 0;
        for_each_child(f, l, l.bin(k), [&](int i) {
          l.weight(k) += f.weight(i);
          for (int s = 0; s < f.width(); ++s)
            if (f.a(i, s) != 0) l.a(k, l.slot(l.bin(k), l.bin(f.parent(f.column(i, s))))) += f.a(i, s);
        });
      });
  invert_diagonal(coarse);
}

// On the host, which few unknowns allow.
void BinMultigrid::invert_last(bool singular) {
  const BinLevel& last = levels_[static_cast<std::size_t>(depth_ - 1)];
  const auto a = on_host(last.a);
  const auto column = on_host(last.column);
  const auto weight = on_host(last.weight);
  const int n = last.size;
  if (inverse_.extent_int(0) < n)
    inverse_ = Table("multigrid.inverse", static_cast<size_t>(n), static_cast<size_t>(n));
  const Eigen::Map<const Eigen::VectorXd> shares(weight.data(), n);
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
  if (singular) dense = shares * shares.transpose() / shares.sum();
  for (int i = 0; i < n; ++i)
    for (int s = 0; s < last.width(); ++s) dense(i, column(i, s)) += a(i, s);
  // The pseudo-inverse: what the matrix does not determine is zero.
  dense = Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(dense).pseudoInverse().eval();
  const auto inverse = Kokkos::create_mirror_view(inverse_);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) inverse(i, j) = dense(i, j);
  Kokkos::deep_copy(inverse_, inverse);
}

}  // namespace freshet::linear
