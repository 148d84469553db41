// How the particles at rest carry momentum (semi_lagrangian.hpp, mass_flux.hpp, conservative.hpp).
#pragma once
#include <vector>

namespace freshet::sisph {

// name: a scene's word for it. By mass fluxes, or along paths traced back, which need water everywhere.
struct MomentumForm {
  const char* name = "automatic";
  bool fluxes_where_wet = false,
       fluxes_where_dry = true;  // at a start with water everywhere, and with dry places
  bool conservative = false;     // with pairwise antisymmetric pressure
  bool by_fluxes(bool drying) const { return drying ? fluxes_where_dry : fluxes_where_wet; }
};

inline std::vector<MomentumForm> momentum_forms() {
  return {
      {}, {"semi-lagrangian", false, false}, {"mass-flux", true, true}, {"conservative", true, true, true}};
}

}  // namespace freshet::sisph
