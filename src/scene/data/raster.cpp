#include "src/scene/data/raster.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>

#include "src/scene/data/files.hpp"
#include "src/scene/toml/diagnostics.hpp"

namespace freshet::input {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

const std::vector<std::string>& header_names() {
  static const std::vector<std::string> names = {"ncols",     "nrows",       "xllcorner", "yllcorner",
                                                 "xllcenter", "yllcenter",   "cellsize",  "dx",
                                                 "dy",        "nodata_value"};
  return names;
}

std::string lower(std::string word) {
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
  return word;
}

bool is_header_name(const std::string& word) {
  return std::find(header_names().begin(), header_names().end(), lower(word)) != header_names().end();
}

struct Header {
  std::map<std::string, double> values;
  int last_line = 0;

  bool has(const std::string& name) const { return values.count(name) > 0; }
  double get(const std::string& name, const std::string& path) const {
    const auto found = values.find(name);
    if (found == values.end()) throw BadData(at_line(path, last_line) + ": the header has no '" + name + "'");
    return found->second;
  }
  int count(const std::string& name, const std::string& path) const {
    const double number = get(name, path);
    if (number == std::floor(number) && number >= 1 && number < 1e9) return static_cast<int>(number);
    throw BadData(at_line(path, last_line) + ": '" + name + "' must be a positive whole number");
  }
};

void read_header_line(const std::string& line, int number, const std::string& path, Header& header) {
  const std::vector<std::string> cells = split_cells(line);
  const std::string name = lower(cells[0]);
  double value = none;
  if (cells.size() != 2 || (!parse_number(cells[1], value) && lower(cells[1]) != "nan")) {
    throw BadData(at_line(path, number) + ": '" + name + "' must be followed by one number");
  }
  header.values[name] = value;
  header.last_line = number;
}

// Reads the numbers of a line; the fast path of a file with a million of them.
void read_levels(const std::string& line, int number, const std::string& path, std::vector<double>& levels) {
  const char* at = line.data();
  const char* end = at + line.size();
  while (true) {
    while (at < end && (*at == ' ' || *at == '\t' || *at == ',' || *at == '+')) ++at;
    if (at == end) return;
    double level;
    const auto result = std::from_chars(at, end, level);
    if (result.ec != std::errc()) {
      const std::string word(at, std::find_if(at, end, [](char c) { return c == ' ' || c == '\t'; }));
      const std::string help = is_header_name(word) ? "" : did_you_mean(word, header_names());
      throw BadData(at_line(path, number) + ": '" + word + "' is not a number", help);
    }
    levels.push_back(level);
    at = result.ptr;
  }
}

struct Values {
  std::vector<double> levels;
  int odd_line = 0, odd_count = 0, last_line = 0;  // first line whose count is not ncols, for the message
};

void check_count(const Values& values, int nx, int ny, const std::string& path) {
  const std::size_t wanted = static_cast<std::size_t>(nx) * ny;
  if (values.levels.size() == wanted) return;
  const int line = values.odd_line > 0 ? values.odd_line : values.last_line;
  std::string what = "the header promises " + std::to_string(nx) + " x " + std::to_string(ny) + " = " +
                     std::to_string(wanted) + " values, the file holds " +
                     std::to_string(values.levels.size());
  if (values.odd_line > 0) what += "; this line holds " + std::to_string(values.odd_count);
  throw BadData(at_line(path, line) + ": " + what);
}

// Corner of the lowest-left value along one axis.
double origin(const Header& header, const std::string& axis, double step,
              std::optional<Registration> registration, const std::string& path) {
  if (header.has(axis + "llcenter")) return header.get(axis + "llcenter", path);
  const double corner = header.get(axis + "llcorner", path);
  return registration == Registration::cell ? corner + 0.5 * step : corner;
}

Raster empty_raster(const Header& header, std::optional<Registration> registration, const std::string& path) {
  Raster raster;
  raster.nx = header.count("ncols", path);
  raster.ny = header.count("nrows", path);
  const bool square = header.has("cellsize") || !header.has("dx");
  raster.dx = header.get(square ? "cellsize" : "dx", path);
  raster.dy = header.get(square ? "cellsize" : "dy", path);
  if (!(raster.dx > 0 && raster.dy > 0))
    throw BadData(at_line(path, header.last_line) + ": the cell size is not positive");
  if (raster.nx < 2 || raster.ny < 2)
    throw BadData(at_line(path, header.last_line) + ": fewer than 2 x 2 values");
  raster.x0 = origin(header, "x", raster.dx, registration, path);
  raster.y0 = origin(header, "y", raster.dy, registration, path);
  return raster;
}

void fill(Raster& raster, const std::vector<double>& levels, double nodata) {
  raster.z.resize(levels.size());
  for (int j = 0; j < raster.ny; ++j) {
    for (int i = 0; i < raster.nx; ++i) {
      const double level = levels[static_cast<std::size_t>(raster.ny - 1 - j) * raster.nx + i];
      raster.at(i, j) = level == nodata || !std::isfinite(level) ? none : level;
    }
  }
}

}  // namespace

