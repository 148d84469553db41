// ESRI ASCII grids that a table of the scene names with the keys `file` and `registration`.
#pragma once
#include <string>

#include "src/scene/data/raster.hpp"
#include "src/scene/toml/table.hpp"

namespace freshet::input {

std::optional<Registration> read_registration(Table& section);

// Reads the grid's text; an xllcorner header without `registration` is reported at the key `file`. Throws
// BadData.
Raster load_grid(Table& section, const std::string& path, const std::string& text,
                 std::optional<Registration> registration);

}  // namespace freshet::input
