// What flows between free particles and those held at their state (the rim of a domain with open sides).
#pragma once
#include "kernels/sisph/surface/surface.hpp"

namespace freshet::sisph {

struct RimFlow {
  double in = 0, out = 0;  // m3 in one step
};

template <int D>
class Rim {
 public:
  explicit Rim(const Geometry<D>& g);

  // closed: the surface's fluxes are F_ij already (mass_flux.hpp), not f_ij.
  RimFlow flow(const FreeSurface<D>& surface, double dt, bool closed);

 private:
  Geometry<D> g_;
  SliceList list_;
};

}  // namespace freshet::sisph
