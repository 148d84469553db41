#include "src/scene/place/water_region.hpp"

namespace freshet {

WaterRegion::WaterRegion(const std::vector<Wall>& walls) {
  for (const Wall& wall : walls) {
    if (wall.line.size() < 4 || !is_closed(wall.line)) continue;
    Outline outline{wall.line, signed_area(wall.line) > 0, bounds_of(wall.line)};
    std::vector<Piece> heights;
    for (std::size_t k = 0; k + 1 < wall.line.size(); ++k)
      heights.push_back({{0, wall.line[k][1]}, {0, wall.line[k + 1][1]}});
    const double height = outline.bounds.yhi - outline.bounds.ylo;
    outline.by_y = PieceBins(heights, height / static_cast<double>(heights.size()));
    outlines_.push_back(std::move(outline));
  }
}

// Even-odd rule.
bool WaterRegion::Outline::encloses(const Point& p) const {
  bool inside = false;
  by_y.for_each({0, 0, p[1], p[1]}, [&](int k) {
    const auto side = static_cast<std::size_t>(k);
    inside = inside != crosses_ray(to_vec<2>(line[side]), to_vec<2>(line[side + 1]), to_vec<2>(p));
  });
  return inside;
}

bool WaterRegion::holds(const Point& p) const {
  for (const Outline& outline : outlines_) {
    const Box& b = outline.bounds;
    const bool near = p[0] >= b.xlo && p[0] <= b.xhi && p[1] >= b.ylo && p[1] <= b.yhi;
    if ((near && outline.encloses(p)) != outline.water_inside) return false;
  }
  return true;
}

}  // namespace freshet
