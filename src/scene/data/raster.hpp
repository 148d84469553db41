// A regular lattice of bed levels and the readers that give one: ESRI ASCII grids here, x-y-z points in
// points.hpp.
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "src/scene/scene.hpp"

namespace freshet::input {

// Levels at the nodes x0 + i dx, y0 + j dy [m]; NaN = no value. Bilinear between the nodes; beyond the edge
// the last cell goes on linearly for up to `margin` cells and then constantly: enough for the lattice around
// a domain.
struct Raster {
  static constexpr int margin = 8;  // cells
  double x0 = 0, y0 = 0, dx = 1, dy = 1;
  int nx = 0, ny = 0;
  std::vector<double> z;  // row by row, lowest y first

  double& at(int i, int j) { return z[static_cast<std::size_t>(j) * nx + i]; }
  double at(int i, int j) const { return z[static_cast<std::size_t>(j) * nx + i]; }
  double level(double x, double y) const;
};

enum class Registration { node, cell };

// An ESRI ASCII grid. xllcorner headers need the registration: cell-registered values sit half a cell inside
// the corner, node-registered ones on it. xllcenter headers name the first value's place. Throws BadData:
// header or count of values inconsistent, with file:line.
struct AsciiGrid {
  Raster raster;
  bool corner = false;  // xllcorner: registration decides
};
AsciiGrid read_ascii_grid(const std::string& path, const std::string& text,
                          std::optional<Registration> registration);
bool looks_like_ascii_grid(const std::string& text);

// The part of the raster within `reach` [m], and at least `Raster::margin` cells, of the box; at least 2 x 2
// nodes.
Raster cropped(const Raster& raster, const Domain& domain, double reach);

// Nodes without a value, and the first of them (highest row first, as in the file).
struct Gaps {
  int count = 0;
  Point first{};
};
Gaps find_gaps(const Raster& raster);

}  // namespace freshet::input
