// [sph]: kernel, stabilisation, walls and the density iteration of explicit SPH.
#include <cmath>

#include "src/scene/sections/sections.hpp"
#include "src/scene/toml/choices.hpp"

namespace freshet::input {
namespace {

using swe::AnyStabilisation;

bool reconstructs(const AnyStabilisation& choice) {
  return std::visit([](const auto& c) { return c.muscl; }, choice);
}

// The first of the alternatives of that name whose reconstruction is the one asked for.
void read_stabilisation(Table& section, Sph& sph) {
  AnyStabilisation& chosen = sph.stabilisation;
  const auto named_one = section.choice("stabilise", named<AnyStabilisation>());
  chosen = named_one.otherwise(chosen);
  const std::optional<bool> muscl = section.boolean("muscl").optional();
  if (named_one.given() && !named_one.optional()) return accept_keys<AnyStabilisation>(section);
  const std::vector<AnyStabilisation> all = alternatives<AnyStabilisation>();
  const auto fits = [&](const AnyStabilisation& c) {
    return name_of(c) == name_of(chosen) && reconstructs(c) == muscl.value_or(reconstructs(c));
  };
  const auto found = std::find_if(all.begin(), all.end(), fits);
  if (found != all.end()) chosen = *found;
  else reject(section, "stabilise", chosen, "muscl", reconstructs);
  read_keys(section, "stabilise", chosen, KeyReader(section));
}

void read_walls(Table& section, Sph& sph) {
  sph.walls = section.choice("walls", named(wall_kinds())).otherwise(sph.walls);
  Value<bool> slip = section.boolean("slip");
  if (!slip.otherwise(true) && !sph.walls.can_hold())
    slip.fail("walls of kind '" + name_of(sph.walls) + "' cannot hold the tangential velocity back",
              "use walls = \"rows\"");
  sph.slip = slip.otherwise(sph.slip);
}

void read_precision(Table& section, Sph& sph) {
  Value<bool> mixed = section.choice<bool>("precision", {{"double", false}, {"mixed", true}});
  sph.mixed = mixed.otherwise(false);
  constexpr double least = 1e-6;  // a few times the round-off of sums in single precision
  if (sph.mixed && sph.newton_tolerance < least)
    mixed.fail("sums of pairs in single precision cannot meet 'sph.newton_tolerance' below 1e-6",
               "raise it, or use \"double\"");
  if (sph.mixed && sph.well_balanced)
    mixed.fail("'sph.well_balanced' balances forces to round-off, pairs in single precision to 1e-7 of them",
               "use \"double\"");
}

}  // namespace

bool read_sph(Table& section, Scene& scene) {
  Sph& sph = scene.sph;
  const int dimension = scene.domain.dimension;
  sph.eta = section.number("eta").within(0.5, 4.0).otherwise(dimension == 2 ? 1.2 : 1.0);
  sph.kernel = section.choice("kernel", named<KernelChoice>()).otherwise(sph.kernel);
  sph.lattice_correction = section.boolean("lattice_correction").otherwise(sph.lattice_correction);
  read_stabilisation(section, sph);
  sph.newton_tolerance =
      section.number("newton_tolerance").within(1e-14, 0.1).otherwise(sph.newton_tolerance);
  // What a density 1.6 times the initial one gives.
  sph.h_floor = section.number("h_floor").within(0, 1).otherwise(std::pow(1.6, -1.0 / dimension));
  // In 1-D a longer h costs nothing, and water stretches along its only direction: at 3 h0 it could not get
  // thinner than a third.
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
