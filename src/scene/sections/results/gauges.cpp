// [[gauge]], [[runup]] and [[profile]]: where the result is compared with measurements.
#include <algorithm>
#include <cmath>

#include "src/scene/data/series.hpp"
#include "src/scene/sections/sections.hpp"

namespace freshet::input {
namespace {

template <class Station>
void require_new_name(Table& section, const std::vector<Station>& stations, const std::string& name) {
  const auto same = [&name](const Station& station) { return station.name == name; };
  if (std::any_of(stations.begin(), stations.end(), same)) {
    section.error("name", "the name '" + name + "' stands for two of them", "results are listed by name");
  }
}

// 2-D: two points; 1-D: two numbers.
std::array<Point, 2> transect_line(Table& section, const Scene& scene) {
  std::vector<Point> ends;
  if (scene.domain.dimension == 1) {
    for (const double x : section.numbers("line", "two numbers (x, in m)").required()) ends.push_back({x, 0});
  } else {
    ends = section.points("line").required();
  }
  if (ends.size() == 2 && ends[0] != ends[1] &&
      require_inside(section, "line", "the profile", ends[0], scene) &&
      require_inside(section, "line", "the profile", ends[1], scene))
    return {ends[0], ends[1]};
  if (!ends.empty() && (ends.size() != 2 || ends[0] == ends[1]))
    section.error("line", "'" + section.path_of("line") + "' must have two different points");
  return {};
}

std::vector<std::pair<std::string, Gauge::What>> measurands() {
  std::vector<std::pair<std::string, Gauge::What>> words;
  for (const Measurand& m : Gauge::measurands)
    words.emplace_back(m.name, static_cast<Gauge::What>(words.size()));
  return words;
}

}  // namespace

std::string shown(const Point& point, const Domain& domain) {
  return domain.dimension == 1 ? "x = " + rounded(point[0])
                               : '(' + rounded(point[0]) + ", " + rounded(point[1]) + ')';
}

bool require_inside(Table& section, const std::string& key, const std::string& what, const Point& point,
                    const Scene& scene) {
  const Domain& domain = scene.domain;
  bool inside = true;
  for (int axis = 0; axis < domain.dimension; ++axis) {
    const double slack = 1e-9 * (domain.high[axis] - domain.low[axis]);
    inside = inside && point[axis] >= domain.low[axis] - slack && point[axis] <= domain.high[axis] + slack;
  }
  if (!inside) {
    section.error(
        key, what + " at " + shown(point, domain) + " lies outside the domain",
        "the domain reaches from " + shown(domain.low, domain) + " to " + shown(domain.high, domain));
  }
  return inside;
}

void read_gauge(Table& section, Scene& scene) {
  Gauge gauge;
  gauge.name = section.text("name").required();
  require_new_name(section, scene.gauges, gauge.name);
  using What = Gauge::What;
  if (scene.fpm) gauge.what = section.choice<What>("what", measurands()).otherwise(What::elevation);
  if (gauge.what != What::front) {
    Value<Point> at = section.point("at", scene.domain.dimension);
    gauge.at = at.required();
    if (at.optional()) require_inside(section, "at", "the gauge", gauge.at, scene);
  }
  Table measured = section.table("measured");
  if (measured.given()) gauge.measured = read_series(measured, SeriesUse::measured);
  gauge.peak_after = section.number("peak_after", "s").at_least(0).otherwise(gauge.peak_after);
  gauge.arrival_level =
      section.number("arrival_level", gauge.measurand().unit).otherwise(gauge.arrival_level);
  scene.gauges.push_back(std::move(gauge));
}

void read_run_up(Table& section, Scene& scene) {
  RunUp run_up;
  run_up.name = section.text("name").required();
  require_new_name(section, scene.run_ups, run_up.name);
  Value<Point> at = section.point("at", scene.domain.dimension);
  run_up.at = at.required();
  if (at.optional()) require_inside(section, "at", "the run-up point", run_up.at, scene);
  run_up.radius = section.number("radius", "m").positive().otherwise(run_up.radius);
  run_up.min_depth = section.number("min_depth", "m").at_least(0).otherwise(run_up.min_depth);
  Value<std::vector<double>> measured = section.numbers("measured", "two levels in m, [lowest, highest]");
  if (measured.optional()) {
    const std::vector<double> levels = *measured.optional();
    if (levels.size() == 2 && levels[0] <= levels[1]) run_up.measured = {levels[0], levels[1]};
    else measured.fail("'" + section.path_of("measured") + "' must be two levels, [lowest, highest] in m");
  }
  scene.run_ups.push_back(std::move(run_up));
}

void read_transect(Table& section, Scene& scene) {
  Transect transect;
  transect.name = section.text("name").required();
  require_new_name(section, scene.profiles, transect.name);
  transect.line = transect_line(section, scene);
  transect.one_dimensional = scene.domain.dimension == 1;
  const double end = scene.end_time;
  transect.time =
      section.number("time", "s")
          .at_least(0)
          .check([end](double t) { return !(end > 0) || t <= end; }, "at most time.end (" + shown(end) + ")")
          .required();
  transect.spacing = section.number("spacing", "m").positive().otherwise(scene.water.spacing);
  Table measured = section.table("measured");
  if (measured.given()) transect.measured = read_series(measured, SeriesUse::measured, "x");
  scene.profiles.push_back(std::move(transect));
}

}  // namespace freshet::input
