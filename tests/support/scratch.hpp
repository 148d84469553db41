// A directory of its own for a test, removed at the end.
#pragma once
#include <unistd.h>

#include <filesystem>
#include <string>

namespace freshet::test {

class Scratch {
 public:
  Scratch() {
    static int count = 0;
    const std::string name = "freshet-test-" + std::to_string(::getpid()) + "-" + std::to_string(++count);
    path_ = std::filesystem::temp_directory_path() / name;
    std::filesystem::create_directories(path_);
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  std::string path() const { return path_.string(); }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace freshet::test
