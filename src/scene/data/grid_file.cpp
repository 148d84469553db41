#include "src/scene/data/grid_file.hpp"

#include "src/scene/data/files.hpp"

namespace freshet::input {

std::optional<Registration> read_registration(Table& section) {
  return section
      .choice<Registration>("registration", {{"node", Registration::node}, {"cell", Registration::cell}})
      .optional();
}

Raster load_grid(Table& section, const std::string& path, const std::string& text,
                 std::optional<Registration> registration) {
  AsciiGrid grid = read_ascii_grid(path, text, registration);
  if (grid.corner && !registration && !section.has("registration"))
    section.context().diagnostics.error(
        section.place_of("file"),
        "'" + file_name(path) + "' has an xllcorner header: say where its values lie, '" +
            section.path_of("registration") + "' is missing",
        "registration = \"cell\": in the middle of the cells (GIS rasters); \"node\": on the corner itself");
  return std::move(grid.raster);
}

}  // namespace freshet::input
