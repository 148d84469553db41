#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "src/errors.hpp"
#include "src/run/commands/commands.hpp"
#include "src/run/timing/profile.hpp"

namespace freshet {
namespace fs = std::filesystem;
namespace {

// Where a profiled run writes what it would write anyway; gone at the end.
class PassingDirectory {
 public:
  PassingDirectory() : path_(fs::temp_directory_path() / ("freshet-profile-" + std::to_string(::getpid()))) {
    fs::create_directories(path_);
  }
  ~PassingDirectory() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  PassingDirectory(const PassingDirectory&) = delete;
  PassingDirectory& operator=(const PassingDirectory&) = delete;
  std::string path() const { return path_.string(); }

 private:
  fs::path path_;
};

}  // namespace

int profile_command(const Arguments& arguments, const Parts& parts) {
  if (arguments.words.size() != 1)
    throw SceneError("usage: freshet profile SCENE [key=value ...] [--steps N] [--threads N] [--json]");
  const int steps = arguments.number("--steps", 200, 1);
  const Scene scene = parts.read(find_scene(arguments.words[0]), arguments.overrides);
  const auto runtime = start_kokkos(wanted_threads(scene, arguments));
  const auto method = parts.make(scene);
  const PassingDirectory directory;
  const RunProfile profile = profile_run(scene, *method, directory.path(), steps);
  if (profile.steps == 0)
    throw SceneError(scene.name +
                     " ends within its first steps, which are not counted\n  help: a later time.end");
  std::fputs((arguments.has("--json") ? json(profile) : table(profile)).c_str(), stdout);
  return 0;
}

}  // namespace freshet
