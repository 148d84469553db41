// Geometry of particles at rest (SISPH formulation E), found once:
//   omega_i = 1 / sum_j W_ij, scaled to the area covered;       G_ij = -W'(r_ij) >= 0
//   S_i = sum_j omega_j G_ij d_ij n_ij n_ij^T, s_i = tr S_i / D;  (grad f)_i = S_i^-1 sum_j omega_j G_ij (f_j
//   - f_i) n_ij A_ij = 2 omega_i omega_j G_ij (1/s_i + 1/s_j) / 2, then closed: sum_j A_ij n_ij = 0
//   (closure.hpp).
// n_ij points from i to j; A_ij = A_ji and n_ij = -n_ji to the bit. Held particles (a rim that keeps its
// state) have the values of a lattice. Source: docs/formulas/sisph.md (I2) to (I6).
#pragma once
#include "cellgrid/particles/pairs.hpp"
#include "cellgrid/particles/sums.hpp"
#include "kernels/sisph/pairs/pair_shape.hpp"
#include "kernels/sisph/walls/images.hpp"
#include "kernels/sisph/walls/mirror_walls.hpp"

namespace freshet::sisph {

// Slices to visit.
struct SliceList {
  Field<int> list;
  int count = 0;
  KOKKOS_FORCEINLINE_FUNCTION int operator()(int k) const { return list(k); }
};

// What the passes read.
template <int D>
struct Geometry {
  PairView pairs;
  VecField<double, D> n;        // per pair: unit vector from i to j
  Field<double> distance;       // per pair, m
  Field<double> weight;         // per pair: omega_j G_ij, 1/m
  Field<double> area;           // per pair: A_ij, m^(D-1)
  Images<D> images;             // behind walls; vector fields that pairs read have images.slots() values
  VecField<double, D> x;        // m, images included
  Field<double> omega;          // m^D
  Field<double> moment;         // s_i
  Field<double> free;           // 1; 0 = held
  SymField<double, D> inverse;  // S_i^-1
  SliceList slices;             // those with a free particle
};

template <int D>
struct GeometryRequest {
  const Rows& rows;           // with the reach of h measured
  VecField<double, D> x;      // m
  Field<double> h;            // m, smoothing length l
  Field<int> held;            // > 0: held
  double spacing;             // m, of the lattice
  double cell;                // m^D, that a particle covers on average
  MirrorWalls<D> walls = {};  // none, or those that images stand behind
  // gradients exact for linear fields (Krongauz and Belytschko); false: S_i = s_i 1 (Shepard)
  bool linear = true;
};

// Everything but the closure. Allocates; not for use inside a step.
template <int D>
Geometry<D> measure_geometry(int particles, const AnyKernel<D>& kernel, const GeometryRequest<D>& request);

// What coefficients follow from where particles stand.
template <int D>
struct Shapes {
  AnyKernel<D> kernel;
  Field<double> h;     // m
  double held_moment;  // s of held particles
  bool linear;         // as in the request
};
// Particles that moved: all but the pairs and omega, which are the caller's.
template <int D>
void measure_again(const Geometry<D>& g, const Shapes<D>& shapes);

// sum of dx^D G d / D over a lattice: s of a particle among regular neighbours.
template <int D>
double lattice_moment(const AnyKernel<D>& kernel, double h, double spacing);

// The lanes' free marks as a number to multiply with.
template <int D>
KOKKOS_FORCEINLINE_FUNCTION Lane free_lanes(const Geometry<D>& g, const Lanes& me) {
  return me.load(g.free);
}

// beside S of order 1: a particle without neighbours has no gradient
inline constexpr double least_moment = 1e-30;

KOKKOS_FORCEINLINE_FUNCTION Sym<Lane, 1> outer(const Vec<Lane, 1>& a, Lane factor) {
  return {factor * a.x * a.x};
}
KOKKOS_FORCEINLINE_FUNCTION Sym<Lane, 2> outer(const Vec<Lane, 2>& a, Lane factor) {
  return {factor * a.x * a.x, factor * a.x * a.y, factor * a.y * a.y};
}
KOKKOS_FORCEINLINE_FUNCTION Sym<Lane, 1> inverted(const Sym<Lane, 1>& m) {
  return {1.0 / (m.xx + least_moment)};
}
KOKKOS_FORCEINLINE_FUNCTION Sym<Lane, 2> inverted(const Sym<Lane, 2>& m) {
  const Lane per = 1.0 / (m.xx * m.yy - m.xy * m.xy + least_moment);
  return {per * m.yy, -per * m.xy, per * m.xx};
}

}  // namespace freshet::sisph
