#include "src/scene/data/series.hpp"

#include <algorithm>
#include <numeric>

#include "src/scene/data/files.hpp"
#include "src/scene/toml/table.hpp"

namespace freshet::input {
namespace {

struct Row {
  int line;
  std::vector<std::string> cells;
};

struct Sheet {
  std::vector<std::string> header;  // empty = none
  std::vector<Row> rows;
};

bool any_number(const std::vector<std::string>& cells) {
  double number;
  return std::any_of(cells.begin(), cells.end(),
                     [&](const std::string& cell) { return parse_number(cell, number); });
}

// Names may hold blanks ("water surface(m)"): where the blanks give another count than the data, two blanks
// separate.
std::vector<std::string> split_header(const std::string& line, std::size_t columns) {
  std::vector<std::string> cells = split_cells(line);
  if (cells.size() <= columns || line.find_first_of(",;\t") != std::string::npos) return cells;
  std::string marked;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool run =
        line[i] == ' ' && ((i + 1 < line.size() && line[i + 1] == ' ') || (i > 0 && line[i - 1] == ' '));
    marked += run ? '\t' : line[i];
  }
  cells = split_cells(marked);
  cells.erase(std::remove(cells.begin(), cells.end(), ""), cells.end());
  return cells;
}

Sheet read_sheet(const std::string& path) {
  Sheet sheet;
  std::string header;
  for_each_line(read_text(path), [&](int number, const std::string& line) {
    if (is_comment_or_empty(line)) return;
    std::vector<std::string> cells = split_cells(line);
    const bool is_header = header.empty() && sheet.rows.empty() && !any_number(cells);
    if (is_header) header = line;
    else if (!cells.empty()) sheet.rows.push_back({number, std::move(cells)});
  });
  if (sheet.rows.empty()) throw BadData("'" + file_name(path) + "' holds no numbers");
  if (!header.empty()) sheet.header = split_header(header, sheet.rows.front().cells.size());
  return sheet;
}

std::size_t index_of(const SeriesColumn& column, const Sheet& sheet, const std::string& path, bool is_time) {
  const std::string shown = file_name(path);
  if (column.number > 0) {
    const std::size_t count = sheet.rows.front().cells.size();
    if (static_cast<std::size_t>(column.number) <= count) return column.number - 1;
    throw NoSuchColumn{is_time, "'" + shown + "' has no column " + std::to_string(column.number),
                       "it has " + counted(count, "column") + ", counted from 1"};
  }
  const auto found = std::find(sheet.header.begin(), sheet.header.end(), column.name);
  if (found != sheet.header.end()) return found - sheet.header.begin();
  std::string help = sheet.header.empty()
                         ? "the file has no header line: give the column's number, counted from 1"
                         : did_you_mean(column.name, sheet.header);
  if (help.empty()) help = "its columns are " + listed(sheet.header);
  throw NoSuchColumn{is_time, "'" + shown + "' has no column '" + column.name + "'", help};
}

struct SheetColumns {
  std::size_t t, value;
};

SheetColumns find_columns(const SeriesFile& file, const Sheet& sheet) {
  return {index_of(file.t, sheet, file.path, true), index_of(file.value, sheet, file.path, false)};
}

bool read_row(const Row& row, const SheetColumns& columns, double& t, double& value) {
  return columns.t < row.cells.size() && columns.value < row.cells.size() &&
         parse_number(row.cells[columns.t], t) && parse_number(row.cells[columns.value], value);
}

void add(Series& series, const SeriesFile& file, double t, double value) {
  series.t.push_back(t * file.t_scale + file.t_offset);
  series.value.push_back(value * file.scale + file.offset);
}

// The first cell of a row without numbers, and what to do about it.
BadData bad_cell(const SeriesFile& file, const Row& row, const SheetColumns& columns) {
  double number;
  std::size_t i = columns.t;
  if (i < row.cells.size() && parse_number(row.cells[i], number)) i = columns.value;
  const std::string where = at_line(file.path, row.line) + ": column " + std::to_string(i + 1);
  if (i >= row.cells.size()) return BadData(where + " is missing", "complete the row or remove it");
  const bool comma = row.cells[i].find(',') != std::string::npos;
  return BadData(where + " holds '" + row.cells[i] + "', not a number",
                 comma ? "write decimals with a point" : "write a number there or remove the row");
}

Series sorted(const Series& series, const std::string& path, std::vector<std::string>& notes) {
  std::vector<std::size_t> order(series.t.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto earlier = [&](std::size_t a, std::size_t b) { return series.t[a] < series.t[b]; };
  const bool was_sorted = std::is_sorted(order.begin(), order.end(), earlier);
  std::stable_sort(order.begin(), order.end(), earlier);
  Series out;
  for (const std::size_t i : order) {
    if (!out.t.empty() && series.t[i] == out.t.back()) continue;
    out.t.push_back(series.t[i]);
    out.value.push_back(series.value[i]);
  }
  const std::size_t repeated = series.t.size() - out.t.size();
  if (!was_sorted) notes.push_back(file_name(path) + ": rows sorted");
  if (repeated > 0) {
    notes.push_back(file_name(path) + ": " + counted(repeated, "row") +
                    " with a repeated time or place left out");
  }
  return out;
}

Value<SeriesColumn> column(Table& table, const std::string& key, SeriesColumn fallback) {
  if (table.has_text(key)) {
    const std::string name = table.text(key).required();
    return {Slot{&table.context(), table.path_of(key), table.place_of(key), true, nullptr},
            SeriesColumn{0, name}};
  }
  const int number = table.integer(key).at_least(1).otherwise(fallback.number);
  return {Slot{&table.context(), table.path_of(key), table.place_of(key), true, nullptr},
          SeriesColumn{number, ""}};
}

}  // namespace

Series read_forcing(const SeriesFile& file) {
  const Sheet sheet = read_sheet(file.path);
  const SheetColumns columns = find_columns(file, sheet);
  Series series;
  for (const Row& row : sheet.rows) {
    double t, value;
    if (!read_row(row, columns, t, value)) throw bad_cell(file, row, columns);
    add(series, file, t, value);
    const std::size_t n = series.t.size();
    if (n > 1 && !(series.t[n - 1] > series.t[n - 2])) {
      throw BadData(at_line(file.path, row.line) + ": time " + shown(series.t[n - 1]) + " s follows " +
                        shown(series.t[n - 2]) + " s; times must increase strictly",
                    "sort the rows and remove repeated times");
    }
  }
  return series;
}

Series read_measured(const SeriesFile& file, std::vector<std::string>& notes) {
  const Sheet sheet = read_sheet(file.path);
  const SheetColumns columns = find_columns(file, sheet);
  Series series;
  std::size_t left_out = 0;
  for (const Row& row : sheet.rows) {
    double t, value;
    if (!read_row(row, columns, t, value)) {
      ++left_out;
      continue;
    }
    add(series, file, t, value);
  }
  if (series.t.empty()) throw bad_cell(file, sheet.rows[0], columns);
  if (left_out > 0) {
    notes.push_back(file_name(file.path) + ": " + counted(left_out, "row") + " without numbers left out");
  }
  return sorted(series, file.path, notes);
}

Series read_series(Table& table, SeriesUse use, const std::string& abscissa) {
  SeriesFile file;
  Value<std::string> path = table.file("file");
  Value<SeriesColumn> t = column(table, abscissa, file.t), value = column(table, "value", file.value);
  file.path = path.required();
  file.t = *t.optional();
  file.value = *value.optional();
  file.t_scale = table.number(abscissa + "_scale").positive().otherwise(file.t_scale);
  file.t_offset = table.number(abscissa + "_offset").otherwise(file.t_offset);
  file.scale = table.number("scale").otherwise(1);
  file.offset = table.number("offset").otherwise(0);
  if (file.path.empty()) return {};
  try {
    return use == SeriesUse::forcing ? read_forcing(file) : read_measured(file, table.context().notes);
  } catch (const BadData& bad) {
    path.fail(bad.what(), bad.help, Blame::data);
  } catch (const NoSuchColumn& none) { (none.is_time ? t : value).fail(none.message, none.help); }
  return {};
}

}  // namespace freshet::input
