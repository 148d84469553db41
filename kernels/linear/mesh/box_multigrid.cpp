#include "kernels/linear/mesh/box_multigrid.hpp"

#include <utility>

#include "cellgrid/parallel/launch.hpp"

namespace freshet::linear {
namespace {

constexpr double first_damping = 0.7,
                 second_damping = 1.2;  // of the two sweeps; afterwards in the other order
constexpr double nothing = 1e-8;        // of the largest diagonal of a level: below it a node is not coupled

KOKKOS_INLINE_FUNCTION int coarse_count(int n) { return (n + 1) / 2; }

// Along one axis of n fine nodes: node 2I is coarse node I, an odd one lies between two. The last of an even
// number takes the value of the one before unless the axis is periodic.
struct Axis {
  int n;
  bool wrap;

  // Weight of an odd node, or of one off the ends, at the coarse nodes beside it.
  KOKKOS_FORCEINLINE_FUNCTION double share(int odd) const {
    if (odd < 0 || odd >= n) return wrap && odd < 0 && n % 2 == 0 ? 0.5 : 0.0;
    return odd == n - 1 && !wrap ? 1.0 : 0.5;
  }
  KOKKOS_FORCEINLINE_FUNCTION double weight(int fine) const { return fine % 2 == 0 ? 1.0 : share(fine); }
  // Conductance between coarse nodes I and I + 1 of the two faces between them, the second of which is at
  // `step` from the first.
  KOKKOS_FORCEINLINE_FUNCTION double across(const Vector& k, int at, int step, int coarse) const {
    const int a = 2 * coarse;
    if (coarse_count(n) == 1 || (!wrap && a + 2 >= n)) return 0;
    return a + 1 < n ? 0.25 * (k(at) + k(at + step))
                     : k(at);  // an odd number of nodes: the last is next to the first
  }
};

KOKKOS_FORCEINLINE_FUNCTION Axis along_x(const BoxGrid& g) { return {g.nx, g.wrap_x}; }
KOKKOS_FORCEINLINE_FUNCTION Axis along_y(const BoxGrid& g) { return {g.ny, g.wrap_y}; }

// sum k_f c_m at a row's nodes
struct Neighbours {
  const double *east, *north, *c;
  int stride;
  KOKKOS_FORCEINLINE_FUNCTION Neighbours(const BoxLevel& l, const Vector& v, int at)
      : east(l.east.data() + at), north(l.north.data() + at), c(v.data() + at), stride(l.grid.stride()) {}
  KOKKOS_FORCEINLINE_FUNCTION double operator()(int i) const {
    return east[i] * c[i + 1] + east[i - 1] * c[i - 1] + north[i] * c[i + stride] +
           north[i - stride] * c[i - stride];
  }
  KOKKOS_FORCEINLINE_FUNCTION double conductance(int i) const {
    return east[i] + east[i - 1] + north[i] + north[i - stride];
  }
};

struct SmoothFromZero {
  BoxLevel l;

  KOKKOS_FUNCTION void operator()(int j) const {
    const int at = l.grid.start(j);
    double* const to = l.c.data() + at;
    const double *const inverse = l.inverse.data() + at, *const right = l.right.data() + at;
    for (int i = 0; i < l.grid.nx; ++i) to[i] = first_damping * inverse[i] * right[i];
    l.grid.wrap(l.c, j);
  }
};

// to := c + damping D^-1 (right - A c); with `residual`: to := right - A c
template <bool Residual>
struct Sweep {
  BoxLevel l;
  Vector c, to;
  double factor;

  KOKKOS_FUNCTION void operator()(int j) const {
    const int at = l.grid.start(j);
    const Neighbours sum(l, c, at);
    double* const KOKKOS_RESTRICT result = to.data() + at;
    const double *const inverse = l.inverse.data() + at, *const right = l.right.data() + at,
                        *const mass = l.mass.data() + at;
    for (int i = 0; i < l.grid.nx; ++i) {
      const double here = sum.c[i], r = right[i] - (mass[i] + sum.conductance(i)) * here + sum(i);
      result[i] = Residual ? r : here + factor * inverse[i] * r;
    }
    l.grid.wrap(to, j);
  }
};

// right := P^T residual
struct Restrict {
  BoxLevel fine, coarse;

  KOKKOS_FUNCTION void operator()(int row) const {
    const Axis x = along_x(fine.grid), y = along_y(fine.grid);
    const int at = fine.grid.start(2 * row), stride = fine.grid.stride(), to = coarse.grid.start(row),
              last = coarse.grid.nx - 1;
    const double south = y.share(2 * row - 1), north = y.share(2 * row + 1);
    const double* const r = fine.spare.data() + at;
    const auto column = [&](int i) { return r[i] + south * r[i - stride] + north * r[i + stride]; };
    const auto put = [&](int i, double west, double east) {
      coarse.right(to + i) = column(2 * i) + west * column(2 * i - 1) + east * column(2 * i + 1);
    };
    put(0, x.share(-1), x.share(1));
    for (int i = 1; i < last; ++i) put(i, 0.5, 0.5);
    if (last > 0) put(last, 0.5, x.share(2 * last + 1));
    coarse.grid.wrap(coarse.right, row);
  }
};

// c += P coarse c
struct Prolong {
  BoxLevel fine, coarse;

