#include "tests/support/watch/scratch.hpp"

#include <unistd.h>

namespace freshet::test {

Scratch::Scratch() {
  static int count = 0;
  const std::string name = "freshet-test-" + std::to_string(::getpid()) + "-" + std::to_string(++count);
  path_ = std::filesystem::temp_directory_path() / name;
  std::filesystem::create_directories(path_);
}

Scratch::~Scratch() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace freshet::test
