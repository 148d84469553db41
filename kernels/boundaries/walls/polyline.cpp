#include "kernels/boundaries/walls/polyline.hpp"

#include <algorithm>
#include <cmath>

namespace freshet {
namespace {

double cross(const Vec<double, 2>& a, const Vec<double, 2>& b) { return a.x * b.y - a.y * b.x; }

// Twice the area of a triangle, positive counter-clockwise.
double cross(const Point& a, const Point& b, const Point& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

bool segments_cross(const Point& a, const Point& b, const Point& c, const Point& d) {
  return cross(a, b, c) * cross(a, b, d) < 0 && cross(c, d, a) * cross(c, d, b) < 0;
}

}  // namespace

bool meet(const Point& p, const Point& q, double tolerance) {
  return p == q || std::hypot(p[0] - q[0], p[1] - q[1]) < tolerance;
}

bool is_closed(const Polyline& line, double tolerance) {
  return line.size() > 2 && meet(line.front(), line.back(), tolerance);
}

Piece piece_between(const Point& a, const Point& b) {
  const double dx = b[0] - a[0], dy = b[1] - a[1], length = std::hypot(dx, dy);
  const Vec<double, 2> tangent = length > 0 ? Vec<double, 2>{dx / length, dy / length} : Vec<double, 2>{};
  return {to_vec<2>(a), to_vec<2>(b), tangent, {-tangent.y, tangent.x}, length};
}

void append_pieces(const Polyline& line, bool closed, std::vector<Piece>& pieces) {
  const int first = static_cast<int>(pieces.size()), last = first + static_cast<int>(line.size()) - 2;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const int k = first + static_cast<int>(i);
    pieces.push_back(piece_between(line[i], line[i + 1]));
    pieces.back().before = k > first ? k - 1 : closed ? last : -1;
    pieces.back().after = k < last ? k + 1 : closed ? first : -1;
  }
}

std::vector<Piece> pieces_of(const std::vector<Polyline>& lines, double tolerance) {
  std::vector<Piece> pieces;
  for (const Polyline& line : lines) append_pieces(line, is_closed(line, tolerance), pieces);
  return pieces;
}

double turn(const Vec<double, 2>& from, const Vec<double, 2>& to) {
  return std::atan2(cross(from, to), dot(from, to));
}

double distance(const Point& p, const Piece& piece) {
  const Vec<double, 2> at = to_vec<2>(p), from = from_nearest(piece, at, foot_on(piece, at).along);
  return std::hypot(from.x, from.y);
}

double distance(const Point& p, const Polyline& line) {
  if (line.empty()) return 1e300;
  double least = distance(p, piece_between(line[0], line[0]));
  for (std::size_t k = 0; k + 1 < line.size(); ++k)
    least = std::min(least, distance(p, piece_between(line[k], line[k + 1])));
  return least;
}

double signed_area(const Polyline& polygon) {
  double sum = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k)
    sum += 0.5 * cross(polygon[0], polygon[k], polygon[(k + 1) % polygon.size()]);
  return sum;
}

bool crosses_itself(const Polyline& polygon) {
  const std::size_t n = polygon.size();
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t l = k + 1; l < n; ++l)
      if (segments_cross(polygon[k], polygon[(k + 1) % n], polygon[l], polygon[(l + 1) % n])) return true;
  return false;
}

bool encloses(const Polyline& polygon, const Point& p) {
  bool inside = false;
  for (std::size_t k = 0, last = polygon.size() - 1; k < polygon.size(); last = k++)
    inside = inside != crosses_ray(to_vec<2>(polygon[last]), to_vec<2>(polygon[k]), to_vec<2>(p));
  return inside;
}

Box bounds_of(const Polyline& line) {
  Box box{line[0][0], line[0][0], line[0][1], line[0][1]};
  for (const auto& [x, y] : line)
    box = {std::min(box.xlo, x), std::max(box.xhi, x), std::min(box.ylo, y), std::max(box.yhi, y)};
  return box;
}

}  // namespace freshet
