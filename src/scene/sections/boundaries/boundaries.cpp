// [[boundary]]: lines with the water on their left.
#include <algorithm>
#include <cmath>
#include <functional>

#include "kernels/boundaries/walls/polyline.hpp"
#include "src/scene/data/series.hpp"
#include "src/scene/sections/boundaries/sides.hpp"
#include "src/scene/sections/sections.hpp"
#include "src/scene/toml/choices.hpp"

namespace freshet::input {
namespace {

enum class SideName { left, right, bottom, top };

std::vector<Point> side_line(const Domain& domain, SideName side) {
  const Point a = domain.low, b = domain.high;
  if (domain.dimension == 1) {
    const double x = side == SideName::left ? a[0] : b[0];
    return side == SideName::left ? std::vector<Point>{{x, 1}, {x, 0}} : std::vector<Point>{{x, 0}, {x, 1}};
  }
  switch (side) {
    case SideName::bottom: return {{a[0], a[1]}, {b[0], a[1]}};
    case SideName::right: return {{b[0], a[1]}, {b[0], b[1]}};
    case SideName::top: return {{b[0], b[1]}, {a[0], b[1]}};
    default: return {{a[0], b[1]}, {a[0], a[1]}};
  }
}

std::vector<Point> read_side(Table& section, const Domain& domain) {
  std::vector<std::pair<std::string, SideName>> sides = {{"left", SideName::left},
                                                         {"right", SideName::right}};
  if (domain.dimension == 2) {
    sides.emplace_back("bottom", SideName::bottom);
    sides.emplace_back("top", SideName::top);
  }
  return side_line(domain, section.choice<SideName>("side", sides).otherwise(SideName::left));
}

// The largest bend between two pieces of a line [degrees]: the buffers behind them meet at a mitre.
constexpr double most_bend = 120;

bool bends_too_much(const std::vector<Point>& line) {
  for (std::size_t k = 1; k + 1 < line.size(); ++k) {
    const Vec<double, 2> a = to_vec<2>(line[k - 1]), b = to_vec<2>(line[k]), c = to_vec<2>(line[k + 1]);
    if (std::abs(turn(b - a, c - b)) > most_bend * pi / 180) return true;
  }
  return false;
}

// Whether what lies left of a piece is outside the domain.
bool leads_out(const std::vector<Point>& line, const Scene& scene) {
  for (std::size_t k = 1; k < line.size(); ++k) {
    const Piece piece = piece_between(line[k - 1], line[k]);
    const Vec<double, 2> left = 0.5 * (piece.a + piece.b) + 0.01 * scene.water.spacing * piece.normal;
    const Point a = scene.domain.low, b = scene.domain.high;
    if (left.x < a[0] || left.x > b[0] || left.y < a[1] || left.y > b[1]) return true;
  }
  return false;
}

std::vector<Point> read_line(Table& section, const Scene& scene) {
  const std::vector<Point> line = section.points("line").otherwise({});
  if (line.empty()) return {};
  if (scene.domain.dimension == 1) {
    section.error("line", "a 1-D scene has no lines", "write side = \"left\" or side = \"right\"");
    return {};
  }
  if (line.size() < 2 || std::adjacent_find(line.begin(), line.end()) != line.end()) {
    section.error("line", "'" + section.path_of("line") +
                              "' must have two or more points, each different from the one before");
    return {};
  }
  if (bends_too_much(line)) {
    section.error("line",
                  "'" + section.path_of("line") + "' bends by more than " + shown(most_bend) + " degrees",
                  "make two boundaries of it, with a wall between them");
    return {};
  }
  for (const Point& point : line)
    if (!require_inside(section, "line", "the boundary", point, scene)) return {};
  if (leads_out(line, scene)) {
    section.error(
        "line", "the left of '" + section.path_of("line") + "', where its water is, lies outside the domain",
        "reverse its points");
    return {};
  }
  return line;
}

// Whether piece s and that from b[0] to b[1] share more than a point; a tolerance in m.
bool overlap(const Piece& s, const Point* b, double tolerance) {
  double low = s.length, high = 0;
  for (int k = 0; k < 2; ++k) {
    const Foot<double> foot = foot_on(s, to_vec<2>(b[k]));
    if (std::abs(foot.off) > tolerance) return false;
    low = std::min(low, foot.along);
    high = std::max(high, foot.along);
  }
  return std::min(high, s.length) - std::max(low, 0.0) > tolerance;
}

// Water that crosses belongs to one boundary.
void require_apart(const Table& section, const OpenBoundary& boundary, const Scene& scene) {
  const double tolerance = 1e-6 * scene.water.spacing;
  for (const OpenBoundary& other : scene.boundaries)
    for (std::size_t k = 0; k + 1 < boundary.line.size(); ++k)
      for (std::size_t l = 0; l + 1 < other.line.size(); ++l)
        if (overlap(piece_between(boundary.line[k], boundary.line[k + 1]), &other.line[l], tolerance))
          return section.error("name",
                               "boundary '" + boundary.name + "' lies on boundary '" + other.name + "'",
                               "let one end where the other begins");
}

// An imposed value must be known for the whole run.
void require_span(const Table& section, const std::string& key, const Series& series, double end) {
  const double slack = 1e-9 * std::max(1.0, end);
  if (series.t.empty() || end <= 0) return;
  if (series.t.front() > slack) {
    section.error(key, "the series begins at t = " + shown(series.t.front()) + " s, the run at 0",
                  "add a row for t = 0", Blame::data);
  }
  if (series.t.back() < end - slack) {
    section.error(key,
                  "the series ends at t = " + shown(series.t.back()) + " s, the run at " + shown(end) + " s",
                  "lengthen the series or shorten time.end", Blame::data);
  }
}

// { times = [...], values = [...] }
Series read_inline(Table& table) {
  Value<std::vector<double>> times = table.numbers("times"), values = table.numbers("values");
  Series series{times.required(), values.required()};
  if (series.t.empty() || series.t.size() != series.value.size()) {
    values.fail("'" + table.path_of("values") + "' has " + counted(series.value.size(), "number") +
                    ", 'times' has " + std::to_string(series.t.size()),
                "give one value for each time");
    return {};
  }
  if (std::adjacent_find(series.t.begin(), series.t.end(), std::greater_equal<double>()) != series.t.end()) {
    times.fail("the times must increase strictly");
    return {};
  }
  return series;
}

// A number, a series in a file or one written out.
Series read_quantity(Table& section, const std::string& key, const std::string& unit, const Scene& scene) {
  if (!section.has_table(key)) {
    Value<double> number = section.number(key, unit);
    number.required();
    return number.optional() ? Series{{0.0}, {*number.optional()}} : Series{};
  }
  Table table = section.table(key);
  const Series series = table.has("times") ? read_inline(table) : read_series(table, SeriesUse::forcing);
  require_span(section, key, series, scene.end_time);
  return series;
}

// Reads what a law asks for.
class LawReader {
 public:
  LawReader(Table& section, const Scene& scene, OpenBoundary& boundary)
      : section_(section), scene_(scene), boundary_(boundary) {}

