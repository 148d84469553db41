// [sph]: kernel, stabilisation, walls and the density iteration of explicit SPH.
#include <cmath>

#include "src/scene/names.hpp"
#include "src/scene/sections.hpp"

namespace freshet::input {
namespace {

enum class Flux { none, viscosity, lax_friedrichs, two_shock };

Stabilisation reconstructed(Flux flux, bool muscl) {
  switch (flux) {
    case Flux::none: return Stabilisation::none;
    case Flux::viscosity: return Stabilisation::artificial_viscosity;
    case Flux::lax_friedrichs: return muscl ? Stabilisation::lax_friedrichs_muscl : Stabilisation::lax_friedrichs;
    case Flux::two_shock: return muscl ? Stabilisation::two_shock_muscl : Stabilisation::two_shock;
  }
  return Stabilisation::none;
}

void read_stabilisation(Table& section, Sph& sph) {
  const Names<Flux> fluxes{{"none", Flux::none},
                           {"artificial-viscosity", Flux::viscosity},
                           {"lax-friedrichs", Flux::lax_friedrichs},
                           {"two-shock", Flux::two_shock}};
  const Flux flux = section.choice<Flux>("stabilise", fluxes).otherwise(Flux::lax_friedrichs);
  const std::string name = "'sph.stabilise' is '" + name_in(fluxes, flux) + "'";
  Value<bool> muscl = section.boolean("muscl");
  if ((flux == Flux::none || flux == Flux::viscosity) && muscl.otherwise(false))
    muscl.fail("'sph.muscl' reconstructs for a flux, and " + name, "remove it, or use \"lax-friedrichs\" or \"two-shock\"");
  sph.stabilisation = reconstructed(flux, muscl.otherwise(true));
  Value<double> strength = section.number("strength").at_least(0);
  if (strength.given() && flux != Flux::lax_friedrichs)
    strength.fail("'sph.strength' is a factor on the Lax-Friedrichs term, and " + name, "remove it");
  sph.strength = strength.otherwise(sph.strength);
  Value<std::vector<double>> viscosity = section.numbers("viscosity", "two numbers: [a, b]");
  if (viscosity.optional() && (viscosity.optional()->size() != 2 || (*viscosity.optional())[0] < 0 || (*viscosity.optional())[1] < 0))
    viscosity.fail("'sph.viscosity' must be [a, b] with neither below 0");
  if (viscosity.given() && flux != Flux::viscosity)
    viscosity.fail("'sph.viscosity' belongs to the artificial viscosity, and " + name, "remove it");
  if (viscosity.optional()) sph.viscosity = {(*viscosity.optional())[0], (*viscosity.optional())[1]};
}

void read_walls(Table& section, Sph& sph) {
  sph.walls = section.choice<Walling>("walls", walling_names()).otherwise(sph.walls);
  Value<bool> slip = section.boolean("slip");
  if (!slip.otherwise(true) && (sph.walls == Walling::mirror || sph.walls == Walling::none))
    slip.fail("walls of kind '" + name_in(walling_names(), sph.walls) + "' cannot hold the tangential velocity back",
              "use walls = \"rows\"");
  sph.slip = slip.otherwise(sph.slip);
}

void read_precision(Table& section, Sph& sph) {
  Value<bool> mixed = section.choice<bool>("precision", {{"double", false}, {"mixed", true}});
  sph.mixed = mixed.otherwise(false);
  constexpr double least = 1e-6;  // a few times the round-off of sums in single precision
  if (sph.mixed && sph.newton_tolerance < least)
    mixed.fail("sums of pairs in single precision cannot meet 'sph.newton_tolerance' below 1e-6", "raise it, or use \"double\"");
  if (sph.mixed && sph.well_balanced)
    mixed.fail("'sph.well_balanced' balances forces to round-off, pairs in single precision to 1e-7 of them", "use \"double\"");
}

}  // namespace

bool read_sph(Table& section, Scene& scene) {
  Sph& sph = scene.sph;
  const int dimension = scene.domain.dimension;
  sph.eta = section.number("eta").within(0.5, 4.0).otherwise(dimension == 2 ? 1.2 : 1.0);
  sph.kernel = section.choice<KernelName>("kernel", kernel_names()).otherwise(sph.kernel);
  sph.lattice_correction = section.boolean("lattice_correction").otherwise(sph.lattice_correction);
  read_stabilisation(section, sph);
  sph.newton_tolerance =
      section.number("newton_tolerance").within(1e-14, 0.1).otherwise(sph.newton_tolerance);
  // What a density 1.6 times the initial one gives.
  sph.h_floor = section.number("h_floor").within(0, 1).otherwise(std::pow(1.6, -1.0 / dimension));
  // In 1-D a longer h costs nothing, and water stretches along its only direction: at 3 h0 it could not get thinner than a third.
  sph.h_cap = section.number("h_cap").at_least(1).otherwise(dimension == 2 ? 3.0 : 30.0);
  read_walls(section, sph);
  const auto acceleration =
      section
          .choice<Acceleration>("acceleration", {{"classical", Acceleration::classical},
                                                 {"variational", Acceleration::variational}})
          .optional();
  sph.well_balanced = section.boolean("well_balanced").otherwise(sph.well_balanced);
  if (sph.well_balanced && acceleration == Acceleration::variational)
    section.error("well_balanced", "the well-balanced bed force belongs to the classical acceleration",
                  "remove 'sph.acceleration'");
  read_precision(section, sph);
  sph.acceleration = sph.well_balanced ? Acceleration::classical : acceleration.value_or(sph.acceleration);
  return acceleration.has_value() || sph.well_balanced;
}

}  // namespace freshet::input
