// The sub-commands of freshet. Each returns the exit code or throws an Error.
#pragma once
#include <memory>

#include "cellgrid/parallel/runtime.hpp"
#include "src/run/commands/arguments.hpp"
#include "src/run/commands/cli.hpp"

namespace freshet {

struct Command {
  std::string name;
  std::vector<Option> options;
  int (*call)(const Arguments& arguments, const Parts& parts);
};

// In the order of the help text.
const std::vector<Command>& commands();

// commands.cpp
int run_command(const Arguments& arguments, const Parts& parts);
int resume_command(const Arguments& arguments, const Parts& parts);
// profile_command.cpp
int profile_command(const Arguments& arguments, const Parts& parts);
// inspect.cpp
int check_command(const Arguments& arguments, const Parts& parts);
int list_command(const Arguments& arguments, const Parts& parts);
int points_command(const Arguments& arguments, const Parts& parts);
void print_version();
// difference.cpp
int difference_command(const Arguments& arguments, const Parts& parts);

struct Case {
  std::string name;  // file name without .toml
  std::string path;
  std::string comment;  // the first clause of the comment that the file begins with
};
std::vector<Case> find_cases();  // in ./cases, else in the checkout that the program was built from

// What a run may leave in its directory, files and folders: what --overwrite replaces, and a run without it
// refuses.
std::vector<std::string> result_files();

// A path to a scene, or a name in cases/. Throws SceneError with a suggestion.
std::string find_scene(const std::string& path_or_case);

// Starts Kokkos unless the process (a test) has started it already: it can be done once only. threads = 0:
// all cores.
std::unique_ptr<Runtime> start_kokkos(int threads);
// --threads, else 0, or 1 for a scene so small that starting threads would cost more than they do.
int wanted_threads(const Scene& scene, const Arguments& arguments);
// --threads, else otherwise; an error (SceneError) where it is many more than there are cores.
int threads_asked(const Arguments& arguments, int otherwise);

// How the user called the program, for commands that we tell him to type.
extern std::string program_name;

}  // namespace freshet
