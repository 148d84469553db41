// A point's Voronoi cell as a convex polygon around the origin, made by clipping a square with half-planes. A
// corner between the bisectors of neighbours a and b is the circumcentre of the Delaunay triangle (point, a,
// b), its distance the circumradius. The square holds the circle of radius `half`: the cell reaches beyond
// that circle iff a corner does.
#pragma once
#include "cellgrid/simd/lanes.hpp"
#include "cellgrid/simd/vec.hpp"

namespace freshet::fpm {

struct Cell {
  static constexpr int most = 32;  // corners
  static constexpr int open = -1;  // edge of the square; edges of walls are numbered downwards from -2

  double x[most], y[most];  // m, corners, counter-clockwise
  int edge[most];  // what cut the edge from corner k to the next one: a neighbour's number, a wall or open
  int size = 4;
  bool overflow = false;  // a cut was left out because it would have made too many corners

  explicit KOKKOS_INLINE_FUNCTION Cell(double half) {
    const double sx[4] = {-half, half, half, -half}, sy[4] = {-half, -half, half, half};
    for (int k = 0; k < 4; ++k) x[k] = sx[k], y[k] = sy[k], edge[k] = open;
  }

  static KOKKOS_FORCEINLINE_FUNCTION int wall(int segment) { return -2 - segment; }
  static KOKKOS_FORCEINLINE_FUNCTION int segment_of(int edge) { return -2 - edge; }

  KOKKOS_FORCEINLINE_FUNCTION int before(int k) const { return k == 0 ? size - 1 : k - 1; }
  KOKKOS_FORCEINLINE_FUNCTION int after(int k) const { return k + 1 == size ? 0 : k + 1; }
  KOKKOS_FORCEINLINE_FUNCTION double distance2(int k) const { return x[k] * x[k] + y[k] * y[k]; }

  // m2, of the farthest corner
  KOKKOS_INLINE_FUNCTION double reach2() const {
    double farthest = 0;
    for (int k = 0; k < size; ++k) farthest = larger(farthest, distance2(k));
    return farthest;
  }

  KOKKOS_INLINE_FUNCTION double area() const {
    double twice = 0;
    for (int k = 0; k < size; ++k) twice += x[k] * y[after(k)] - x[after(k)] * y[k];
    return 0.5 * twice;
  }

  // Keeps what lies at u . d <= c (c >= 0). Corners within a billionth of the line stay: on lattices four
  // points share a circle.
  KOKKOS_INLINE_FUNCTION void clip(const Vec<double, 2>& d, double c, int label) {
    double beyond[most];
    const double slack = 1e-9 * (c + (d.x * d.x + d.y * d.y));
    int cut = 0;
    for (int k = 0; k < size; ++k) {
      beyond[k] = x[k] * d.x + y[k] * d.y - c;
      cut += beyond[k] > slack;
    }
    if (cut == 0 || cut == size) return;
    if (size - cut + 2 > most) {
      overflow = true;
      return;
    }
    keep_inside(beyond, slack, label);
  }

 private:
  KOKKOS_INLINE_FUNCTION void keep_inside(const double* beyond, double slack, int label) {
    const Cell old = *this;
    int m = 0;
    for (int k = 0; k < old.size; ++k) {
      const int next = old.after(k);
      const bool in = beyond[k] <= slack, next_in = beyond[next] <= slack;
      if (in) x[m] = old.x[k], y[m] = old.y[k], edge[m++] = old.edge[k];
      if (in == next_in) continue;
      const double s = clamp(beyond[k] / (beyond[k] - beyond[next]), 0.0, 1.0);
      x[m] = old.x[k] + s * (old.x[next] - old.x[k]);
      y[m] = old.y[k] + s * (old.y[next] - old.y[k]);
      edge[m++] = in ? label : old.edge[k];
    }
    size = m;
  }
};

}  // namespace freshet::fpm
