#include "src/scene/shapes/slope.hpp"

#include <algorithm>
#include <cmath>

namespace freshet {
namespace {

// Windows of one width along a side of the domain, the last one cut.
struct Windows {
  double low, high, width;  // m
  int count() const { return std::max(1, static_cast<int>(std::ceil((high - low) / width))); }
  double begin(int k) const { return low + k * width; }
  double middle(int k) const { return 0.5 * (begin(k) + end(k)); }
  double end(int k) const { return std::min(low + (k + 1) * width, high); }
};

}  // namespace

double steepest_slope(const Scene& scene) {
  const Function& bed = scene.bed.elevation;
  if (!bed) return 0;
  const double lattice = scene.bed.spacing > 0 ? scene.bed.spacing : scene.water.spacing;
  const double width = 2 * std::max(lattice, 1.25 * scene.bed.filter);
  const Windows x{scene.domain.low[0], scene.domain.high[0], width},
      y{scene.domain.low[1], scene.domain.high[1], width};
  const bool plane = scene.domain.dimension == 2;
  double steepest = 0;
  for (int j = 0; j < (plane ? y.count() : 1); ++j)
    for (int i = 0; i < x.count(); ++i) {
      const double x0 = x.middle(i), y0 = plane ? y.middle(j) : 0;
      const double along_x = bed(x.end(i), y0) - bed(x.begin(i), y0),
                   along_y = plane ? bed(x0, y.end(j)) - bed(x0, y.begin(j)) : 0;
      steepest = std::max(steepest, std::hypot(along_x, along_y) / width);
    }
  return steepest;
}

}  // namespace freshet
