// One multigrid V-cycle of a 5-point system on the nodes of a box, open or periodic along each axis:
//   (A c)_n = mass_n c_n + sum over the four faces k_f (c_n - c_m),   mass, k >= 0
// Nodes with neither are not solved for: their right-hand side has to be 0, and what is found there is
// interpolated from coarser levels. Two damped Jacobi sweeps before and after, bilinear interpolation to
// every second node, its transpose as restriction, and on the coarse level the 5-point part of P^T A P.
// Halved until one node is left: no direct solver. Rows of nodes are contiguous with a halo of one node, so
// that sweeps run over them without conditions; each row is one index of a launch, the result does not depend
// on the number of threads. For preconditioners (kernels/linear/mesh/mesh_correction.hpp).
#pragma once
#include <vector>

#include "kernels/linear/vectors.hpp"

namespace freshet::linear {

// The nodes of one level: (i, j) is at start(j) + i; columns -1 and nx, rows -1 and ny are the halo: zero, or
// of the other side.
struct BoxGrid {
  int nx = 1, ny = 1;
  bool wrap_x = false, wrap_y = false;

  KOKKOS_FORCEINLINE_FUNCTION int stride() const { return nx + 2; }
  KOKKOS_FORCEINLINE_FUNCTION int size() const { return (ny + 2) * stride(); }
  KOKKOS_FORCEINLINE_FUNCTION int start(int j) const { return (j + 1) * stride() + 1; }

  // Completes a row that is written: its halo, and where it is the halo of the other side.
  KOKKOS_INLINE_FUNCTION void wrap(const Vector& v, int j) const {
    const int at = start(j);
    if (wrap_x) {
      v(at - 1) = v(at + nx - 1);
      v(at + nx) = v(at);
    }
    if (wrap_y && j == 0) copy(v, at, start(ny));
    if (wrap_y && j == ny - 1) copy(v, at, start(-1));
  }

 private:
  KOKKOS_INLINE_FUNCTION void copy(const Vector& v, int from, int to) const {
    for (int i = -1; i <= nx; ++i) v(to + i) = v(from + i);
  }
};

struct BoxLevel {
  BoxGrid grid;
  Vector mass, east, north;  // of the node; of the faces to its next neighbours, 0 where there is none
  Vector inverse;            // of the diagonal, 0 where it is next to nothing
  Vector right, c, spare;
};

class BoxMultigrid {
 public:
  // Makes the levels below a grid; keeps its memory while grids do not grow.
  void resize(const BoxGrid& grid);
  // The finest system and its right-hand side, to be filled row by row (each row then wrapped), then
  // coarsen(); the right-hand side before each cycle().
  const BoxLevel& finest() const { return levels_.front(); }
  // Coefficients of the coarser levels and all inverse diagonals.
  void coarsen();
  // One V-cycle from zero; its result, halo included, lives until the next one.
  const Vector& cycle();

 private:
  std::vector<BoxLevel> levels_;  // of which the first depth_ are in use
  std::size_t depth_ = 0;
};

}  // namespace freshet::linear
