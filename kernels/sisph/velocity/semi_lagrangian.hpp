// Velocity carried along particle paths between particles at rest (fully wet, smooth flow;
// docs/formulas/sisph.md (I18), (I20)):
//   x_d = x_i - dt/2 (v_i^{n+1} + P[v^n](x_d)),  Fu_i = P[u](x_d),  u = v^n - (1 - theta) g dt grad eta^n
// P: quadratic polynomial that passes through the particle nearest to the place and fits its neighbours by
// weighted least squares; fitted once per step. Exact for quadratic fields. P[u] is lifted by a share of what
// its neighbours stand off it in the mean, times the way to the foot point in spacings (1 at most): on
// disordered particles the slopes of such fits have eigenvalues on the growing side, and steps that are short
// against the spacing damp nothing. The share is 20 x how far the neighbours' weighted middle lies aside in
// spacings, 1 at most: nothing on a lattice. What is taken away is of the order of the fit's own error.
#pragma once
#include "kernels/sisph/surface/surface.hpp"

namespace freshet::sisph {

template <int D>
class SemiLagrangian {
 public:
  static constexpr int terms = D == 1 ? 2 : 5;  // xi, xi^2; xi, zeta, xi^2, xi zeta, zeta^2

  // length: m, that the polynomials' coordinates are measured in; support: m, of the pairs.
  SemiLagrangian(const Geometry<D>& g, const Rows& rows, double spacing, double support);

  // The polynomials of v and u; slip: how walls mirror them.
  void fit(const VecField<double, D>& v, const VecField<double, D>& u, bool slip = true);
  // carried = Fu for the end velocity `last` of the pass before.
  void trace(const VecField<double, D>& v, const VecField<double, D>& u, const VecField<double, D>& last,
             double dt, const VecField<double, D>& carried) const;

 private:
  Geometry<D> g_;
  Rows rows_;
  double spacing_, support_;
  int stride_;
  Field<double> inverse_;  // per particle, terms (terms + 1) / 2 values, each of stride_ particles
  // per particle: weighted means of the terms and of 1 over its neighbours, x the lift's share
  Field<double> mean_;
  Field<double> own2_;    // m2: nearer than this to a particle no other is nearer
  Field<double> fitted_;  // per particle: terms of v.x, (v.y), u.x, (u.y), and after each the neighbours'
                          // mean height over them, likewise
};

}  // namespace freshet::sisph