  void in_time(const std::string& key, const std::string& unit) { impose(key, key, unit); }
  void level() {
    const std::string source = section_.one_of({"series", "level"}, true);
    if (!source.empty()) impose(source, "level", "m");
  }
  void one_in_time(const std::array<std::string, 2>& keys, const std::string& unit, bool& second) {
    const std::string key = section_.one_of({keys[0], keys[1]}, true);
    second = key == keys[1];
    if (!key.empty()) in_time(key, unit);
  }
  void if_given(const std::string& key, const std::string& unit, bool& given) {
    given = section_.has(key);
    if (given) in_time(key, unit);
    else section_.accept(key);
  }
  void word(const std::string& key, const std::array<std::string, 2>& words, bool& second) {
    second = section_.choice<bool>(key, {{words[0], false}, {words[1], true}}).otherwise(second);
  }

 private:
  void impose(const std::string& key, const std::string& what, const std::string& unit) {
    boundary_.imposed.push_back({what, unit, read_quantity(section_, key, unit, scene_)});
  }

  Table& section_;
  const Scene& scene_;
  OpenBoundary& boundary_;
};

}  // namespace

void read_boundary(Table& section, Scene& scene) {
  OpenBoundary boundary;
  boundary.name = section.text("name").otherwise("boundary " + std::to_string(scene.boundaries.size() + 1));
  const std::string source = section.one_of({"line", "side"}, true);
  if (source == "line") boundary.line = read_line(section, scene);
  if (source == "side") boundary.line = read_side(section, scene.domain);
  boundary.spacing = section.number("spacing", "m").positive().otherwise(0);
  Value<OpenLaw> law = section.choice("type", named<OpenLaw>());
  boundary.law = law.required();
  if (law.optional()) read_keys(section, "type", boundary.law, LawReader(section, scene, boundary));
  else section.accept_rest();
  require_apart(section, boundary, scene);
  scene.boundaries.push_back(std::move(boundary));
}

}  // namespace freshet::input
