// gauges.csv: one row per gauge time with what each gauge shows, in its unit, and a dry mark (1 = dry);
// flushed after each row. Numbers have the shortest digits that read back to the same bits. Failures are
// IoError.
#pragma once
#include <fstream>
#include <string>
#include <vector>

#include "src/scene/scene.hpp"

namespace freshet {

struct GaugeRow {
  double t = 0;  // s
  // in the unit of each gauge's measurand; of an elevation the bed's level where dry
  std::vector<double> value;
  std::vector<bool> dry;
};

class GaugeFile {
 public:
  explicit GaugeFile(std::string path) : path_(std::move(path)) {}

  void create(const std::vector<Gauge>& gauges);
  // Cuts the file after so many rows and returns them; later rows are appended. Throws if there are fewer.
  std::vector<GaugeRow> continue_after(std::size_t rows);
  void append(const GaugeRow& row);

 private:
  void write(const std::string& line);

  std::string path_;
  std::ofstream file_;
};

// measured.csv: the measured series of all gauges over the union of their times; blank where a gauge has no
// value. Writes nothing if no gauge has one.
void write_measured(const std::string& path, const std::vector<Gauge>& gauges);

}  // namespace freshet
