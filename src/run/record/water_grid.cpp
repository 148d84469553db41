#include "src/run/record/water_grid.hpp"

#include <cmath>

#include "src/io/fluid.hpp"

namespace freshet {
namespace {

VecField<double, 1> vector_field(const FieldSet& f, const char* x, const char*, Vec<double, 1>) { return {f.real(x)}; }
VecField<double, 2> vector_field(const FieldSet& f, const char* x, const char* y, Vec<double, 2>) { return {f.real(x), f.real(y)}; }

template <int D>
SortedWater<D> sorted_water(const Method& method) {
  const FieldSet& f = method.fields();
  const Vec<double, D> dimension;
  const auto* kind = find_integer(f, "kind");
  return {method.rows(), vector_field(f, "x", "y", dimension), vector_field(f, "u", "v", dimension),
          f.real("mass"), f.real("depth"), f.real("h"), kind ? kind->data : Field<int>()};
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
  return method.dimension() == 1 ? cover_cells(grid, sorted_water<1>(method)) : cover_cells(grid, sorted_water<2>(method));
}

Front track_maxima(const CellGrid& grid, const Method& method, double t, const Maxima& maxima) {
  return method.dimension() == 1 ? track_maxima(grid, sorted_water<1>(method), t, maxima)
                                 : track_maxima(grid, sorted_water<2>(method), t, maxima);
}

std::vector<double> depth_on_grid(const CellGrid& grid, const Method& method) {
  const CoverFields sums = cover_cells(grid, method);
  const auto cover = on_host(sums.cover), depth = on_host(sums.depth);
  std::vector<double> values(static_cast<std::size_t>(grid.size()));
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = smeared_depth(cover(k), depth(k));
  return values;
}

}  // namespace freshet
