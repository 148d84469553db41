// The program's own parts behind the command line; tests bring theirs.
#include "src/run/commands/cli.hpp"
#include "src/scene/read.hpp"

namespace freshet {

int run_cli(int argc, char** argv) {
  const auto read_again = [](const std::string& text, const std::string& path) {
    return read_scene_text(text, path);
  };
  return run_cli(argc, argv, {read_scene, read_again, make_method, describe});
}

}  // namespace freshet
