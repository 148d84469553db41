// [water]: particle spacing and the state at t = 0.
#include <algorithm>

#include "src/reference/exact.hpp"
#include "src/scene/sections/sections.hpp"

namespace freshet::input {
namespace {

// { exact = true }: depth and velocity of the exact solution at t = 0.
void read_exact_state(Table& section, const std::string& key, Scene& scene) {
  Table state = section.table(key);
  const bool exact = state.boolean("exact").required(true);
  if (!exact) state.error("exact", "'" + state.path_of("exact") + "' must be true");
  if (section.has("velocity")) section.error("velocity", "the exact solution already gives the velocity");
  if (!scene.compare.exact) {
    if (!section.context().exact_failed) {
      state.error("exact", "no exact solution is named", "add 'exact = { type = ... }' under [compare]");
    }
    return;
  }
  const std::shared_ptr<const Exact> solution = scene.compare.exact;
  scene.water.depth = [solution](double x, double y) { return solution->at(x, y, 0).depth; };
  scene.water.velocity[0] = [solution](double x, double y) { return solution->at(x, y, 0).u; };
  if (scene.domain.dimension == 2) {
    scene.water.velocity[1] = [solution](double x, double y) { return solution->at(x, y, 0).v; };
  }
}

}  // namespace

void read_spacing(Table& section, Scene& scene) {
  Water& water = scene.water;
  Value<double> spacing = section.number("spacing", "m");
  const double smallest =
      std::min(scene.domain.high[0] - scene.domain.low[0],
               scene.domain.dimension == 2 ? scene.domain.high[1] - scene.domain.low[1] : 1e300);
  spacing.positive().check([=](double dx) { return dx <= smallest; },
                           "at most the domain's width (" + shown(smallest) + ")");
  water.spacing = spacing.required();
  water.start = section
                    .choice<Water::Start>("start", {{"cells", Water::Start::cells},
                                                    {"equal-mass", Water::Start::equal_mass},
                                                    {"relaxed", Water::Start::relaxed}})
                    .otherwise(water.start);
  water.wet_above = section.number("wet_above", "m").at_least(0).otherwise(water.wet_above);
  Value<double> disorder = section.number("disorder");
  water.disorder = disorder.within(0, 10).otherwise(0);
  water.seed = section.integer("seed").at_least(0).otherwise(water.seed);
  if (water.disorder > 0 && water.start == Water::Start::equal_mass)
    disorder.fail("'water.disorder' moves cells, and 'water.start' is 'equal-mass'", "use start = \"cells\"");
}

void read_water_state(Table& section, Scene& scene) {
  const std::string source = section.one_of({"surface", "depth"}, true);
  const int dimension = scene.domain.dimension;
  const auto velocity = section.velocity("velocity", dimension).optional();
  if (velocity) scene.water.velocity = *velocity;
  if (source.empty()) return;
  if (section.has_table(source)) {
    read_exact_state(section, source, scene);
    return;
  }
  const Function given = section.function(source).otherwise({});
  if (!given) return;
  if (source == "depth" && !section.has_text(source) && given(0, 0) < 0)
    section.error(source, "'water.depth' is " + shown(given(0, 0)) + "; it must be at least 0",
                  "0 is dry; levels are 'surface', depths are above the bed");
  const Function bed = scene.bed.elevation;
  if (source == "surface") scene.water.surface = given;
  scene.water.depth = given;
  if (source == "surface" && bed) {
    scene.water.depth = [given, bed](double x, double y) { return given(x, y) - bed(x, y); };
  }
}

}  // namespace freshet::input
