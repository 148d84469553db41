#include "src/scene/sections/boundaries/sides.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/boundaries/walls/polyline.hpp"

namespace freshet::input {
namespace {

double diagonal(const Domain& domain) {
  return std::hypot(domain.high[0] - domain.low[0], domain.high[1] - domain.low[1]);
}

// What a boundary takes of a side: from and to as fractions of the side's length, and the points there.
struct Opening {
  double from = 0, to = 0;
  Point first{}, last{};
};

// Empty unless the line lies on the side.
Opening opening_in(const Piece& side, const Point* line, double tolerance) {
  std::array<double, 2> part{};
  for (int k = 0; k < 2; ++k) {
    const Foot<double> foot = foot_on(side, to_vec<2>(line[k]));
    if (std::abs(foot.off) > tolerance) return {};
    part[k] = foot.along / side.length;
  }
  const int first = part[0] < part[1] ? 0 : 1;
  return {part[first], part[1 - first], line[first], line[1 - first]};
}

// What is left of the side from one corner to the next, as ends of pieces.
std::vector<std::array<Point, 2>> closed_parts(const Point& from, const Point& to, const Scene& scene) {
  constexpr double none = 1e-9;  // of the side: shorter pieces are rounding
  const Piece side = piece_between(from, to);
  std::vector<Opening> openings;
  for (const OpenBoundary& boundary : scene.boundaries)
    for (std::size_t k = 0; k + 1 < boundary.line.size(); ++k) {
      const Opening opening = opening_in(side, &boundary.line[k], none * diagonal(scene.domain));
      if (opening.to - opening.from > none) openings.push_back(opening);
    }
  std::sort(openings.begin(), openings.end(),
            [](const Opening& a, const Opening& b) { return a.from < b.from; });
  openings.push_back({1, 1, to, to});
  std::vector<std::array<Point, 2>> parts;
  double reached = 0;
  Point begin = from;
  for (const Opening& opening : openings) {
    if (opening.from - reached > none) parts.push_back({begin, opening.first});
    if (opening.to <= reached) continue;
    reached = opening.to;
    begin = opening.last;
  }
  return parts;
}

void add_ends(Scene& scene) {
  for (const double x : {scene.domain.low[0], scene.domain.high[0]}) {
    const auto here = [x](const OpenBoundary& boundary) {
      return !boundary.line.empty() && boundary.line[0][0] == x;
    };
    if (std::none_of(scene.boundaries.begin(), scene.boundaries.end(), here))
      scene.walls.push_back({{Point{x, 0}}});
  }
}

}  // namespace

void add_box_walls(Scene& scene) {
  if (scene.domain.dimension == 1) return add_ends(scene);
  const Point a = scene.domain.low, b = scene.domain.high;
  const std::array<Point, 4> corners = {{{a[0], a[1]}, {b[0], a[1]}, {b[0], b[1]}, {a[0], b[1]}}};
  std::vector<Wall> chains;
  for (int k = 0; k < 4; ++k) {
    for (const auto& [from, to] : closed_parts(corners[k], corners[(k + 1) % 4], scene)) {
      if (chains.empty() || chains.back().line.back() != from) chains.push_back({{from}});
      chains.back().line.push_back(to);
    }
  }
  // The last chain may end where the first begins: at the corner where the walk started.
  if (chains.size() > 1 && chains.back().line.back() == chains.front().line.front()) {
    std::vector<Point>& last = chains.back().line;
    last.insert(last.end(), chains.front().line.begin() + 1, chains.front().line.end());
    chains.erase(chains.begin());
  }
  for (Wall& chain : chains) scene.walls.push_back(std::move(chain));
}

}  // namespace freshet::input
