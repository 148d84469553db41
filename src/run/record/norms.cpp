#include "src/run/record/norms.hpp"

#include <algorithm>
#include <cmath>

#include "src/reference/exact.hpp"

namespace freshet {
namespace {

// Whether the place counts in the errors.
bool counts(const Scene& scene, double x, double y) {
  return !scene.compare.where || scene.compare.where(x, y) != 0;
}

double exact_depth(const Scene& scene, double x, double y, double t) {
  return std::max(0.0, scene.compare.exact->at(x, y, t).depth);
}

// The sums of thesis (2.58) and (2.59).
struct RelativeSquares {
  double depth = 0, u = 0, v = 0, count = 0;  // 1, m/s2, m/s2
  void add(double difference, double du, double dv, double exact_depth) {
    depth += difference * difference / (exact_depth * exact_depth);
    u += du * du / exact_depth;
    v += dv * dv / exact_depth;
    ++count;
  }
  void finish(double gravity, ErrorNorms& errors) const {
    if (count == 0) return;
    errors.depth_l2_mean_rel = std::sqrt(depth / count);
    errors.velocity_l2_x = std::sqrt(u / (count * gravity));
    errors.velocity_l2_y = std::sqrt(v / (count * gravity));
  }
};

}  // namespace

ErrorNorms error_norms(const Scene& scene, const Fluid& fluid, double t) {
  ErrorNorms errors = particle_errors(scene, fluid, t);
  errors.depth_l1_rel = depth_l1(scene, fluid, t);
  return errors;
}

ErrorNorms particle_errors(const Scene& scene, const Fluid& fluid, double t) {
  double difference2 = 0, exact2 = 0, velocity2 = 0, largest = 0, count = 0;
  RelativeSquares relative;
  for (std::size_t k = 0; k < fluid.size(); ++k) {
    if (!counts(scene, fluid.x[k], fluid.y[k])) continue;
    const FlowState exact = scene.compare.exact->at(fluid.x[k], fluid.y[k], t);
    const double depth = std::max(0.0, exact.depth), difference = fluid.depth[k] - depth;
    const double du = fluid.u[k] - exact.u, dv = fluid.v[k] - exact.v;
    ++count;
    difference2 += difference * difference;
    exact2 += depth * depth;
    velocity2 += du * du + dv * dv;
    largest = std::max(largest, std::abs(difference));
    if (depth > scene.compare.threshold) relative.add(difference, du, dv, depth);
  }
  ErrorNorms errors;
  relative.finish(scene.gravity, errors);
  if (exact2 > 0) errors.depth_l2_rel = std::sqrt(difference2 / exact2);
  if (count > 0) errors.velocity_l2 = std::sqrt(velocity2 / count);
  errors.depth_linf = largest;
  return errors;
}

double depth_l1(const Scene& scene, const Fluid& fluid, double t) {
  double sum = 0;
  int count = 0;
  for (std::size_t k = 0; k < fluid.size(); ++k) {
    const double exact = exact_depth(scene, fluid.x[k], fluid.y[k], t);
    if (exact <= scene.compare.threshold || !counts(scene, fluid.x[k], fluid.y[k])) continue;
    sum += std::abs(fluid.depth[k] - exact) / exact;
    ++count;
  }
  return count ? sum / count : unknown;
}

double median(std::vector<double> values) {
  if (values.empty()) return unknown;
  std::sort(values.begin(), values.end());
  const auto middle = values.size() / 2;
  return values.size() % 2 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

CellGrid comparison_grid(const Scene& scene) {
  constexpr int cells_per_side = 200;
  std::array<double, 2> cell{1, 1};
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(scene.domain.dimension); ++axis)
    cell[axis] = scene.compare.grid_spacing.value_or((scene.domain.high[axis] - scene.domain.low[axis]) /
                                                     cells_per_side);
  return fitted_grid(scene.domain, cell);
}

double grid_l2(const Scene& scene, const Method& method, double t) {
  const CellGrid grid = comparison_grid(scene);
  const auto depth = depth_on_grid(grid, method);
  double difference2 = 0, exact2 = 0;
  std::size_t cell = 0;
  for (int j = 0; j < grid.ny; ++j) {
    for (int i = 0; i < grid.nx; ++i, ++cell) {
      if (!counts(scene, grid.x(i), grid.y(j))) continue;
      const double exact = exact_depth(scene, grid.x(i), grid.y(j), t);
      difference2 += (depth[cell] - exact) * (depth[cell] - exact);
      exact2 += exact * exact;
    }
  }
  return exact2 > 0 ? std::sqrt(difference2 / exact2) : unknown;
}

}  // namespace freshet
