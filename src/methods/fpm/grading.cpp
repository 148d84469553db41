#include "src/methods/fpm/grading.hpp"

#include <algorithm>
#include <string>

#include "cellgrid/parallel/launch.hpp"
#include "src/errors.hpp"

namespace freshet::fpm {
namespace {

constexpr double least = 1, most = 4;

BedSpline<2>::Lattice lattice_of(const Scene& scene) {
  return {{scene.domain.low[0], scene.domain.low[1]},
          {scene.domain.high[0], scene.domain.high[1]},
          2 * scene.water.spacing,
          0};
}

// Beyond the domain, where the table has a margin, the factor is cut.
BedSpline<2> tabulated(const Scene& scene) {
  const auto inside = [&](double x, double y) {
    return x >= scene.domain.low[0] && x <= scene.domain.high[0] && y >= scene.domain.low[1] &&
           y <= scene.domain.high[1];
  };
  return {[&](double x, double y) {
            const double factor = scene.fpm->grading(x, y);
            if (inside(x, y) && !(factor >= least && factor <= most))
              throw SceneError("fpm.grading is " + std::to_string(factor) + " at (" + std::to_string(x) +
                               ", " + std::to_string(y) +
                               ") m; it must be between 1 and 4, times water.spacing, the finest");
            return std::clamp(factor, least, most);
          },
          lattice_of(scene)};
}

}  // namespace

Grading::Grading(const Scene& scene)
    : factor_(tabulated(scene)), spacing_(scene.water.spacing), support_(scene.fpm->support) {}

void Grading::size(FieldSet& points) const {
  const VecField<double, 2> x{points.real("x"), points.real("y")};
  const Field<double> dx = points.real("dx"), h = points.real("h");
  const BedSpline<2> factor = factor_;
  const double spacing = spacing_, support = support_;
  launch(
      "fpm::size", Range(0, points.size()), KOKKOS_LAMBDA(int i) {
        dx(i) = spacing * clamp(factor.sloped_at(at(x, i)).b, least, most);
        h(i) = support * dx(i);
      });
}

}  // namespace freshet::fpm
