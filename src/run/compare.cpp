#include "src/run/compare.hpp"

#include <algorithm>
#include <cmath>

#include "src/reference/exact.hpp"

namespace freshet {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double least_cover = 0.95;  // of sum V W: below it a cell is at the edge of the water, and the mean would spread it

// Whether the place counts in the errors.
bool counts(const Scene& scene, double x, double y) {
  return !scene.compare.where || scene.compare.where(x, y) != 0;
}

double exact_depth(const Scene& scene, double x, double y, double t) {
  return std::max(0.0, scene.compare.exact->at(x, y, t).depth);
}

// Cubic spline of SWE-FORMULAS, w(q) / h^D.
double cubic_spline(double q, double h, int dimension) {
  const double w = q <= 1 ? 2.0 / 3 - q * q + q * q * q / 2 : q < 2 ? (2 - q) * (2 - q) * (2 - q) / 6 : 0;
  return dimension == 1 ? w / h : 15 / (7 * pi) * w / (h * h);
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

struct Span {
  int first, last;  // cells, empty if first > last
};

// The cells whose centre is within `reach` of `at`.
Span cells_within(double at, double reach, double low, double cell, int count) {
  const double first = std::ceil((at - reach - low) / cell - 0.5),
               last = std::floor((at + reach - low) / cell - 0.5);
  return {static_cast<int>(std::max(first, 0.0)), static_cast<int>(std::min(last, count - 1.0))};
}

struct Sums {
  std::vector<double> mass, volume;  // sum m W [m], sum V W [1]
};

void scatter(const Grid& grid, int dimension, const Fluid& fluid, std::size_t k, Sums& sums) {
  const double h = fluid.h[k], reach = 2 * h;
  const Span in_x = cells_within(fluid.x[k], reach, grid.low[0], grid.cell[0], grid.count[0]);
  const Span in_y =
      dimension == 1 ? Span{0, 0} : cells_within(fluid.y[k], reach, grid.low[1], grid.cell[1], grid.count[1]);
  for (int j = in_y.first; j <= in_y.last; ++j) {
    for (int i = in_x.first; i <= in_x.last; ++i) {
      const double dy = dimension == 1 ? 0 : grid.y(j) - fluid.y[k];
      const double w = cubic_spline(std::hypot(grid.x(i) - fluid.x[k], dy) / h, h, dimension);
      const auto cell =
          static_cast<std::size_t>(j) * static_cast<std::size_t>(grid.count[0]) + static_cast<std::size_t>(i);
      sums.mass[cell] += fluid.mass[k] * w;
      sums.volume[cell] += fluid.mass[k] / fluid.depth[k] * w;
    }
  }
}

}  // namespace

ErrorNorms error_norms(const Scene& scene, const Fluid& fluid, double t) {
  ErrorNorms errors = particle_errors(scene, fluid, t);
  errors.depth_l1_rel = depth_l1(scene, fluid, t);
  errors.grid_l2_rel = grid_l2(scene, fluid, t);
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

Grid comparison_grid(const Scene& scene) {
  constexpr int cells_per_side = 200;
  Grid grid;
  grid.low = scene.domain.low;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(scene.domain.dimension); ++axis) {
    const double length = scene.domain.high[axis] - scene.domain.low[axis];
    const double cell = scene.compare.grid_spacing.value_or(length / cells_per_side);
    grid.count[axis] = std::max(1, static_cast<int>(std::lround(length / cell)));
    grid.cell[axis] = length / grid.count[axis];
  }
  return grid;
}

std::vector<double> depth_on_grid(const Grid& grid, int dimension, const Fluid& fluid) {
  const auto cells = static_cast<std::size_t>(grid.count[0]) * static_cast<std::size_t>(grid.count[1]);
  Sums sums{std::vector<double>(cells), std::vector<double>(cells)};
  for (std::size_t k = 0; k < fluid.size(); ++k) {
    if (fluid.depth[k] > 0 && fluid.h[k] > 0) scatter(grid, dimension, fluid, k, sums);
  }
  for (std::size_t c = 0; c < cells; ++c) sums.mass[c] /= std::max(sums.volume[c], least_cover);
  return sums.mass;
}

double grid_l2(const Scene& scene, const Fluid& fluid, double t) {
  const Grid grid = comparison_grid(scene);
  const auto depth = depth_on_grid(grid, scene.domain.dimension, fluid);
  double difference2 = 0, exact2 = 0;
  std::size_t cell = 0;
  for (int j = 0; j < grid.count[1]; ++j) {
    for (int i = 0; i < grid.count[0]; ++i, ++cell) {
      if (!counts(scene, grid.x(i), grid.y(j))) continue;
      const double exact = exact_depth(scene, grid.x(i), grid.y(j), t);
      difference2 += (depth[cell] - exact) * (depth[cell] - exact);
      exact2 += exact * exact;
    }
  }
  return exact2 > 0 ? std::sqrt(difference2 / exact2) : unknown;
}

}  // namespace freshet