bool looks_like_ascii_grid(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\n");
  if (begin == std::string::npos) return false;
  return is_header_name(text.substr(begin, text.find_first_of(" \t\n", begin) - begin));
}

AsciiGrid read_ascii_grid(const std::string& path, const std::string& text,
                          std::optional<Registration> registration) {
  Header header;
  Values values;
  for_each_line(text, [&](int number, const std::string& line) {
    if (is_comment_or_empty(line)) return;
    const std::size_t first = line.find_first_not_of(" \t");
    if (values.levels.empty() &&
        is_header_name(line.substr(first, line.find_first_of(" \t", first) - first))) {
      read_header_line(line, number, path, header);
      return;
    }
    const std::size_t before = values.levels.size();
    read_levels(line, number, path, values.levels);
    const int count = static_cast<int>(values.levels.size() - before);
    values.last_line = number;
    if (values.odd_line == 0 && header.has("ncols") && count != header.values["ncols"]) {
      values.odd_line = number;
      values.odd_count = count;
    }
  });
  AsciiGrid grid;
  grid.corner = header.has("xllcorner");
  grid.raster = empty_raster(header, registration, path);
  check_count(values, grid.raster.nx, grid.raster.ny, path);
  fill(grid.raster, values.levels, header.has("nodata_value") ? header.values["nodata_value"] : -9999.0);
  return grid;
}

double Raster::level(double x, double y) const {
  const double limit = margin;
  const double u = std::clamp((x - x0) / dx, -limit, nx - 1 + limit);
  const double v = std::clamp((y - y0) / dy, -limit, ny - 1 + limit);
  const int i = std::clamp(static_cast<int>(std::floor(u)), 0, nx - 2);
  const int j = std::clamp(static_cast<int>(std::floor(v)), 0, ny - 2);
  const double a = u - i, b = v - j;
  return (1 - b) * ((1 - a) * at(i, j) + a * at(i + 1, j)) +
         b * ((1 - a) * at(i, j + 1) + a * at(i + 1, j + 1));
}

Raster cropped(const Raster& raster, const Domain& domain, double reach) {
  const auto range = [&](int axis, double origin_at, double step, int count) {
    const double low = (domain.low[axis] - origin_at) / step, high = (domain.high[axis] - origin_at) / step;
    const double margin = std::max(static_cast<double>(Raster::margin), reach / step);
    const double first = std::floor(std::clamp(low, 0.0, count - 2.0) - margin);
    const double last = std::ceil(std::clamp(high, 1.0, count - 1.0) + margin);
    return std::array<int, 2>{static_cast<int>(std::max(first, 0.0)),
                              static_cast<int>(std::min(last, count - 1.0))};
  };
  const auto columns = range(0, raster.x0, raster.dx, raster.nx);
  const auto rows = range(1, raster.y0, raster.dy, raster.ny);
  Raster part = raster;
  part.x0 = raster.x0 + columns[0] * raster.dx;
  part.y0 = raster.y0 + rows[0] * raster.dy;
  part.nx = columns[1] - columns[0] + 1;
  part.ny = rows[1] - rows[0] + 1;
  part.z.assign(static_cast<std::size_t>(part.nx) * part.ny, none);
  for (int j = 0; j < part.ny; ++j) {
    for (int i = 0; i < part.nx; ++i) part.at(i, j) = raster.at(columns[0] + i, rows[0] + j);
  }
  return part;
}

Gaps find_gaps(const Raster& raster) {
  Gaps gaps;
  for (int j = raster.ny - 1; j >= 0; --j) {
    for (int i = 0; i < raster.nx; ++i) {
      if (!std::isnan(raster.at(i, j))) continue;
      if (gaps.count++ == 0) gaps.first = {raster.x0 + i * raster.dx, raster.y0 + j * raster.dy};
    }
  }
  return gaps;
}

}  // namespace freshet::input