  KOKKOS_FUNCTION void operator()(int row) const {
    const BoxGrid f = fine.grid, g = coarse.grid;
    const bool clip_y = !f.wrap_y && (row + 1) / 2 >= g.ny, clip_x = !f.wrap_x;
    const double *const below = coarse.c.data() + g.start(row / 2), *const above =
                                                                        coarse.c.data() +
                                                                        g.start(clip_y ? row / 2
                                                                                       : (row + 1) / 2);
    double* const KOKKOS_RESTRICT to = fine.c.data() + f.start(row);
    for (int i = 0; i < f.nx / 2; ++i) {
      const int next = clip_x && i + 1 == g.nx ? i : i + 1;
      const double here = 0.5 * (below[i] + above[i]), there = 0.5 * (below[next] + above[next]);
      to[2 * i] += here;
      to[2 * i + 1] += 0.5 * (here + there);
    }
    if (f.nx % 2 == 1) to[f.nx - 1] += 0.5 * (below[g.nx - 1] + above[g.nx - 1]);
    f.wrap(fine.c, row);
  }
};

// mass: P^T mass. Conductances: the two fine ones in a row as linear interpolation sees them, (k + k') / 4,
// over the width.
struct Coarsen {
  BoxLevel fine, coarse;

  KOKKOS_FUNCTION void operator()(int row) const {
    const BoxGrid f = fine.grid, g = coarse.grid;
    const Axis x = along_x(f), y = along_y(f);
    for (int i = 0; i < g.nx; ++i) {
      double mass = 0, east = 0, north = 0;
      for (int d = -1; d <= 1; ++d) {
        const double wx = x.weight(2 * i + d), wy = y.weight(2 * row + d);
        if (wy > 0) east += wy * x.across(fine.east, f.start(2 * row + d) + 2 * i, 1, i);
        if (wx > 0) north += wx * y.across(fine.north, f.start(2 * row) + 2 * i + d, f.stride(), row);
        for (int e = -1; e <= 1 && wx > 0; ++e)
          if (const double w = wx * y.weight(2 * row + e); w > 0)
            mass += w * fine.mass(f.start(2 * row + e) + 2 * i + d);
      }
      const int n = g.start(row) + i;
      coarse.mass(n) = mass, coarse.east(n) = east, coarse.north(n) = north;
    }
    g.wrap(coarse.mass, row);
    g.wrap(coarse.east, row);
    g.wrap(coarse.north, row);
  }
};

struct InvertDiagonal {
  BoxLevel l;
  double least;

  KOKKOS_FUNCTION void operator()(int j) const {
    const int at = l.grid.start(j);
    const Neighbours sum(l, l.mass, at);
    for (int i = 0; i < l.grid.nx; ++i) {
      const double d = l.mass(at + i) + sum.conductance(i);
      l.inverse(at + i) = d > least ? 1 / d : 0.0;
    }
  }
};

double largest_conductance(const BoxLevel& l) {
  double most = 0;
  Kokkos::parallel_reduce(
      "box_multigrid::scale", Range(0, l.grid.size()),
      KOKKOS_LAMBDA(int n, double& value) { value = larger(value, l.east(n) + l.north(n)); },
      Kokkos::Max<double>(most));
  return most;
}

// Room for a level, its halo zero.
void lay_out(BoxLevel& level, const BoxGrid& grid) {
  const BoxGrid old = level.grid;
  if (level.mass.extent_int(0) > 0 && old.nx == grid.nx && old.ny == grid.ny && old.wrap_x == grid.wrap_x &&
      old.wrap_y == grid.wrap_y)
    return;
  level.grid = grid;
  for (Vector* v :
       {&level.mass, &level.east, &level.north, &level.inverse, &level.right, &level.c, &level.spare}) {
    if (v->extent_int(0) < grid.size())
      *v = Vector("box_multigrid", static_cast<size_t>(grid.size() + grid.size() / 4));
    fill(v->extent_int(0), 0.0, *v);
  }
}

template <class Pass>
void each_row(const char* label, const BoxGrid& grid, const Pass& pass) {
  launch(label, Range(0, grid.ny), pass);
}

void sweep(BoxLevel& l, double factor) {
  each_row("box_multigrid::smooth", l.grid, Sweep<false>{l, l.c, l.spare, factor});
  std::swap(l.c, l.spare);
}

}  // namespace

void BoxMultigrid::resize(const BoxGrid& finest) {
  BoxGrid grid = finest;
  for (depth_ = 0;; grid = {coarse_count(grid.nx), coarse_count(grid.ny), grid.wrap_x, grid.wrap_y}) {
    if (levels_.size() == depth_) levels_.emplace_back();
    lay_out(levels_[depth_++], grid);
    if (grid.nx == 1 && grid.ny == 1) return;
  }
}

void BoxMultigrid::coarsen() {
  const double least = nothing * largest_conductance(levels_.front());
  for (std::size_t l = 0; l < depth_; ++l) {
    const BoxLevel& here = levels_[l];
    if (l > 0) each_row("box_multigrid::coarsen", here.grid, Coarsen{levels_[l - 1], here});
    each_row("box_multigrid::diagonal", here.grid, InvertDiagonal{here, least});
  }
}

const Vector& BoxMultigrid::cycle() {
  for (std::size_t l = 0; l < depth_; ++l) {
    BoxLevel& here = levels_[l];
    each_row("box_multigrid::smooth_from_zero", here.grid, SmoothFromZero{here});
    sweep(here, second_damping);
    if (l + 1 == depth_) break;
    each_row("box_multigrid::residual", here.grid, Sweep<true>{here, here.c, here.spare, 0.0});
    each_row("box_multigrid::restrict", levels_[l + 1].grid, Restrict{here, levels_[l + 1]});
  }
  for (std::size_t l = depth_; l-- > 0;) {
    BoxLevel& here = levels_[l];
    if (l + 1 < depth_) each_row("box_multigrid::prolong", here.grid, Prolong{here, levels_[l + 1]});
    sweep(here, second_damping);
    sweep(here, first_damping);
  }
  return levels_.front().c;
}

}  // namespace freshet::linear
