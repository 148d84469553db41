// Series of time from text files: `{ file = "wave.txt", t = 1, value = "eta", scale = 0.01, offset = 0 }`.
// Columns by number (from 1) or by name (header line); commas, semicolons, tabs or blanks; BOM, CRLF,
// trailing separators, empty lines and # comments are accepted. value = column * scale + offset [SI].
#pragma once
#include <string>
#include <vector>

#include "src/scene/scene.hpp"

namespace freshet::input {

class Table;

struct SeriesColumn {
  int number = 0;  // from 1; 0 = by name
  std::string name;
};

struct SeriesFile {
  std::string path;
  SeriesColumn t{1, ""}, value{2, ""};
  double t_scale = 1, t_offset = 0;  // s per unit of the column, s
  double scale = 1, offset = 0;
};

// No column of that name or number; told apart because the scene is at fault.
struct NoSuchColumn {
  bool is_time;
  std::string message, help;
};

// Forcing: times must increase strictly and every row must hold numbers. Throws BadData, NoSuchColumn.
Series read_forcing(const SeriesFile& file);
// Measured: rows without numbers are left out, rows are sorted by time and repeated times dropped, each with
// a note.
Series read_measured(const SeriesFile& file, std::vector<std::string>& notes);

// The section `{ file, t, value, t_scale, t_offset, scale, offset }`; empty series after an error, which is
// reported. A series over a place has `x` for `t`.
enum class SeriesUse { forcing, measured };
Series read_series(Table& table, SeriesUse use, const std::string& abscissa = "t");

}  // namespace freshet::input
