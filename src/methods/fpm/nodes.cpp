#include "src/methods/fpm/nodes.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/boundaries/walls/polyline.hpp"

namespace freshet::fpm {
namespace {

constexpr double apart = 0.9;   // x spacing: no two places are closer than this
constexpr double coarsest = 4;  // x water.spacing

double squared_distance(const Point& a, const Point& b) {
  return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]);
}

// From a towards b, which is left out: as many places as the mean of 1 / spacing asks for, at equal parts of
// its integral.
void walk(const Scene& scene, const Point& a, const Point& b, std::vector<Seed>& nodes) {
  constexpr int samples = 1000;
  const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
  const auto place = [&](double s) { return Point{a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])}; };
  std::vector<double> passed{0};  // spacings, from a
  for (int k = 0; k < samples; ++k)
    passed.push_back(passed.back() + length / samples / spacing_at(scene, place((k + 0.5) / samples)));
  const int parts = std::max(1, static_cast<int>(std::lround(passed.back())));
  for (int i = 0; i < parts; ++i) {
    const double want = passed.back() * i / parts;
    const auto k = static_cast<std::size_t>(
        std::max(1L, std::lower_bound(passed.begin(), passed.end(), want) - passed.begin()));
    const double part = (want - passed[k - 1]) / (passed[k] - passed[k - 1]);
    nodes.push_back({place((static_cast<double>(k - 1) + part) / samples), false});
  }
}

// The places chosen so far, by squares as long as the largest distance asked for.
class Chosen {
 public:
  Chosen(const Box& box, double side)
      : low_{box.xlo, box.ylo}, side_(side), nx_(count(box.xhi - box.xlo)), ny_(count(box.yhi - box.ylo)),
        in_(static_cast<std::size_t>(nx_ * ny_)) {}

  void add(const Point& p) { in_[static_cast<std::size_t>(row(p) * nx_ + column(p))].push_back(p); }
  bool has_room(const Point& p, double distance) const {
    for (int j = std::max(0, row(p) - 1); j <= std::min(ny_ - 1, row(p) + 1); ++j)
      for (int i = std::max(0, column(p) - 1); i <= std::min(nx_ - 1, column(p) + 1); ++i)
        for (const Point& q : in_[static_cast<std::size_t>(j * nx_ + i)])
          if (squared_distance(p, q) < distance * distance) return false;
    return true;
  }

 private:
  int count(double length) const { return std::max(1, static_cast<int>(std::ceil(length / side_))); }
  int column(const Point& p) const {
    return std::clamp(static_cast<int>((p[0] - low_[0]) / side_), 0, nx_ - 1);
  }
  int row(const Point& p) const { return std::clamp(static_cast<int>((p[1] - low_[1]) / side_), 0, ny_ - 1); }

  Point low_;
  double side_;
  int nx_, ny_;
  std::vector<std::vector<Point>> in_;
};

}  // namespace

double spacing_at(const Scene& scene, const Point& x) {
  return scene.water.spacing * (scene.fpm->grading ? scene.fpm->grading(x[0], x[1]) : 1.0);
}

std::vector<Seed> graded_nodes(const Scene& scene, const std::vector<Point>& outline) {
  std::vector<Seed> nodes;
  for (std::size_t k = 0; k < outline.size(); ++k)
    walk(scene, outline[k], outline[(k + 1) % outline.size()], nodes);
  const Box box = bounds_of(outline);
  Chosen chosen(box, coarsest * apart * scene.water.spacing);
  for (const Seed& node : nodes) chosen.add(node.x);
  const double step = 0.25 * scene.water.spacing;
  for (double y = box.ylo + step; y < box.yhi; y += step)
    for (double x = box.xlo + step; x < box.xhi; x += step)
      if (const Point p{x, y}; chosen.has_room(p, apart * spacing_at(scene, p)) && encloses(outline, p)) {
        chosen.add(p);
        nodes.push_back({p, true});
      }
  return nodes;
}

}  // namespace freshet::fpm
