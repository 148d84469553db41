// Parts of the domain that a table of the scene names by `box` or `polygon`.
#pragma once
#include <vector>

#include "src/scene/table.hpp"

namespace freshet::input {

// The corners of `box = [x0, y0, x1, y1]` or `polygon = [[x, y], ...]`; 1-D: both ends of `box = [x0, x1]`. Empty after an error.
std::vector<Point> read_region(Table& region, int dimension);

// Whether the ray from p towards greater x crosses the side from `before` to a.
inline bool crosses_ray(const Point& before, const Point& a, const Point& p) {
  const bool spans = (a[1] > p[1]) != (before[1] > p[1]);
  return spans && p[0] < a[0] + (p[1] - a[1]) / (before[1] - a[1]) * (before[0] - a[0]);
}

// Even-odd rule; the last corner is joined to the first.
bool encloses(const std::vector<Point>& polygon, const Point& p);

}  // namespace freshet::input
