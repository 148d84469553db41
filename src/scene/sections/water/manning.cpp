// bed.manning: a number, a raster or regions.
#include <algorithm>
#include <cmath>
#include <memory>

#include "kernels/boundaries/walls/polyline.hpp"
#include "src/scene/data/files.hpp"
#include "src/scene/data/grid_file.hpp"
#include "src/scene/sections/sections.hpp"
#include "src/scene/shapes/region.hpp"

namespace freshet::input {
namespace {

constexpr double roughest = 1;  // s/m^(1/3), far beyond dense forest (0.2): what is larger is not an n
const char* const strickler =
    "n is 0.01 (concrete) to 0.2 (forest) s/m^(1/3); a Strickler coefficient of 30 is n = 1/30";

Value<double> read_n(Table& section, const std::string& key) {
  Value<double> n = section.number(key, "s/m^(1/3)");
  n.at_least(0).check([](double v) { return v <= roughest; }, "at most " + shown(roughest), strickler);
  return n;
}

struct RoughRegion {
  std::vector<Point> corners;
  double n = 0;

  bool holds(double x, double y, bool line) const {
    if (corners.size() < 2) return false;
    return line ? corners[0][0] <= x && x < corners[1][0] : encloses(corners, {x, y});
  }
};

// The first region that holds the place decides. The lattice is that of the bed or, where it is finer, of the
// water.
Manning read_regions(Table& section, const Scene& scene) {
  const double rest = read_n(section, "default").required();
  const bool line = scene.domain.dimension == 1;
  std::vector<RoughRegion> regions;
  for (std::size_t k = 0; k < section.size_of("regions"); ++k) {
    Table region = section.element("regions", k);
    const std::vector<Point> corners = read_region(region, scene.domain.dimension);
    regions.push_back({corners, read_n(region, "n").required()});
  }
  Manning manning(rest);
  const double step =
      std::min(scene.water.spacing, scene.bed.spacing > 0 ? scene.bed.spacing : scene.water.spacing);
  manning.node = {scene.domain.low[0] + 0.5 * step, line ? 0 : scene.domain.low[1] + 0.5 * step};
  manning.step = {step, step};
  manning.description =
      std::to_string(regions.size()) + " regions, elsewhere n = " + shown(rest) + " s/m^(1/3)";
  manning.map = [regions, rest, line](double x, double y) {
    for (const RoughRegion& region : regions)
      if (region.holds(x, y, line)) return region.n;
    return rest;
  };
  return manning;
}

// Values of the raster must be Manning's n; missing ones take the default.
void require_roughness(const Raster& raster, const std::optional<double>& rest, const std::string& name) {
  for (int j = 0; j < raster.ny; ++j)
    for (int i = 0; i < raster.nx; ++i) {
      const double n = raster.at(i, j);
      const std::string where =
          " at (" + rounded(raster.x0 + i * raster.dx) + ", " + rounded(raster.y0 + j * raster.dy) + ")";
      if (std::isnan(n) && !rest)
        throw BadData("'" + name + "' has no value" + where, "name one for such places: default = 0.03");
      if (n < 0 || n > roughest)
        throw BadData(
            "'" + name + "' has n = " + shown(n) + where + "; it must be between 0 and " + shown(roughest),
            strickler);
    }
}

void require_extent(const Raster& raster, const Domain& domain, const std::string& name) {
  const Point low{raster.x0 - 0.5 * raster.dx, raster.y0 - 0.5 * raster.dy};
  const Point high{low[0] + raster.nx * raster.dx, low[1] + raster.ny * raster.dy};
  for (int k = 0; k < 2; ++k) {
    const double slack = 1e-6 * (high[k] - low[k]);
    if (domain.low[k] >= low[k] - slack && domain.high[k] <= high[k] + slack) continue;
    const std::string letter = k == 0 ? "x" : "y";
    throw BadData("'" + name + "' covers " + letter + " = " + rounded(low[k]) + " to " + rounded(high[k]) +
                      " m, the domain " + rounded(domain.low[k]) + " to " + rounded(domain.high[k]) + " m",
                  "name an n for what lies outside: default = 0.03");
  }
}

// A node's value within half a cell of it, the default elsewhere.
Function nearest_cell(Raster raster, double rest) {
  return [raster = std::make_shared<Raster>(std::move(raster)), rest](double x, double y) {
    const long i = std::lround((x - raster->x0) / raster->dx), j = std::lround((y - raster->y0) / raster->dy);
    if (i < 0 || j < 0 || i >= raster->nx || j >= raster->ny) return rest;
    const double n = raster->at(static_cast<int>(i), static_cast<int>(j));
    return std::isnan(n) ? rest : n;
  };
}

Manning read_raster(Table& section, const Scene& scene) {
  Value<std::string> path = section.file("file");
  const auto registration = read_registration(section);
  const std::optional<double> rest = read_n(section, "default").optional();
  Manning manning(rest.value_or(0));
  if (scene.domain.dimension == 1)
    path.fail("a raster of Manning's n needs a 2-D scene", "use regions with box = [x0, x1]");
  if (!path.optional()) return manning;
  const std::string name = file_name(*path.optional());
  try {
    Raster raster = load_grid(section, *path.optional(), read_text(*path.optional()), registration);
    require_roughness(raster, rest, name);
    if (!rest) require_extent(raster, scene.domain, name);
    manning.node = {raster.x0, raster.y0};
    manning.step = {raster.dx, raster.dy};
    manning.description =
        "file " + name + " (" + std::to_string(raster.nx) + " x " + std::to_string(raster.ny) + " values)";
    manning.map = nearest_cell(std::move(raster), manning.n);
  } catch (const BadData& bad) { path.fail(bad.what(), bad.help, Blame::data); }
  return manning;
}

}  // namespace

void read_manning(Table& bed, Scene& scene) {
  if (!bed.has_table("manning")) {
    const std::optional<double> n = read_n(bed, "manning").optional();
    if (n) scene.manning = *n;
    return;
  }
  Table section = bed.table("manning");
  const std::string source = section.one_of({"file", "regions"}, true);
  if (source.empty()) section.accept_rest();
  if (source == "file") scene.manning = read_raster(section, scene);
  if (source == "regions") scene.manning = read_regions(section, scene);
}

}  // namespace freshet::input
