// The particle fields of explicit SPH for the shallow water equations (Vacondio 2010, ch. 2).
// Units: rho_w = 1, so that the density per area rho is the depth d [m] and the mass m is a volume [m3] (1-D: [m2], unit width).
#pragma once
#include "cellgrid/twin.hpp"
#include "kernels/smoothing/smoothing.hpp"

namespace freshet::swe {

// What pairs see of a neighbour beside its position, in single precision (single.hpp); empty = pairs are summed in double.
struct SingleCopies {
  Kokkos::View<SingleRecord<4>*, Memory> motion;  // of the density
  Kokkos::View<SingleRecord<16>*, Memory> state;  // of the force

  KOKKOS_INLINE_FUNCTION bool on() const { return motion.extent(0) > 0; }
};

template <int D>
struct Particles {
  VecField<double, D> x;        // m
  VecField<double, D> v;        // m/s: at t, or at t + dt/2 inside a step
  VecField<double, D> v_pred;   // m/s: predicted at t + dt, what pairs see
  VecField<double, D> a;        // m/s2
  Field<double> m;              // m3
  Field<double> h0;             // m, reference smoothing length: bounds of h
  Field<double> kh;             // rho0 h0^D: the constant of rho h^D = kh (2.5)
  Field<double> rho;            // m, density = depth
  Field<double> rate;           // m/s, d rho/dt (2.34)
  Field<double> growth;         // m/s, d rho/dt expected in the middle of the next step
  Field<double> h, inv_h;       // m, 1/m
  Field<double> pressure;       // m/s2: g / (2 alpha), p / (rho^2 alpha) of (2.22)
  Field<double> celerity;       // m/s: sqrt(g d)
  Field<double> weight;         // m norm / h^(D+1): what multiplies dw/dq as seen from a neighbour
  SymField<double, D> strain;   // 1/s, symmetric part of grad v: reconstruction of the normal velocity
  VecField<double, D> depth_slope;  // 1, grad rho: reconstruction of the depth
  VecField<double, D> t;        // m/s2, pressure and stabilisation: (1/m) d pi_int/dx
  Field<double> signal;         // m/s, max_j |v_ij . x_ij| / r
  Field<int> id;
  SingleCopies single;
};

// Smoothing length of a depth: rho h^D = kh.
template <int D, class V>
KOKKOS_FORCEINLINE_FUNCTION V smoothing_length(V kh, V rho) {
  if constexpr (D == 1)
    return kh / rho;
  else
    return root(kh / rho);
}

// Bounds of h: light shoreline particles keep h >= floor h0, isolated ones h <= cap h0.
struct LengthBounds {
  double floor, cap;  // x h0
};

// 1 in the lanes of particles whose state is imposed (kind != 0), else 0. Without a kind field nothing is imposed.
struct ImposedLanes {
  Field<int> kind;

  KOKKOS_INLINE_FUNCTION Lane operator()(const Lanes& me) const {
    if (kind.extent(0) == 0) return 0.0;
    const Lane k = to_real(me.load(kind));
    return select(Lane(0.5) < k * k, Lane(1.0), Lane(0.0));
  }
};

// What states are interpolated with; density and force take the scene's own kernel.
template <int D>
using Kernel = CubicSpline<D>;

}  // namespace freshet::swe
