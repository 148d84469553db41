#include "src/io/gauges.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <map>
#include <sstream>

#include "src/errors.hpp"
#include "src/io/files.hpp"
#include "src/text.hpp"

namespace freshet {
namespace {

GaugeRow parse(const std::string& line) {
  GaugeRow row;
  const char* at = line.c_str();
  char* end = nullptr;
  row.t = std::strtod(at, &end);
  while (*end == ',') {
    row.value.push_back(std::strtod(end + 1, &end));
    row.dry.push_back(*end == ',' && std::strtol(end + 1, &end, 10) != 0);
  }
  return row;
}

std::string text_of(const GaugeRow& row) {
  std::string line = shortest(row.t);
  for (std::size_t g = 0; g < row.value.size(); ++g) {
    line += ',' + shortest(row.value[g]) + (row.dry[g] ? ",1" : ",0");
  }
  return line;
}

std::string title(const Gauge& gauge) {
  const Measurand& shown = gauge.measurand();
  return gauge.name + ' ' + shown.name + " [" + shown.unit + ']';
}

}  // namespace

void GaugeFile::create(const std::vector<Gauge>& gauges) {
  file_.open(path_, std::ios::binary | std::ios::trunc);
  std::string header = "t [s]";
  for (const auto& gauge : gauges)
    header += ',' + csv_word(title(gauge)) + ',' + csv_word(gauge.name + " dry");
  write(header);
}

std::vector<GaugeRow> GaugeFile::continue_after(std::size_t rows) {
  std::istringstream old(read_text(path_));
  std::string line, kept;
  std::getline(old, kept);
  kept += '\n';
  std::vector<GaugeRow> read;
  while (read.size() < rows && std::getline(old, line) && !old.eof()) {
    read.push_back(parse(line));
    kept += line + '\n';
  }
  if (read.size() < rows) {
    throw IoError(path_ + ": holds " + std::to_string(read.size()) + " rows, the checkpoint counts " +
                  std::to_string(rows) + "\n  help: the file was changed after the run; start the run anew");
  }
  write_text(path_, kept);
  file_.open(path_, std::ios::binary | std::ios::app);
  return read;
}

void GaugeFile::append(const GaugeRow& row) { write(text_of(row)); }

void GaugeFile::write(const std::string& line) {
  errno = 0;
  file_ << line << '\n' << std::flush;
  if (!file_) {
    throw IoError(path_ + ": cannot be written: " + std::strerror(errno) +
                  "\n  help: free some space, or choose another directory with --out");
  }
}

void write_measured(const std::string& path, const std::vector<Gauge>& gauges) {
  std::vector<const Gauge*> measured;
  for (const auto& gauge : gauges) {
    if (gauge.measured) measured.push_back(&gauge);
  }
  if (measured.empty()) return;
  std::map<double, std::vector<std::string>> rows;
  std::string text = "t [s]";
  for (std::size_t g = 0; g < measured.size(); ++g) {
    const Series& series = *measured[g]->measured;
    text += ',' + csv_word(measured[g]->name + " [" + measured[g]->measurand().unit + ']');
    for (std::size_t k = 0; k < series.t.size(); ++k) {
      auto& row = rows[series.t[k]];
      row.resize(measured.size());
      row[g] = shortest(series.value[k]);
    }
  }
  for (const auto& [t, values] : rows) {
    text += '\n' + shortest(t);
    for (const auto& value : values) text += ',' + value;
  }
  write_text(path, text + '\n');
}

}  // namespace freshet
