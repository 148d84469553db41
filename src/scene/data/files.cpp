#include "src/scene/data/files.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace freshet::input {
namespace fs = std::filesystem;
namespace {

bool ends_with(const std::string& name, const std::string& ending) {
  return name.size() >= ending.size() &&
         name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
}

void refuse_binary_formats(const std::string& path) {
  std::string name = path;
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  const std::string shown = file_name(path);
  for (const char* ending : {".gz", ".bz2", ".xz", ".zip", ".zst"}) {
    if (ends_with(name, ending)) throw BadData("'" + shown + "' is compressed", "unpack it first");
  }
  for (const char* ending : {".tif", ".tiff", ".nc"}) {
    if (!ends_with(name, ending)) continue;
    const std::string out = shown.substr(0, shown.rfind('.')) + ".asc";
    throw BadData("'" + shown + "' is a GeoTIFF or NetCDF file, which Freshet does not read",
                  "convert it: gdal_translate -of AAIGrid " + shown + ' ' + out);
  }
}

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

}  // namespace

FoundFile find_file(const std::string& name, const fs::path& scene_directory) {
  std::vector<fs::path> places = {scene_directory};
  if (const char* data = std::getenv("FRESHET_DATA")) places.push_back(data);
#ifdef FRESHET_SOURCE_DIR
  places.push_back(fs::path(FRESHET_SOURCE_DIR) / "data");
#endif
  places.push_back("data");
  FoundFile found;
  for (const fs::path& place : places) {
    const fs::path path = place / name;  // an absolute name replaces the place
    std::error_code error;
    if (fs::is_regular_file(path, error)) return {fs::absolute(path).lexically_normal().string(), ""};
    const std::string shown = place.empty() ? "." : place.string();
    found.looked += (found.looked.empty() ? "looked in " : ", ") + shown;
  }
  for (const fs::path& place : places) {
    for (const char* ending : {".gz", ".bz2", ".xz", ".zip"}) {
      std::error_code error;
      const std::string packed = (place / name).string() + ending;
      if (fs::is_regular_file(packed, error)) return {"", "there is " + packed + ": unpack it first"};
    }
  }
  if (fs::path(name).is_absolute()) found.looked.clear();
  else if (!std::getenv("FRESHET_DATA"))
    found.looked += "; set FRESHET_DATA to the directory that holds the data";
  return found;
}

std::string read_text(const std::string& path) {
  refuse_binary_formats(path);
  std::ifstream in(path, std::ios::binary);
  if (!in) throw BadData("cannot open '" + path + "'");
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (text.compare(0, 3, "\xEF\xBB\xBF") == 0) text.erase(0, 3);
  if (text.compare(0, 2, "\xFF\xFE") == 0 || text.compare(0, 2, "\xFE\xFF") == 0) {
    throw BadData("'" + file_name(path) + "' is in UTF-16", "save it as UTF-8 or plain ASCII");
  }
  if (text.find('\n') == std::string::npos)
    std::replace(text.begin(), text.end(), '\r', '\n');  // old Macintosh
  text.erase(std::remove(text.begin(), text.end(), '\r'), text.end());
  return text;
}

std::vector<std::string> split_cells(const std::string& line) {
  const auto has = [&line](char c) { return line.find(c) != std::string::npos; };
  const char separator = has(';') ? ';' : has(',') ? ',' : has('\t') ? '\t' : ' ';
  std::vector<std::string> cells;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(separator, begin), line.size());
    std::string cell = trimmed(line.substr(begin, end - begin));
    // Blanks come in runs and at the start; an empty cell between tabs or commas is a missing value.
    if (!cell.empty() || separator == ',' || separator == ';' || (separator == '\t' && !cells.empty())) {
      cells.push_back(std::move(cell));
    }
    begin = end + 1;
  }
  while (!cells.empty() && cells.back().empty()) cells.pop_back();
  return cells;
}

bool parse_number(const std::string& cell, double& number) {
  const char* begin = cell.data() + (!cell.empty() && cell[0] == '+' ? 1 : 0);
  const char* end = cell.data() + cell.size();
  const auto result = std::from_chars(begin, end, number);
  return result.ec == std::errc() && result.ptr == end && std::isfinite(number);
}

std::string file_name(const std::string& path) { return fs::path(path).filename().string(); }

std::string at_line(const std::string& path, int line) {
  return file_name(path) + ':' + std::to_string(line);
}

bool is_comment_or_empty(const std::string& line) {
  const std::size_t first = line.find_first_not_of(" \t");
  return first == std::string::npos || line[first] == '#';
}

}  // namespace freshet::input
