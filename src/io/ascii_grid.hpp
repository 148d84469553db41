// ESRI ASCII grids, which GIS programs open.
#pragma once
#include <functional>
#include <string>

#include "kernels/water/raster.hpp"

namespace freshet {

constexpr double no_value = -9999;  // NODATA_value

// Cell-registered, square cells (grid.dx = grid.dy), six digits; value(k) with x fastest, NaN = no value.
// Through a temporary file; throws IoError.
void write_ascii_grid(const std::string& path, const CellGrid& grid,
                      const std::function<double(std::size_t)>& value);

}  // namespace freshet
