#include "kernels/linear/bins/bin_multigrid.hpp"

#include <utility>

#include "cellgrid/parallel/launch.hpp"

namespace freshet::linear {
namespace {

// The points' matrix with the words of BinLevel.
struct Points {
  ClusterMatrix m;
  int blocks() const { return m.clusters.size(); }
  KOKKOS_FORCEINLINE_FUNCTION Lanes block(int c) const { return m.clusters(c); }
  KOKKOS_FORCEINLINE_FUNCTION Lane times(int c, const Vector& v) const { return m.times_rough(c, v); }
  KOKKOS_FORCEINLINE_FUNCTION Lane per_diagonal(int) const { return 1.0; }
};

// Launch labels: on points, on bins.
const char* smooth_label(const Points&) { return "multigrid::smooth_points"; }
const char* smooth_label(const BinLevel&) { return "multigrid::smooth_bins"; }
const char* residual_label(const Points&) { return "multigrid::residual_points"; }
const char* residual_label(const BinLevel&) { return "multigrid::residual_bins"; }

// to := damping D^-1 b
template <class Level>
void smooth_zero(const Level& level, const Vector& b, const Vector& to, double damping) {
  launch(
      "multigrid::smooth_zero", Range(0, level.blocks()), KOKKOS_LAMBDA(int c) {
        const Lanes me = level.block(c);
        me.store(to, damping * level.per_diagonal(c) * me.load(b));
      });
}

// to := x + damping D^-1 (b - A x)
template <class Level>
void smooth(const Level& level, const Vector& b, const Vector& x, const Vector& to, double damping) {
  launch(
      smooth_label(level), Range(0, level.blocks()), KOKKOS_LAMBDA(int c) {
        const Lanes me = level.block(c);
        me.store(to, me.load(x) + damping * level.per_diagonal(c) * (me.load(b) - level.times(c, x)));
      });
}

// Sweeps from zero; the result is in x, y is scratch.
template <class Level>
void smooth_from_zero(const Level& level, const Vector& b, Vector& x, Vector& y,
                      const MultigridOptions& options) {
  smooth_zero(level, b, x, options.damping_of(0));
  for (int s = 1; s < options.sweeps; ++s, std::swap(x, y)) smooth(level, b, x, y, options.damping_of(s));
}

// to := b - A x
template <class Level>
void find_residual(const Level& level, const Vector& b, const Vector& x, const Vector& to) {
  launch(
      residual_label(level), Range(0, level.blocks()), KOKKOS_LAMBDA(int c) {
        const Lanes me = level.block(c);
        me.store(to, me.load(b) - level.times(c, x));
      });
}

// x += factor e(parent)
void add_coarse(int n, const Field<int>& parent, double factor, const Vector& e, const Vector& x) {
  launch(
      "multigrid::add_coarse", Range(0, n), KOKKOS_LAMBDA(int i) {
        if (parent(i) >= 0) x(i) += factor * e(parent(i));
      });
}

}  // namespace

void BinMultigrid::operator()(const Vector& r, const Vector& z) {
  const TimedRegion region("multigrid::cycle");
  const Points points{matrix_};
  Vector x = y_, y = z;  // an odd number of sweeps ends in z
  smooth_from_zero(points, r, x, y, options_);
  find_residual(points, r, x, y);
  const BinLevel& first = levels_.front();
  const PointsOfBins bins{rows_, bins_, first.nx};
  const Field<int> bin = first.bin;
  const Vector b = first.b;
  launch(
      "multigrid::restrict_points", Range(0, first.size), KOKKOS_LAMBDA(int k) {
        double sum = 0;
        for (int i = bins.first(bin(k)); i < bins.end(bin(k)); ++i) sum += y(i);
        b(k) = sum;
      });
  cycle(0);
  add_coarse(matrix_.rows, parent_, options_.over_correction, first.x, x);
  for (int s = 0; s < options_.sweeps; ++s, std::swap(x, y))
    smooth(points, r, x, y, options_.damping_of(s + 1));
}

// level.x := one cycle on level.b.
void BinMultigrid::cycle(int depth) {
  BinLevel& level = levels_[static_cast<std::size_t>(depth)];
  const Vector b = level.b;
  if (depth + 1 == depth_) {
    const auto inverse = inverse_;
    const Vector x = level.x;
    const int n = level.size;
    launch(
        "multigrid::coarsest", Range(0, n), KOKKOS_LAMBDA(int i) {
          double sum = 0;
          for (int j = 0; j < n; ++j) sum += inverse(i, j) * b(j);
          x(i) = sum;
        });
    return;
  }
  smooth_from_zero(level, b, level.x, level.y, options_);
  find_residual(level, b, level.x, level.y);
  const BinLevel fine = level, coarse = levels_[static_cast<std::size_t>(depth + 1)];
  launch(
      "multigrid::restrict", Range(0, coarse.size), KOKKOS_LAMBDA(int k) {
        double sum = 0;
        for_each_child(fine, coarse, coarse.bin(k), [&](int i) { sum += fine.y(i); });
        coarse.b(k) = sum;
      });
  cycle(depth + 1);
  add_coarse(level.size, level.parent, options_.over_correction,
             levels_[static_cast<std::size_t>(depth + 1)].x, level.x);
  for (int s = 0; s < options_.sweeps; ++s, std::swap(level.x, level.y))
    smooth(level, b, level.x, level.y, options_.damping_of(s + 1));
}

}  // namespace freshet::linear
