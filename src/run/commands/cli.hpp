// The command line. Exit codes as in src/errors.hpp.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "src/methods/method.hpp"

namespace freshet {

// Where scenes and methods come from: the real ones, or a test's.
struct Parts {
  std::function<Scene(const std::string& path, const std::vector<std::string>& overrides)> read;
  // The text that read() left in Scene::text; `path` is the scene's file, to which data files are relative.
  std::function<Scene(const std::string& text, const std::string& path)> read_again;
  std::function<std::unique_ptr<Method>(const Scene&)> make;
  std::function<std::vector<std::string>(const Scene&)> describe;
};

int run_cli(int argc, char** argv, const Parts& parts);
int run_cli(int argc, char** argv);

}  // namespace freshet
