// One symmetric multigrid V-cycle of a 5-point system on nx x ny nodes (1-D: ny = 1), a preconditioner:
//   (A c)_n = mass_n c_n + sum over the four faces k_f (c_n - c_m),   mass, k >= 0; nodes with neither are left at zero.
// Red-black Gauss-Seidel once before and once after (red, black; black, red: symmetric, no races, the same with any number of
// threads), bilinear interpolation to every second node, its transpose as restriction, and on the coarse level the 5-point part
// of P^T A P. Halved until one node is left, so no direct solver is needed. Cost: about 7 visits to each fine node.
#pragma once
#include <vector>

#include "kernels/linear/vectors.hpp"

namespace freshet::linear {

struct FivePoint {
  int nx = 0, ny = 0;
  Vector mass;   // nx * ny, x fastest
  Vector east;   // conductance to node n + 1; last column: not read
  Vector north;  // conductance to node n + nx; last row: not read

  int size() const { return nx * ny; }
  KOKKOS_FORCEINLINE_FUNCTION double to_east(int i, int j) const { return i >= 0 && i + 1 < nx ? east(j * nx + i) : 0.0; }
  KOKKOS_FORCEINLINE_FUNCTION double to_north(int i, int j) const { return j >= 0 && j + 1 < ny ? north(j * nx + i) : 0.0; }

  // sum_f k_f c_m, and the diagonal mass + sum_f k_f
  KOKKOS_FORCEINLINE_FUNCTION double neighbours(const Vector& c, int i, int j) const {
    const int n = j * nx + i;
    double sum = 0;
    if (i > 0) sum += east(n - 1) * c(n - 1);
    if (i + 1 < nx) sum += east(n) * c(n + 1);
    if (j > 0) sum += north(n - nx) * c(n - nx);
    if (j + 1 < ny) sum += north(n) * c(n + nx);
    return sum;
  }
  KOKKOS_FORCEINLINE_FUNCTION double diagonal(int i, int j) const {
    return mass(j * nx + i) + to_east(i - 1, j) + to_east(i, j) + to_north(i, j - 1) + to_north(i, j);
  }
};

class Multigrid5 {
 public:
  // Makes the levels below a grid of that size.
  void resize(int nx, int ny);
  // The finest system and its right-hand side: to be filled, then coarsen(); the right-hand side before each cycle().
  const FivePoint& finest() const { return levels_.front().a; }
  const Vector& right() const { return levels_.front().right; }
  // Coefficients of the coarser levels and all inverse diagonals.
  void coarsen();
  // One V-cycle from zero; its result lives until the next one.
  const Vector& cycle();

 private:
  struct Level {
    FivePoint a;
    Vector inverse;  // of the diagonal; 0 where it is 0
    Vector right, c;
  };
  std::vector<Level> levels_;
};

}  // namespace freshet::linear
