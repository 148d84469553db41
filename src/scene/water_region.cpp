#include "src/scene/water_region.hpp"

#include <algorithm>
#include <cmath>

#include "src/scene/region.hpp"

namespace freshet {
namespace {

double cross(const Point& a, const Point& b, const Point& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

bool segments_cross(const Point& a, const Point& b, const Point& c, const Point& d) {
  return cross(a, b, c) * cross(a, b, d) < 0 && cross(c, d, a) * cross(c, d, b) < 0;
}

}  // namespace

double signed_area(const std::vector<Point>& line) {
  double sum = 0;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const Point &a = line[k], &b = line[(k + 1) % line.size()];
    sum += 0.5 * ((a[0] - line[0][0]) * (b[1] - line[0][1]) - (b[0] - line[0][0]) * (a[1] - line[0][1]));
  }
  return sum;
}

double distance(const Point& p, const Point& a, const Point& b) {
  const double dx = b[0] - a[0], dy = b[1] - a[1], length2 = dx * dx + dy * dy;
  const double along = length2 > 0 ? std::clamp(((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / length2, 0.0, 1.0) : 0;
  return std::hypot(p[0] - a[0] - along * dx, p[1] - a[1] - along * dy);
}

bool crosses_itself(const std::vector<Point>& line) {
  const std::size_t n = line.size();
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t l = k + 1; l < n; ++l)
      if (segments_cross(line[k], line[(k + 1) % n], line[l], line[(l + 1) % n])) return true;
  return false;
}

WaterRegion::WaterRegion(const std::vector<Wall>& walls) {
  for (const Wall& wall : walls) {
    if (wall.line.size() < 4 || wall.line.front() != wall.line.back()) continue;
    Outline outline{wall.line, signed_area(wall.line) > 0, wall.line[0], wall.line[0]};
    for (const Point& p : wall.line)
      for (std::size_t k = 0; k < 2; ++k) {
        outline.low[k] = std::min(outline.low[k], p[k]);
        outline.high[k] = std::max(outline.high[k], p[k]);
      }
    std::vector<SegmentBins::Ends> heights;
    for (std::size_t k = 0; k + 1 < wall.line.size(); ++k)
      heights.push_back({{0, wall.line[k][1]}, {0, wall.line[k + 1][1]}});
    outline.by_y = SegmentBins(heights, (outline.high[1] - outline.low[1]) / static_cast<double>(heights.size()));
    outlines_.push_back(std::move(outline));
  }
}

// Even-odd rule.
bool WaterRegion::Outline::encloses(const Point& p) const {
  bool inside = false;
  by_y.for_each({0, 0, p[1], p[1]}, [&](int k) {
    const auto side = static_cast<std::size_t>(k);
    if (input::crosses_ray(line[side], line[side + 1], p)) inside = !inside;
  });
  return inside;
}

bool WaterRegion::holds(const Point& p) const {
  for (const Outline& outline : outlines_) {
    const bool near = p[0] >= outline.low[0] && p[0] <= outline.high[0] && p[1] >= outline.low[1] && p[1] <= outline.high[1];
    if ((near && outline.encloses(p)) != outline.water_inside) return false;
  }
  return true;
}

}  // namespace freshet
