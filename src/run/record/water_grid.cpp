#include "src/run/record/water_grid.hpp"

#include <cmath>

namespace freshet {
namespace {

template <int D>
SortedWater<D> water_of(const Method& method) {
  return sorted_water<D>(method.rows(), method.fields());
}

}  // namespace

CellGrid fitted_grid(const Domain& domain, const std::array<double, 2>& cell) {
  const auto along = [&](int axis) {
    const double length = domain.high[axis] - domain.low[axis];
    return std::max(1, static_cast<int>(std::lround(length / cell[axis])));
  };
  CellGrid grid;
  grid.nx = along(0);
  grid.dx = (domain.high[0] - domain.low[0]) / grid.nx;
  grid.x0 = domain.low[0] + 0.5 * grid.dx;
  if (domain.dimension == 1) return grid;
  grid.ny = along(1);
  grid.dy = (domain.high[1] - domain.low[1]) / grid.ny;
  grid.y0 = domain.low[1] + 0.5 * grid.dy;
  return grid;
}

CellGrid square_grid(const Domain& domain, double cell) {
  const auto along = [&](int axis) {
    return std::max(1, static_cast<int>(std::ceil((domain.high[axis] - domain.low[axis]) / cell - 1e-9)));
  };
  CellGrid grid{domain.low[0] + 0.5 * cell, 0, cell, cell, along(0), 1};
  if (domain.dimension == 2) grid.y0 = domain.low[1] + 0.5 * cell, grid.ny = along(1);
  return grid;
}

CoverFields cover_cells(const CellGrid& grid, const Method& method) {
  if (method.dimension() == 1) return cover_cells(grid, water_of<1>(method));
  return cover_cells(grid, water_of<2>(method));
}

Front track_maxima(const CellGrid& grid, const Method& method, double t, const Maxima& maxima) {
  return method.dimension() == 1 ? track_maxima(grid, water_of<1>(method), t, maxima)
                                 : track_maxima(grid, water_of<2>(method), t, maxima);
}

std::vector<double> depth_on_grid(const CellGrid& grid, const Method& method) {
  const CoverFields sums = cover_cells(grid, method);
  const auto cover = on_host(sums.cover), depth = on_host(sums.depth);
  std::vector<double> values(static_cast<std::size_t>(grid.size()));
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = smeared_depth(cover(k), depth(k));
  return values;
}

}  // namespace freshet
