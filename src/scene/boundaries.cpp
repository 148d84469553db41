// [[boundary]]: lines with the water on their left.
#include <algorithm>
#include <cmath>

#include "src/scene/sections.hpp"
#include "src/scene/series.hpp"
#include "src/scene/sides.hpp"

namespace freshet::input {
namespace {

enum class SideName { left, right, bottom, top };

std::array<Point, 2> side_line(const Domain& domain, SideName side) {
  const Point a = domain.low, b = domain.high;
  if (domain.dimension == 1) {
    const double x = side == SideName::left ? a[0] : b[0];
    return side == SideName::left ? std::array<Point, 2>{{{x, 1}, {x, 0}}}
                                  : std::array<Point, 2>{{{x, 0}, {x, 1}}};
  }
  switch (side) {
    case SideName::bottom: return {{{a[0], a[1]}, {b[0], a[1]}}};
    case SideName::right: return {{{b[0], a[1]}, {b[0], b[1]}}};
    case SideName::top: return {{{b[0], b[1]}, {a[0], b[1]}}};
    default: return {{{a[0], b[1]}, {a[0], a[1]}}};
  }
}

std::array<Point, 2> read_side(Table& section, const Domain& domain) {
  std::vector<std::pair<std::string, SideName>> sides = {{"left", SideName::left},
                                                         {"right", SideName::right}};
  if (domain.dimension == 2) {
    sides.emplace_back("bottom", SideName::bottom);
    sides.emplace_back("top", SideName::top);
  }
  return side_line(domain, section.choice<SideName>("side", sides).otherwise(SideName::left));
}

std::array<Point, 2> read_line(Table& section, const Scene& scene) {
  const std::vector<Point> line = section.points("line").otherwise({});
  if (line.empty()) return {};
  if (scene.domain.dimension == 1) {
    section.error("line", "a 1-D scene has no lines", "write side = \"left\" or side = \"right\"");
  } else if (line.size() != 2 || line[0] == line[1]) {
    section.error("line", "'" + section.path_of("line") + "' must have two different points");
  } else if (require_inside(section, "line", "the boundary", line[0], scene) &&
             require_inside(section, "line", "the boundary", line[1], scene)) {
    return {line[0], line[1]};
  }
  return {};
}

// An imposed level must be known for the whole run.
void require_span(Table& section, const Series& series, double end) {
  const double slack = 1e-9 * std::max(1.0, end);
  if (series.t.front() > slack) {
    section.error("series", "the series begins at t = " + shown(series.t.front()) + " s, the run at 0",
                  "add a row for t = 0", Blame::data);
  }
  if (series.t.back() < end - slack) {
    section.error("series",
                  "the series ends at t = " + shown(series.t.back()) + " s, the run at " + shown(end) + " s",
                  "lengthen the series or shorten time.end", Blame::data);
  }
}

Series read_level(Table& section, const Scene& scene) {
  const std::string source = section.one_of({"series", "level"}, true);
  if (source == "level") {
    const double level = section.number("level", "m").otherwise(0);
    return {{0.0}, {level}};
  }
  if (source.empty()) return {};
  Table table = section.table("series");
  if (!table.given()) return {};
  const Series series = read_series(table, SeriesUse::forcing);
  if (!series.t.empty() && scene.end_time > 0) require_span(section, series, scene.end_time);
  return series;
}

}  // namespace

void read_boundary(Table& section, Scene& scene) {
  OpenBoundary boundary;
  boundary.name = section.text("name").otherwise("boundary " + std::to_string(scene.boundaries.size() + 1));
  boundary.kind = section
                      .choice<OpenBoundary::Kind>("type", {{"elevation", OpenBoundary::Kind::elevation},
                                                           {"wave", OpenBoundary::Kind::wave}})
                      .required();
  const std::string source = section.one_of({"line", "side"}, true);
  if (source == "line") boundary.line = read_line(section, scene);
  if (source == "side") boundary.line = read_side(section, scene.domain);
  boundary.level = read_level(section, scene);
  scene.boundaries.push_back(std::move(boundary));
}

}  // namespace freshet::input
