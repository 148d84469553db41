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

// Absolute path of a file below $FRESHET_DATA or data/ of the checkout; where it is missing the test says so
// and is skipped.
std::optional<std::string> data_file(const std::string& name);

// The rows of a file that consist of numbers alone (NaN is one), parted by commas or blanks; other lines are
// passed over.
std::vector<std::vector<double>> number_rows(const std::string& path);

}  // namespace freshet::test
