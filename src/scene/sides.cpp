#include "src/scene/sides.hpp"

#include <algorithm>
#include <cmath>

namespace freshet::input {
namespace {

struct Piece {
  Point from, to;
};

double diagonal(const Domain& domain) {
  return std::hypot(domain.high[0] - domain.low[0], domain.high[1] - domain.low[1]);
}

// The part [low, high] of the side, as fractions of its length, that the line covers; empty unless it lies on the side.
std::array<double, 2> covered(const Piece& side, const std::array<Point, 2>& line, double tolerance) {
  const double dx = side.to[0] - side.from[0], dy = side.to[1] - side.from[1], length = std::hypot(dx, dy);
  std::array<double, 2> part{};
  for (int k = 0; k < 2; ++k) {
    const double x = line[k][0] - side.from[0], y = line[k][1] - side.from[1];
    if (std::abs(x * dy - y * dx) / length > tolerance) return {0, 0};
    part[k] = (x * dx + y * dy) / (length * length);
  }
  return {std::clamp(std::min(part[0], part[1]), 0.0, 1.0), std::clamp(std::max(part[0], part[1]), 0.0, 1.0)};
}

std::vector<Piece> closed_parts(const Piece& side, const Scene& scene) {
  const double tolerance = 1e-9 * diagonal(scene.domain);
  std::vector<std::array<double, 2>> openings;
  for (const OpenBoundary& boundary : scene.boundaries) {
    const auto opening = covered(side, boundary.line, tolerance);
    if (opening[1] - opening[0] > 1e-9) openings.push_back(opening);
  }
  std::sort(openings.begin(), openings.end());
  openings.push_back({1, 1});
  std::vector<Piece> parts;
  const auto at = [&](double s) {
    if (s <= 0) return side.from;  // corners to the last bit, so that sides join
    if (s >= 1) return side.to;
    return Point{side.from[0] + s * (side.to[0] - side.from[0]), side.from[1] + s * (side.to[1] - side.from[1])};
  };
  double begin = 0;
  for (const auto& opening : openings) {
    if (opening[0] - begin > 1e-9) parts.push_back({at(begin), at(opening[0])});
    begin = std::max(begin, opening[1]);
  }
  return parts;
}

void add_ends(Scene& scene) {
  for (const double x : {scene.domain.low[0], scene.domain.high[0]}) {
    const auto here = [x](const OpenBoundary& boundary) { return boundary.line[0][0] == x; };
    if (std::none_of(scene.boundaries.begin(), scene.boundaries.end(), here)) scene.walls.push_back({{Point{x, 0}}});
  }
}

}  // namespace

void add_box_walls(Scene& scene) {
  if (scene.domain.dimension == 1) return add_ends(scene);
  const Point a = scene.domain.low, b = scene.domain.high;
  const std::array<Point, 4> corners = {{{a[0], a[1]}, {b[0], a[1]}, {b[0], b[1]}, {a[0], b[1]}}};
  std::vector<Wall> chains;
  for (int k = 0; k < 4; ++k) {
    for (const Piece& piece : closed_parts({corners[k], corners[(k + 1) % 4]}, scene)) {
      if (chains.empty() || chains.back().line.back() != piece.from) chains.push_back({{piece.from}});
      chains.back().line.push_back(piece.to);
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
