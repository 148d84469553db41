// Failures that a user can mend, with the exit code each ends the program with. Messages carry what, where,
// remedy.
#pragma once
#include <stdexcept>
#include <string>

namespace freshet {

enum class Exit { done = 0, internal = 1, scene = 2, data = 3, diverged = 4, io = 5, interrupted = 130 };

class Error : public std::runtime_error {
 public:
  Error(Exit exit, const std::string& message) : std::runtime_error(message), exit_(exit) {}
  Exit exit() const { return exit_; }

 private:
  Exit exit_;
};

struct SceneError : Error {  // scene file or command line
  explicit SceneError(const std::string& message) : Error(Exit::scene, message) {}
};
struct DataError : Error {  // a data file that the scene names
  explicit DataError(const std::string& message) : Error(Exit::data, message) {}
};
struct Diverged : Error {
  explicit Diverged(const std::string& message) : Error(Exit::diverged, message) {}
};
struct IoError : Error {
  explicit IoError(const std::string& message) : Error(Exit::io, message) {}
};

}  // namespace freshet
