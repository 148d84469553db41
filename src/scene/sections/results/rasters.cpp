// [raster]: maps on a grid of square cells.
#include <cmath>

#include "src/scene/sections/sections.hpp"

namespace freshet::input {

void read_rasters(Table& section, Scene& scene) {
  using Quantity = Rasters::Quantity;
  Rasters rasters;
  Value<double> spacing = section.number("spacing", "m");
  spacing.positive();
  // a kernel is 5 spacings wide: finer cells show no more
  rasters.spacing = spacing.otherwise(2 * scene.water.spacing);
  const Domain& domain = scene.domain;
  const double cells = (domain.high[0] - domain.low[0]) * (domain.high[1] - domain.low[1]) /
                       (rasters.spacing * rasters.spacing);
  constexpr double most = 1e8;  // a gigabyte and more of each map as text
  if (section.given() && domain.dimension == 2 && rasters.spacing > 0 && cells > most)
    spacing.fail("a raster of cells of " + shown(rasters.spacing) + " m has " +
                     shown(std::round(1e-6 * cells)) + " million; at most 100 million are written",
                 "a larger raster.spacing");
  rasters.every = read_duration(section, "every", scene).value_or(scene.output.every);
  rasters.what = section
                     .choices<Quantity>("what", {{"depth", Quantity::depth},
                                                 {"surface", Quantity::surface},
                                                 {"u", Quantity::u},
                                                 {"v", Quantity::v},
                                                 {"speed", Quantity::speed}})
                     .otherwise({});
  rasters.maxima = section.boolean("maxima").otherwise(rasters.maxima);
  rasters.arrival = section.number("arrival", "m").positive().otherwise(rasters.arrival);
  if (!section.given()) return;
  if (scene.domain.dimension == 1) {
    section.error("", "a raster needs a 2-D scene", "in 1-D use gauges and particles.h5part");
  } else if (rasters.what.empty() && !rasters.maxima) {
    section.error("", "[raster] asks for nothing", "add what = [\"depth\"] or maxima = true");
  } else {
    scene.rasters = rasters;
  }
}

}  // namespace freshet::input
