// [bed]: z | file | shape, and how the bed is sampled, smoothed and roughened.
#include <algorithm>
#include <cmath>
#include <limits>

#include "src/scene/data/files.hpp"
#include "src/scene/data/grid_file.hpp"
#include "src/scene/data/points.hpp"
#include "src/scene/sections/sections.hpp"
#include "src/scene/shapes/shapes.hpp"

namespace freshet::input {
namespace {

// What turns the numbers of a file into levels: sign * scale * number + offset.
struct FileOptions {
  std::optional<Registration> registration;
  std::optional<double> fill;  // stands for missing values; absent = they are an error
  double factor = 1, offset = 0;
  double reach = 0;  // m, how far outside the domain values count: the smoothing of the bed looks there
};

struct FileBed {
  Function elevation;
  double spacing = 0;
  int nodata = 0;
  Point low{}, high{};  // m, what the file covers
  double reach = 0;     // m, how far outside a domain may lie
  std::string what;     // "393 x 244 nodes"
};

FileOptions read_file_options(Table& bed) {
  FileOptions options;
  options.registration = read_registration(bed);
  const double sign = bed.choice<double>("vertical", {{"up", 1.0}, {"down", -1.0}}).otherwise(1.0);
  options.factor = sign * bed.number("scale").otherwise(1);
  options.offset = bed.number("offset", "m").otherwise(0);
  if (bed.has_table("nodata")) {
    Table nodata = bed.table("nodata");
    options.fill = nodata.number("fill", "m").required();
  } else {
    bed.choice<bool>("nodata", {{"error", true}});
  }
  return options;
}

void require_no_file_options(Table& bed) {
  for (const char* key : {"registration", "vertical", "scale", "offset", "nodata"}) {
    if (bed.has(key)) {
      bed.context().diagnostics.error(bed.key_place(key),
                                      "'" + bed.path_of(key) + "' applies to 'bed.file' only");
    }
  }
}

FileBed from_raster(Raster raster, const FileOptions& options, const Domain& domain,
                    const std::string& name) {
  FileBed bed;
  bed.what = std::to_string(raster.nx) + " x " + std::to_string(raster.ny) + " nodes";
  bed.low = {raster.x0, raster.y0};
  bed.high = {raster.x0 + (raster.nx - 1) * raster.dx, raster.y0 + (raster.ny - 1) * raster.dy};
  bed.reach = std::max(raster.dx, raster.dy);
  bed.spacing = std::min(raster.dx, raster.dy);
  const auto part = std::make_shared<Raster>(cropped(raster, domain, options.reach));
  for (double& z : part->z) z = options.factor * z + options.offset;
  const Gaps gaps = find_gaps(*part);
  bed.nodata = gaps.count;
  if (gaps.count > 0 && !options.fill) {
    throw BadData("'" + name + "' has no value at " + counted(gaps.count, "node") +
                      " near the domain, the first at (" + rounded(gaps.first[0]) + ", " +
                      rounded(gaps.first[1]) + ")",
                  "choose a smaller domain, or a level for them: nodata = { fill = 0.0 }");
  }
  for (double& z : part->z) z = std::isnan(z) ? *options.fill : z;
  bed.elevation = [part](double x, double y) { return part->level(x, y); };
  return bed;
}

FileBed from_scatter(std::vector<SurveyPoint> points, const FileOptions& options, const std::string& name) {
  FileBed bed;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  bed.low = {infinity, infinity};
  bed.high = {-infinity, -infinity};
  for (SurveyPoint& p : points) {
    p.z = options.factor * p.z + options.offset;
    bed.nodata += std::isnan(p.z) ? 1 : 0;
    if (std::isnan(p.z) && options.fill) p.z = *options.fill;
    bed.low = {std::min(bed.low[0], p.x), std::min(bed.low[1], p.y)};
    bed.high = {std::max(bed.high[0], p.x), std::max(bed.high[1], p.y)};
  }
  if (bed.nodata > 0 && !options.fill) {
    throw BadData("'" + name + "' has " + counted(bed.nodata, "point") + " without a level",
                  "remove them, or choose a level for them: nodata = { fill = 0.0 }");
  }
  bed.spacing = bed.reach = mean_spacing(points);
  bed.what = std::to_string(points.size()) + " scattered points, inverse distance of the 8 nearest";
  bed.elevation = nearest_points(std::move(points));
  return bed;
}

FileBed load_bed(const std::string& path, const FileOptions& options, const Domain& domain, Table& section) {
  const std::string text = read_text(path), name = file_name(path);
  if (looks_like_ascii_grid(text)) {
    return from_raster(load_grid(section, path, text, options.registration), options, domain, name);
  }
  std::vector<SurveyPoint> points = read_points(path, text);
  if (auto lattice = as_lattice(points)) {
    FileBed bed = from_raster(std::move(*lattice), options, domain, name);
    bed.what += " from x-y-z points";
    return bed;
  }
  return from_scatter(std::move(points), options, name);
}

void require_cover(Table& section, const FileBed& file, const std::string& name, const Domain& domain) {
  for (int axis = 0; axis < domain.dimension; ++axis) {
    if (domain.low[axis] >= file.low[axis] - file.reach && domain.high[axis] <= file.high[axis] + file.reach)
      continue;
    const std::string letter = axis == 0 ? "x" : "y";
    section.error("file",
                  "'" + name + "' covers " + letter + " = " + rounded(file.low[axis]) + " to " +
                      rounded(file.high[axis]) + " m, the domain " + rounded(domain.low[axis]) + " to " +
                      rounded(domain.high[axis]) + " m",
                  "make the domain smaller, or check the units and the registration");
    return;
  }
}

double read_file_bed(Table& section, Scene& scene) {
  Value<std::string> path = section.file("file");
  FileOptions options = read_file_options(section);
  options.reach = 6 * scene.sph.eta * scene.water.spacing;
  if (!path.optional()) return 0;
  const std::string name = file_name(*path.optional());
  try {
    FileBed file = load_bed(*path.optional(), options, scene.domain, section);
    require_cover(section, file, name, scene.domain);
    scene.bed.elevation = std::move(file.elevation);
    scene.bed.nodata = file.nodata;
    scene.bed.description = "file " + name + " (" + file.what + ")";
    return file.spacing;
  } catch (const BadData& bad) { path.fail(bad.what(), bad.help, Blame::data); }
  return 0;
}

void read_elevation(Table& section, const std::string& source, Scene& scene) {
  require_no_file_options(section);
  read_file_options(section);  // makes the keys known
  if (source == "z") {
    scene.bed.elevation = section.function("z").required();
    scene.bed.description = section.has_text("z") ? "expression " + section.text("z").required() : "constant";
  } else if (source == "shape") {
    Table shape = section.table("shape");
    if (shape.given()) scene.bed.elevation = read_shape(shape, scene.domain.dimension, scene.bed.description);
  }
}

// Standard deviation per axis of the cubic spline of smoothing length 1: its second moment is 31/98 in 2-D,
// 1/3 in 1-D.
double kernel_width(int dimension) { return std::sqrt(dimension == 2 ? 31.0 / 98.0 : 1.0 / 3.0); }

void read_filter(Table& section, bool from_file, Scene& scene) {
  enum class Filter { none, h };
  Filter filter = from_file ? Filter::h : Filter::none;
  if (section.has_number("filter")) {
    scene.bed.filter = section.number("filter", "m").at_least(0).otherwise(0);
    return;
  }
  filter = section.choice<Filter>("filter", {{"none", Filter::none}, {"h", Filter::h}}).otherwise(filter);
  const double h = scene.sph.eta * scene.water.spacing;
  scene.bed.filter = filter == Filter::h ? kernel_width(scene.domain.dimension) * h : 0;
}

// Lowest and highest level on the bed lattice (thinned where it is very fine); every level must be a number.
void find_range(Table& section, const std::string& source, Scene& scene) {
  const Domain& domain = scene.domain;
  const auto nodes = [&](int axis) {
    const double length = domain.high[axis] - domain.low[axis];
    return static_cast<int>(std::lround(std::clamp(length / scene.bed.spacing, 2.0, 500.0)));
  };
  const int nx = nodes(0), ny = domain.dimension == 2 ? nodes(1) : 0;
  scene.bed.range = {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (int j = 0; j <= ny; ++j) {
    for (int i = 0; i <= nx; ++i) {
      const Point at{domain.low[0] + (domain.high[0] - domain.low[0]) * i / nx,
                     domain.low[1] + (ny == 0 ? 0 : (domain.high[1] - domain.low[1]) * j / ny)};
      const double z = scene.bed.elevation(at[0], at[1]);
      if (!std::isfinite(z)) {
        section.error(source, "the bed is not a number at " + shown(at, domain));
        return;
      }
      scene.bed.range = {std::min(scene.bed.range[0], z), std::max(scene.bed.range[1], z)};
    }
  }
}

}  // namespace

void read_bed(Table& section, Scene& scene) {
  const std::string source = section.one_of({"z", "file", "shape"}, false);
  double spacing = scene.water.spacing;
  if (source == "file") {
    const double own = read_file_bed(section, scene);
    if (own > 0) spacing = own;
  } else {
    read_elevation(section, source, scene);
  }
  scene.bed.spacing = section.number("spacing", "m").positive().otherwise(spacing);
  read_filter(section, source == "file", scene);
  read_manning(section, scene);
  if (scene.bed.elevation && scene.bed.spacing > 0) find_range(section, source, scene);
}

}  // namespace freshet::input
