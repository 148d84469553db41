#include "kernels/fpm/tank.hpp"

#include <algorithm>
#include <cmath>

#include "cellgrid/on_device.hpp"

namespace freshet::fpm {
namespace {

constexpr double corner_turn = 0.17;  // rad, 10 degrees

Side side_between(const std::array<double, 2>& a, const std::array<double, 2>& b) {
  const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
  const Vec<double, 2> tangent{(b[0] - a[0]) / length, (b[1] - a[1]) / length};
  return {{a[0], a[1]}, {b[0], b[1]}, tangent, {-tangent.y, tangent.x}, length, -1, -1, false, false, true, true};
}

// Angle from s to t, positive where the water fills less than 180 degrees.
double turn_between(const Side& s, const Side& t) {
  return std::atan2(s.tangent.x * t.tangent.y - s.tangent.y * t.tangent.x, dot(s.tangent, t.tangent));
}

void join(std::vector<Side>& sides, int k, int next) {
  Side &s = sides[static_cast<std::size_t>(k)], &t = sides[static_cast<std::size_t>(next)];
  const double turn = turn_between(s, t);
  s.after = next;
  t.before = k;
  s.round_b = t.round_a = turn < 0;
  s.corner_b = t.corner_a = turn > corner_turn;
}

void append_line(std::vector<Side>& sides, const std::vector<std::array<double, 2>>& line) {
  const int first = static_cast<int>(sides.size()), last = first + static_cast<int>(line.size()) - 2;
  for (std::size_t k = 0; k + 1 < line.size(); ++k) sides.push_back(side_between(line[k], line[k + 1]));
  for (int k = first; k < last; ++k) join(sides, k, k + 1);
  if (line.size() > 2 && line.front() == line.back()) join(sides, last, first);
}

}  // namespace

Tank::Tank(const std::vector<std::vector<std::array<double, 2>>>& lines, double cell) {
  for (const auto& line : lines) append_line(sides_, line);
  std::vector<SegmentBins::Ends> ends;
  for (const Side& s : sides_) ends.push_back({{s.a.x, s.a.y}, {s.b.x, s.b.y}});
  view_ = {on_device("fpm.sides", sides_), SegmentBins(ends, cell)};
}

// Each side holds the points up to its end b; its first one, where nothing is joined there, too.
std::vector<WallStart> Tank::lay_points(double spacing) const {
  std::vector<WallStart> points;
  for (int k = 0; k < size(); ++k) {
    const Side& s = sides_[static_cast<std::size_t>(k)];
    const int parts = std::max(1, static_cast<int>(std::ceil(s.length / spacing - 1e-9)));
    for (int i = s.before < 0 ? 0 : 1; i <= parts; ++i) {
      const double along = s.length * i / parts;
      const bool corner = i == parts && s.corner_b;
      points.push_back({{s.a.x + along * s.tangent.x, s.a.y + along * s.tangent.y}, corner ? in_corner : on_wall, k});
    }
  }
  return points;
}

}  // namespace freshet::fpm
