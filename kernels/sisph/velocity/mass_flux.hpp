// Momentum carried by the mass fluxes (docs/formulas/sisph.md (I16), (I17), (I21), (I22)), convex in the
// velocities where no slope is taken:
//   (m' + ...) v*_i = keep_i v_i + dt sum_in |F_ij| v_f - dt sum_out F_ij (v_f - v_i),  keep_i = max(0,
//   m_i^{n+1} - dt sum_in |F_ij|)
// v_f: the donor's velocity, carried to the face by its limited gradient (van Leer), and by less of it where
// more than half of its water leaves: what stays would else be thrown about.
#pragma once
#include "kernels/sisph/velocity/gradient.hpp"

namespace freshet::sisph {

struct FluxReport {
  bool limited = false;  // whether some particle would have given more than it had
  double clipped = 0;    // m^D x m, volume that was made up at the end: what the limiter left below zero
};

template <int D>
class MassFlux {
 public:
  explicit MassFlux(const Geometry<D>& g);

  // Turns f_ij of the surface into F_ij, in place, and finds the depth; outflow beyond what a particle has is
  // scaled back.
  FluxReport close_depths(const SliceList& active, const Layer<D>& water, const FreeSurface<D>& surface,
                          double dt);
  // v* from the fluxes and the depth that they lead to.
  void advect(const SliceList& active, const Layer<D>& water, const FreeSurface<D>& surface,
              const VelocityGradient<D>& gradient, double dt, const VecField<double, D>& advected);

 private:
  double least_depth(const SliceList& active, const Layer<D>& water, const FreeSurface<D>& surface,
                     double dt);
  void scale_outflow(const SliceList& active, const FreeSurface<D>& surface);

  Geometry<D> g_;
  Field<double> share_;        // of its outflow that a particle can give
  Field<double> slope_share_;  // of its velocity's slope that its outflow carries
};

}  // namespace freshet::sisph
