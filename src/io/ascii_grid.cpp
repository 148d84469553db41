#include "src/io/ascii_grid.hpp"

#include <cmath>
#include <cstdio>

#include "src/io/files.hpp"
#include "src/text.hpp"

namespace freshet {

void write_ascii_grid(const std::string& path, const CellGrid& grid,
                      const std::function<double(std::size_t)>& value) {
  std::string text = "ncols " + std::to_string(grid.nx) + "\nnrows " + std::to_string(grid.ny) +
                     "\nxllcorner " + shortest(grid.x0 - 0.5 * grid.dx) + "\nyllcorner " +
                     shortest(grid.y0 - 0.5 * grid.dy) + "\ncellsize " + shortest(grid.dx) +
                     "\nNODATA_value " + shortest(no_value) + '\n';
  char number[32];
  for (int j = grid.ny - 1; j >= 0; --j)
    for (int i = 0; i < grid.nx; ++i) {
      const double v = value(static_cast<std::size_t>(j) * static_cast<std::size_t>(grid.nx) +
                             static_cast<std::size_t>(i));
      const int length = std::snprintf(number, sizeof number, "%.6g%c", std::isfinite(v) ? v : no_value,
                                       i + 1 < grid.nx ? ' ' : '\n');
      text.append(number, static_cast<std::size_t>(length));
    }
  write_text(path, text);
}

}  // namespace freshet
