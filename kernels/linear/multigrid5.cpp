#include "kernels/linear/multigrid5.hpp"

#include <cstddef>

namespace freshet::linear {
namespace {

// Fine node 2I is coarse node I; an odd one lies between two, the last odd one takes the value of the one before.
KOKKOS_INLINE_FUNCTION int coarse_count(int n) { return (n + 1) / 2; }
// Weight of the nearest coarse nodes at a fine node, of n fine nodes; 0 beyond the grid.
KOKKOS_INLINE_FUNCTION double share(int fine, int n) {
  if (fine < 0 || fine >= n) return 0;
  return fine % 2 == 0 || fine == n - 1 ? 1.0 : 0.5;
}

// One colour: 0 red (i + j even), 1 black. c = (right + sum k c_m) / diagonal.
struct Smooth {
  FivePoint a;
  Vector inverse, right, c;
  int colour;

  KOKKOS_FUNCTION void operator()(int row) const {
    for (int i = (row + colour) % 2; i < a.nx; i += 2) {
      const int n = row * a.nx + i;
      c(n) = inverse(n) * (right(n) + a.neighbours(c, i, row));
    }
  }
};

// c = right / diagonal on red nodes and zero on black: the first half of smoothing from zero.
struct SmoothFromZero {
  FivePoint a;
  Vector inverse, right, c;

  KOKKOS_FUNCTION void operator()(int row) const {
    for (int i = 0; i < a.nx; ++i) {
      const int n = row * a.nx + i;
      c(n) = (i + row) % 2 == 0 ? inverse(n) * right(n) : 0.0;
    }
  }
};

// P^T of the residual. Behind a black sweep it is zero on black nodes, so only red ones are visited.
struct Restrict {
  FivePoint a, coarse;
  Vector right, c, coarse_right;

  KOKKOS_FUNCTION double residual(int i, int j) const {
    const int n = j * a.nx + i;
    return right(n) - a.diagonal(i, j) * c(n) + a.neighbours(c, i, j);
  }

  KOKKOS_FUNCTION void operator()(int row) const {
    for (int i = 0; i < coarse.nx; ++i) {
      double sum = residual(2 * i, 2 * row);
      for (int dj = -1; dj <= 1; dj += 2)
        for (int di = -1; di <= 1; di += 2) {
          const double w = share(2 * i + di, a.nx) * share(2 * row + dj, a.ny);
          if (w > 0) sum += w * residual(2 * i + di, 2 * row + dj);
        }
      coarse_right(row * coarse.nx + i) = sum;
    }
  }
};

// c += P coarse on red nodes: the black sweep that follows does not read black ones.
struct Prolong {
  FivePoint a, coarse;
  Vector c, coarse_c;

  KOKKOS_FUNCTION void operator()(int row) const {
    for (int i = row % 2; i < a.nx; i += 2) {
      const int i0 = i / 2, j0 = row / 2, n = j0 * coarse.nx + i0;
      double value = coarse_c(n);
      if (row % 2 == 1) {  // both odd
        const bool east = i0 + 1 < coarse.nx, north = j0 + 1 < coarse.ny;
        const double right = coarse_c(east ? n + 1 : n), above = coarse_c(north ? n + coarse.nx : n);
        const double corner = coarse_c(n + (east ? 1 : 0) + (north ? coarse.nx : 0));
        value = 0.25 * (value + right + above + corner);
      }
      c(row * a.nx + i) += value;
    }
  }
};

// mass: P^T mass. Conductances: the two fine ones in a row as linear interpolation sees them, (k + k') / 4, over the width.
struct Coarsen {
  FivePoint a, coarse;

  KOKKOS_FUNCTION double along_x(int i, int j) const { return 0.25 * (a.to_east(2 * i, j) + a.to_east(2 * i + 1, j)); }
  KOKKOS_FUNCTION double along_y(int i, int j) const { return 0.25 * (a.to_north(i, 2 * j) + a.to_north(i, 2 * j + 1)); }

  KOKKOS_FUNCTION void operator()(int row) const {
    for (int i = 0; i < coarse.nx; ++i) {
      double mass = 0, east = 0, north = 0;
      for (int d = -1; d <= 1; ++d) {
        const double wx = share(2 * i + d, a.nx), wy = share(2 * row + d, a.ny);
        if (wy > 0) east += wy * along_x(i, 2 * row + d);
        if (wx > 0) north += wx * along_y(2 * i + d, row);
        for (int dj = -1; dj <= 1 && wx > 0; ++dj) {
          const double w = wx * share(2 * row + dj, a.ny);
          if (w > 0) mass += w * a.mass((2 * row + dj) * a.nx + 2 * i + d);
        }
      }
      const int n = row * coarse.nx + i;
      coarse.mass(n) = mass;
      coarse.east(n) = i + 1 < coarse.nx ? east : 0.0;
      coarse.north(n) = row + 1 < coarse.ny ? north : 0.0;
    }
  }
};

void invert_diagonal(const FivePoint& a, const Vector& inverse) {
  Kokkos::parallel_for("multigrid5::diagonal", Range(0, a.ny), KOKKOS_LAMBDA(int row) {
        for (int i = 0; i < a.nx; ++i) {
          const double d = a.diagonal(i, row);
          inverse(row * a.nx + i) = d > 0 ? 1 / d : 0.0;
        }
      });
}

}  // namespace

void Multigrid5::resize(int nx, int ny) {
  if (!levels_.empty() && levels_.front().a.nx == nx && levels_.front().a.ny == ny) return;
  levels_.clear();
  for (;; nx = coarse_count(nx), ny = coarse_count(ny)) {
    const auto vector = [n = static_cast<size_t>(nx) * static_cast<size_t>(ny)](const std::string& label) { return Vector(label, n); };
    levels_.push_back({{nx, ny, vector("multigrid5.mass"), vector("multigrid5.east"), vector("multigrid5.north")},
                       vector("multigrid5.inverse"), vector("multigrid5.right"), vector("multigrid5.c")});
    if (nx == 1 && ny == 1) return;
  }
}

void Multigrid5::coarsen() {
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    const Level& here = levels_[l];
    if (l > 0) Kokkos::parallel_for("multigrid5::coarsen", Range(0, here.a.ny), Coarsen{levels_[l - 1].a, here.a});
    invert_diagonal(here.a, here.inverse);
  }
}

const Vector& Multigrid5::cycle() {
  const Region region("multigrid5");
  const auto sweep = [](const Level& l, int colour) {
    Kokkos::parallel_for("multigrid5::smooth", Range(0, l.a.ny), Smooth{l.a, l.inverse, l.right, l.c, colour});
  };
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    const Level& here = levels_[l];
    Kokkos::parallel_for("multigrid5::smooth_from_zero", Range(0, here.a.ny), SmoothFromZero{here.a, here.inverse, here.right, here.c});
    sweep(here, 1);
    if (l + 1 == levels_.size()) break;
    const Level& below = levels_[l + 1];
    Kokkos::parallel_for("multigrid5::restrict", Range(0, below.a.ny), Restrict{here.a, below.a, here.right, here.c, below.right});
  }
  for (std::size_t l = levels_.size(); l-- > 0;) {
    const Level& here = levels_[l];
    if (l + 1 < levels_.size()) {
      const Level& below = levels_[l + 1];
      Kokkos::parallel_for("multigrid5::prolong", Range(0, here.a.ny), Prolong{here.a, below.a, here.c, below.c});
    }
    sweep(here, 1);
    sweep(here, 0);
  }
  return levels_.front().c;
}

}  // namespace freshet::linear
