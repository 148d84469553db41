// Scenes and data files written by tests of the reader.
#pragma once
#include <unistd.h>

#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "src/errors.hpp"
#include "src/scene/read.hpp"

namespace freshet::test {

// A directory of its own, removed with its files.
class Directory {
 public:
  Directory() {
    static int count = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("freshet_scene_" + std::to_string(::getpid()) + '_' + std::to_string(++count));
    std::filesystem::create_directories(path_);
  }
  Directory(const Directory&) = delete;
  Directory& operator=(const Directory&) = delete;
  ~Directory() { std::filesystem::remove_all(path_); }

  std::string write(const std::string& name, const std::string& text) const {
    const std::filesystem::path file = path_ / name;
    std::ofstream(file, std::ios::binary) << text;
    return file.string();
  }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

// Seven lines that make a valid 2-D scene of 10 m x 5 m; what a test adds begins on line 8.
inline std::string pond(const std::string& more = "") {
  return "[domain]\nbox = [0, 0, 10, 5]\n[water]\ndepth = 1\nspacing = 0.5\n[time]\nend = 10\n" + more;
}

struct Failure {
  std::string text;  // "" = the scene is valid
  Exit exit = Exit::done;
};

inline Failure failure(const std::string& text, const std::vector<std::string>& overrides = {},
                       const std::string& file = "scene.toml") {
  try {
    read_scene_text(text, file, overrides);
  } catch (const Error& error) { return {error.what(), error.exit()}; }
  return {};
}

inline void check_error(const std::string& scene, const std::string& expected) {
  const Failure found = failure(scene);
  CHECK(found.text == expected);
  CHECK(found.exit == Exit::scene);
}

inline Scene read_text(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return read_scene_text(text, "scene.toml", overrides);
}

// A scene beside the files of a directory.
inline Scene read_in(const Directory& here, const std::string& text) {
  return read_scene_text(text, here.path() + "/scene.toml");
}

}  // namespace freshet::test
