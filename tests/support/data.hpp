// Benchmark data for tests: found as a scene would find them, absent in a bare checkout.
#pragma once
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "build_info.hpp"

namespace freshet::test {

// Absolute path of a file below $FRESHET_DATA or data/ of the checkout; where it is missing the test says so and is skipped.
inline std::optional<std::string> data_file(const std::string& name) {
  const char* folder = std::getenv("FRESHET_DATA");
  for (const std::string& root : {std::string(folder ? folder : ""), std::string(build::source_dir) + "/data"})
    if (!root.empty() && std::filesystem::exists(root + "/" + name)) return root + "/" + name;
  std::printf("SKIPPED: %s: no data; set FRESHET_DATA\n", name.c_str());
  return std::nullopt;
}

// The rows of a file that consist of numbers alone (NaN is one), parted by commas or blanks; other lines are passed over.
inline std::vector<std::vector<double>> number_rows(const std::string& path) {
  std::ifstream in(path);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(in, line);) {
    for (char& c : line)
      if (c == ',' || c == '\r') c = ' ';
    std::vector<double> row;
    const char* at = line.c_str();
    for (char* end = nullptr;; at = end) {
      const double value = std::strtod(at, &end);
      if (end == at) break;
      row.push_back(value);
    }
    if (!row.empty() && std::string(at).find_first_not_of(" \t") == std::string::npos) rows.push_back(row);
  }
  return rows;
}

}  // namespace freshet::test
