// Grids over a scene's domain, and a method's fluid as the raster kernels want it.
#pragma once
#include <vector>

#include "kernels/water/raster.hpp"
#include "src/methods/method.hpp"

namespace freshet {

// Cells of about the given size that fill the domain exactly.
CellGrid fitted_grid(const Domain& domain, const std::array<double, 2>& cell);
// Square cells that cover the domain, from its low corner on.
CellGrid square_grid(const Domain& domain, double cell);

CoverFields cover_cells(const CellGrid& grid, const Method& method);
Front track_maxima(const CellGrid& grid, const Method& method, double t, const Maxima& maxima);

// smeared_depth() at the centres, x fastest [m].
std::vector<double> depth_on_grid(const CellGrid& grid, const Method& method);

}  // namespace freshet
