#include "src/run/commands/commands.hpp"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <thread>

#include "cellgrid/parallel/types.hpp"
#include "src/errors.hpp"
#include "src/io/files.hpp"
#include "src/run/commands/signals.hpp"
#include "src/run/driver.hpp"
#include "src/text.hpp"

namespace freshet {
namespace fs = std::filesystem;
namespace {

constexpr const char* summary_file = "summary.json";

std::vector<std::string> results_in(const std::string& directory) {
  std::vector<std::string> found;
  for (const auto& name : result_files())
    if (fs::exists(path_in(directory, name))) found.push_back(name);
  return found;
}

void prepare_directory(const std::string& directory, bool overwrite) {
  const auto held = results_in(directory);
  if (!held.empty() && !overwrite) {
    throw SceneError(directory + " holds results (" + joined(held, ", ") +
                     ")\n  help: --overwrite replaces them, --out DIR writes elsewhere" +
                     (fs::exists(path_in(directory, "state.h5")) ? ", 'resume' goes on with them" : ""));
  }
  make_directory(directory);
  for (const auto& name : held) fs::remove_all(path_in(directory, name));
}

std::string shell_word(const std::string& path) {
  return path.find_first_of(" '\"$&;()") == std::string::npos ? path : "'" + path + "'";
}

RunOptions options_for(const std::string& directory, bool quiet) {
  return {directory, quiet ? nullptr : stdout, isatty(STDOUT_FILENO) != 0, &stop_requested};
}

int finish(Driver& driver, const std::string& directory, bool quiet) {
  const SignalGuard guard;
  if (!driver.run()) {
    std::printf("stopped at t = %.6g s, step %ld; go on with:\n  %s resume %s\n", driver.clock().t,
                driver.clock().step, shell_word(program_name).c_str(), shell_word(directory).c_str());
    return static_cast<int>(Exit::interrupted);
  }
  const Summary summary = driver.summary();
  write_text(path_in(directory, summary_file), json(summary));
  if (quiet) return 0;
  print_tables(stdout, summary);
  std::printf("results: %s\n", directory.c_str());
  return 0;
}

void announce(const Scene& scene, const Method& method) {
  std::printf("%s: %s, %d particles, to t = %g s, %d thread%s (%s)\n  %s\n", scene.name.c_str(),
              method.name().c_str(), method.fields().size(), scene.end_time, thread_count(),
              thread_count() == 1 ? "" : "s", backend_name(), joined(method.features(), ", ").c_str());
}

// From the start, or on from what state.h5 holds.
int go(const Scene& scene, const std::string& directory, const Arguments& arguments, const Parts& parts,
       const Checkpoint* checkpoint) {
  const bool quiet = arguments.has("--quiet");
  const auto runtime = start_kokkos(wanted_threads(scene, arguments));
  const auto method = parts.make(scene);
  if (checkpoint) {
    const std::string state = path_in(directory, "state.h5");
    read_checkpoint_fields(state, method->fields());
    look_at_checkpoint(state, [&] { method->restore(checkpoint->method); });
  }
  if (!quiet) announce(scene, *method);
  Driver driver(scene, *method, options_for(directory, quiet));
  if (checkpoint) driver.restore(*checkpoint);
  else driver.begin();
  return finish(driver, directory, quiet);
}

std::string one_word(const Arguments& arguments, const std::string& usage) {
  if (arguments.words.size() == 1) return arguments.words[0];
  throw SceneError((arguments.words.empty()
                        ? "too few words; usage: freshet "
                        : "'" + arguments.words[1] + "' is one word too many; usage: freshet ") +
                   usage);
}

}  // namespace

// The cells that fill the domain are at least as many as the particles.
int wanted_threads(const Scene& scene, const Arguments& arguments) {
  constexpr double worth_threads = 2000;
  double cells = 1;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(scene.domain.dimension); ++axis)
    cells *= (scene.domain.high[axis] - scene.domain.low[axis]) / scene.water.spacing;
  return threads_asked(arguments, cells < worth_threads ? 1 : 0);
}

// More threads than cores only wait for each other; thousands do not even start.
int threads_asked(const Arguments& arguments, int otherwise) {
  const int asked = arguments.number("--threads", otherwise, 1);
  const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  if (asked > 4 * std::max(cores, 4))
    throw SceneError("--threads " + std::to_string(asked) + " on a machine of " + std::to_string(cores) +
                     " cores\n  help: at most " + std::to_string(4 * std::max(cores, 4)) +
                     "; without the option all physical cores are used");
  return asked;
}

std::unique_ptr<Runtime> start_kokkos(int threads) {
  return Kokkos::is_initialized() ? nullptr : std::make_unique<Runtime>(threads);
}

std::vector<std::string> result_files() {
  auto all = Driver::files();
  all.push_back(summary_file);
  return all;
}

int run_command(const Arguments& arguments, const Parts& parts) {
  const std::string word =
      one_word(arguments, "run SCENE [key=value ...] [--out DIR] [--threads N] [--overwrite] [--quiet]");
  const Scene scene = parts.read(find_scene(word), arguments.overrides);
  const std::string directory = arguments.value("--out", "out/" + scene.name);
  prepare_directory(directory, arguments.has("--overwrite"));
  return go(scene, directory, arguments, parts, nullptr);
}

int resume_command(const Arguments& arguments, const Parts& parts) {
  const std::string directory = one_word(arguments, "resume DIR [--threads N] [--quiet]");
  const std::string state = path_in(directory, "state.h5");
  if (!fs::exists(state)) {
    throw SceneError(
        directory + " holds no state.h5 to go on with" +
        "\n  help: it is written every output.checkpoint_every seconds, on Ctrl-C and at the end of a run");
  }
  const Checkpoint checkpoint = read_checkpoint(state);
  const Scene scene = parts.read_again(checkpoint.scene_text, checkpoint.scene_file);
  double t = 0;
  look_at_checkpoint(state, [&] { t = checkpoint.run.at("clock").at(0); });
  if (t >= scene.end_time && fs::exists(path_in(directory, summary_file))) {
    if (!arguments.has("--quiet")) std::printf("the run in %s is complete: t = %g s\n", directory.c_str(), t);
    return 0;
  }
  return go(scene, directory, arguments, parts, &checkpoint);
}

}  // namespace freshet
