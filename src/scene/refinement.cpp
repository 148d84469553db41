// [split] and [merge]: how much area particles may and must cover.
#include "src/scene/sections.hpp"

namespace freshet::input {
namespace {

std::vector<Point> box_corners(Table& region, int dimension) {
  Value<std::vector<double>> box =
      region.numbers("box", dimension == 1 ? "numbers in m: x0, x1" : "numbers in m: x0, y0, x1, y1");
  const std::vector<double> b = box.otherwise({});
  const std::size_t needed = dimension == 1 ? 2 : 4;
  const bool ordered = b.size() == needed && b[0] < b[needed / 2] && (dimension == 1 || b[1] < b[3]);
  if (!b.empty() && !ordered)
    box.fail("'" + region.path_of("box") + "' must be " + (dimension == 1 ? "[x0, x1]" : "[x0, y0, x1, y1]") +
             ", its low corner first");
  if (!ordered) return {};
  if (dimension == 1) return {{b[0], 0}, {b[1], 0}};
  return {{b[0], b[1]}, {b[2], b[1]}, {b[2], b[3]}, {b[0], b[3]}};
}

std::vector<Point> polygon_corners(Table& region, int dimension) {
  const std::vector<Point> corners = region.points("polygon").otherwise({});
  if (dimension == 1)
    region.error("polygon", "a 1-D scene has no polygons", "write box = [x0, x1]");
  else if (!corners.empty() && corners.size() < 3)
    region.error("polygon", "'" + region.path_of("polygon") + "' must have three points at least");
  return corners;
}

AreaLimit read_area(Table& section, const Scene& scene) {
  AreaLimit limit;
  limit.elsewhere = section.number("area", "spacing^D").positive().optional();
  const std::size_t count = section.size_of("region");
  for (std::size_t i = 0; i < count; ++i) {
    Table region = section.element("region", i);
    const std::string shape = region.one_of({"box", "polygon"}, true);
    AreaLimit::Region read;
    if (shape == "box") read.corners = box_corners(region, scene.domain.dimension);
    if (shape == "polygon") read.corners = polygon_corners(region, scene.domain.dimension);
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
    section.error("area", "'sph.well_balanced' holds every particle to its depth at t = 0, which new ones do not have",
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
  split.eps = section.number("eps").within(0.05, 1.0).otherwise(line && split.into == 2 ? 0.25 : line ? 1.0 / 3 : 0.36);
  split.relax = section.number("relax", "h/c").at_least(0).otherwise(split.relax);
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
  merge.relax = section.number("relax", "h/c").at_least(0).otherwise(merge.relax);
  scene.merge = merge;
}

}  // namespace freshet::input
