// [split] and [merge]: how much area particles may and must cover.
#include "src/scene/sections/sections.hpp"
#include "src/scene/shapes/region.hpp"

namespace freshet::input {
namespace {

// h/c: quick enough to gain resolution, slow enough not to make noise (docs/design.md)
constexpr double relaxation = 10;

AreaLimit read_area(Table& section, const Scene& scene) {
  AreaLimit limit;
  limit.elsewhere = section.number("area", "spacing^D").positive().optional();
  const std::size_t count = section.size_of("region");
  for (std::size_t i = 0; i < count; ++i) {
    Table region = section.element("region", i);
    AreaLimit::Region read;
    read.corners = read_region(region, scene.domain.dimension);
    read.area = region.number("area", "spacing^D").positive().required(1);
    limit.regions.push_back(std::move(read));
  }
  if (!limit.elsewhere && limit.regions.empty())
    section.error("area", "[" + section.path_of("") + "] names neither an area nor a region",
                  "write area = 2.0, in units of spacing^D, or add [[" + section.path_of("region") + "]]");
  return limit;
}

void refuse_balance(Table& section, const Scene& scene) {
  if (scene.sph.well_balanced)
    section.error(
        "area", "'sph.well_balanced' holds every particle to its depth at t = 0, which new ones do not have",
        "leave out either of the two");
}

}  // namespace

void read_split(Table& section, Scene& scene) {
  if (!section.given()) return;
  refuse_balance(section, scene);
  Split split;
  const bool line = scene.domain.dimension == 1;
  split.area = read_area(section, scene);
  Value<int> into = section.integer("into");
  if (line) into.within(2, 3);
  else into.check([](int n) { return n == 7; }, "7 in 2-D: a hexagon and its middle");
  split.into = into.otherwise(line ? 3 : 7);
  split.alpha = section.number("alpha").within(0.2, 1.0).otherwise(line ? 0.9 : 0.92);
  split.eps = section.number("eps").within(0.05, 1.0).otherwise(line && split.into == 2 ? 0.25
                                                                : line                  ? 1.0 / 3
                                                                                        : 0.36);
  split.relax = section.number("relax", "h/c").at_least(0).otherwise(relaxation);
  split.linear = section.choice<bool>("velocity", {{"same", false}, {"linear", true}}).otherwise(false);
  split.least_depth = section.number("least_depth", "m").at_least(0).otherwise(split.least_depth);
  split.most_particles = section.integer("most_particles").positive().otherwise(split.most_particles);
  scene.split = split;
}

void read_merge(Table& section, Scene& scene) {
  if (!section.given()) return;
  refuse_balance(section, scene);
  Merge merge;
  merge.area = read_area(section, scene);
  merge.reach = section.number("reach", "h").within(0.1, 1.5).otherwise(merge.reach);
  merge.relax = section.number("relax", "h/c").at_least(0).otherwise(relaxation);
  scene.merge = merge;
}

}  // namespace freshet::input
