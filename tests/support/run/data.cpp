#include "tests/support/run/data.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "build_info.hpp"

namespace freshet::test {

std::optional<std::string> data_file(const std::string& name) {
  const char* folder = std::getenv("FRESHET_DATA");
  for (const std::string& root :
       {std::string(folder ? folder : ""), std::string(build::source_dir) + "/data"})
    if (!root.empty() && std::filesystem::exists(root + "/" + name)) return root + "/" + name;
  std::printf("SKIPPED: %s: no data; set FRESHET_DATA\n", name.c_str());
  return std::nullopt;
}

std::vector<std::vector<double>> number_rows(const std::string& path) {
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
