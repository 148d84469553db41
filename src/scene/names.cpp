#include "src/scene/names.hpp"

namespace freshet {

const Names<KernelName>& kernel_names() {
  static const Names<KernelName> names{{"cubic", KernelName::cubic},
                                       {"quartic", KernelName::quartic},
                                       {"quintic", KernelName::quintic},
                                       {"gaussian", KernelName::gaussian},
                                       {"wendland", KernelName::wendland}};
  return names;
}

const Names<Walling>& walling_names() {
  static const Names<Walling> names{{"automatic", Walling::automatic}, {"none", Walling::none}, {"vbp", Walling::vbp},
                                    {"mvbp", Walling::mvbp},           {"rows", Walling::rows}, {"mirror", Walling::mirror}};
  return names;
}

const Names<Sisph::Momentum>& momentum_names() {
  using Momentum = Sisph::Momentum;
  static const Names<Momentum> names{
      {"automatic", Momentum::automatic}, {"semi-lagrangian", Momentum::semi_lagrangian},
      {"mass-flux", Momentum::mass_flux}, {"conservative", Momentum::conservative}};
  return names;
}

const Names<Sisph::Formulation>& formulation_names() {
  static const Names<Sisph::Formulation> names{{"at-rest", Sisph::Formulation::at_rest}, {"moving", Sisph::Formulation::moving}};
  return names;
}

const Names<Sisph::Paths>& path_names() {
  using Paths = Sisph::Paths;
  static const Names<Paths> names{
      {"theta", Paths::theta}, {"euler", Paths::euler}, {"rk2", Paths::rk2}, {"rk3", Paths::rk3}, {"leap-frog", Paths::leap_frog}};
  return names;
}

const Names<Sisph::Correction>& correction_names() {
  static const Names<Sisph::Correction> names{{"krongauz-belytschko", Sisph::Correction::krongauz_belytschko},
                                              {"shepard", Sisph::Correction::shepard}};
  return names;
}

const Names<Sisph::Coefficients>& coefficient_names() {
  static const Names<Sisph::Coefficients> names{{"stored", Sisph::Coefficients::stored}, {"recomputed", Sisph::Coefficients::recomputed}};
  return names;
}

std::string name_of(Stabilisation stabilisation) {
  switch (stabilisation) {
    case Stabilisation::none: return "not stabilised";
    case Stabilisation::artificial_viscosity: return "artificial viscosity";
    case Stabilisation::lax_friedrichs: return "Lax-Friedrichs";
    case Stabilisation::lax_friedrichs_muscl: return "Lax-Friedrichs with MUSCL";
    case Stabilisation::two_shock: return "two-shock";
    case Stabilisation::two_shock_muscl: return "two-shock with MUSCL";
  }
  return "";
}

}  // namespace freshet
