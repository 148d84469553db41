// The particle fields of explicit SPH for the shallow water equations (Vacondio 2010, ch. 2).
// Units: rho_w = 1, so that the density per area rho is the depth d [m] and the mass m is a volume [m3] (1-D:
// [m2], unit width).
#pragma once
#include "cellgrid/particles/fields.hpp"
#include "cellgrid/particles/twin.hpp"
#include "kernels/smoothing/smoothing.hpp"

namespace freshet::swe {

// What pairs see of a neighbour beside its position, in single precision (single.hpp); empty = pairs are
// summed in double.
struct SingleCopies {
  Kokkos::View<SingleRecord<4>*, Memory> motion;  // of the density
  Kokkos::View<SingleRecord<16>*, Memory> state;  // of the force

  KOKKOS_INLINE_FUNCTION bool on() const { return motion.extent(0) > 0; }
};

template <int D>
struct Particles {
  VecField<double, D> x;
  VecField<double, D> v;       // at t, or at t + dt/2 inside a step
  VecField<double, D> v_pred;  // predicted at t + dt, what pairs see
  VecField<double, D> a;
  Field<double> m;
  Field<double> h0;      // reference smoothing length: bounds of h
  Field<double> kh;      // rho0 h0^D: the constant of rho h^D = kh (2.5)
  Field<double> rho;     // density = depth
  Field<double> rate;    // d rho/dt (2.34)
  Field<double> growth;  // d rho/dt expected in the middle of the next step
  Field<double> h, inv_h;
  Field<double> pressure;           // g / (2 alpha), p / (rho^2 alpha) of (2.22)
  Field<double> celerity;           // sqrt(g d)
  Field<double> weight;             // m norm / h^(D+1): what multiplies dw/dq as seen from a neighbour
  SymField<double, D> strain;       // symmetric part of grad v: reconstruction of the normal velocity
  VecField<double, D> depth_slope;  // grad rho: reconstruction of the depth
  VecField<double, D> t;            // pressure and stabilisation: (1/m) d pi_int/dx
  Field<double> signal;             // max_j |v_ij . x_ij| / r
  Field<int> id;
  SingleCopies single;

  void declare(const FieldList& field) {
    const char* volume = D == 1 ? "m2" : "m3";
    field(x, "x", "y", "m", Carry::state);
    field(v, "u", "v", "m/s", Carry::state);
    field(v_pred, "u_pred", "v_pred", "m/s", Carry::sort);
    field(a, "ax", "ay", "m/s2", Carry::result);
    field(t, "tx", "ty", "m/s2", Carry::no);
    field(m, "mass", volume, Carry::state);
    field(kh, "kh", volume, Carry::state);
    field(h0, "h0", "m", Carry::state);
    field(rho, "depth", "m", Carry::state);
    field(h, "h", "m", Carry::state);
    field(rate, "depth_rate", "m/s", Carry::state);
    field(growth, "depth_growth", "m/s", Carry::result);
    field(inv_h, "inv_h", "1/m", Carry::no);
    field(pressure, "pressure", "m/s2", Carry::no);
    field(celerity, "celerity", "m/s", Carry::no);
    field(signal, "signal", "m/s", Carry::no);
    field(weight, "weight", "1", Carry::no);
    field(id, "id", "1", Carry::state);
  }
  // Only where the stabilisation reconstructs from it. kept: new particles start from it (splitting).
  void declare_strain(const FieldList& field, bool kept) {
    const Carry carry = kept ? Carry::result : Carry::no;
    field(strain.xx, "strain_xx", "1/s", carry);
    if constexpr (D == 2) field(strain.xy, "strain_xy", "1/s", carry);
    if constexpr (D == 2) field(strain.yy, "strain_yy", "1/s", carry);
  }
  void declare_depth_slope(const FieldList& field) {
    field(depth_slope, "depth_slope_x", "depth_slope_y", "1", Carry::no);
  }
};

// Smoothing length of a depth: rho h^D = kh.
template <int D, class V>
KOKKOS_FORCEINLINE_FUNCTION V smoothing_length(V kh, V rho) {
  if constexpr (D == 1) return kh / rho;
  else return root(kh / rho);
}

// Bounds of h: light shoreline particles keep h >= floor h0, isolated ones h <= cap h0.
struct LengthBounds {
  double floor, cap;  // x h0
};

// 1 in the lanes of particles whose state is imposed (kind != 0), else 0. Without a kind field nothing is
// imposed.
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
