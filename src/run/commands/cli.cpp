#include "src/run/commands/cli.hpp"

#include <cstdio>
#include <new>

#include "kernels/water/ids.hpp"
#include "src/errors.hpp"
#include "src/run/commands/commands.hpp"
#include "src/scene/toml/diagnostics.hpp"
#include "src/text.hpp"

namespace freshet {
namespace {

const char* const help_text = R"(freshet: meshless solver for free-surface flow

usage:
  freshet run SCENE [key=value ...] [--out DIR] [--threads N] [--overwrite] [--quiet]
  freshet resume DIR [--threads N] [--quiet]     go on with a run that was stopped
  freshet check SCENE [key=value ...] [--threads N]   read the scene back: extent, particles, steps, features
  freshet check SCENE [key=value ...] --keys     the keys that are looked for in it: type, rule, default
  freshet profile SCENE [key=value ...] [--steps N] [--threads N] [--json]   where the time of N (200) steps goes
  freshet list                                   the cases that come with the program
  freshet points DIR [--step K] [--csv FILE]     particles of one output, a column each of what it holds (K: the last)
  freshet points DIR --list                      number and time of each output
  freshet difference DIR DIR                     two runs of one scene, particle by particle, from their state.h5
  freshet --version | --help

SCENE is a scene file or the name of a case. key=value overrides a value of the scene; keys are dotted paths.
DIR is out/NAME unless given and holds what the scene asks for of
  FILES
All physical cores are used (one for scenes of fewer than 2000 cells) unless --threads says otherwise. Ctrl-C finishes the
step and writes the state.

examples:
  freshet run okushiri
  freshet run thacker water.spacing=25 --out out/thacker25 --threads 2
  freshet check cases/okushiri.toml bed.manning=0.025
  freshet resume out/okushiri

exit codes: 0 done, 1 internal error, 2 scene or command line, 3 data file, 4 diverged, 5 input or output, 130 stopped
)";

std::string help() {
  const std::string text = help_text, slot = "FILES";
  return text.substr(0, text.find(slot)) + joined(result_files(), ", ") +
         text.substr(text.find(slot) + slot.size());
}

bool is_any_of(const std::string& word, const std::vector<std::string>& words) {
  for (const auto& one : words) {
    if (word == one) return true;
  }
  return false;
}

const Command& find_command(const std::string& name) {
  std::vector<std::string> names;
  for (const auto& command : commands()) {
    if (command.name == name) return command;
    names.push_back(command.name);
  }
  names.insert(names.end(), {"--version", "--help"});
  const std::string hint = input::did_you_mean(name, names);
  throw SceneError("unknown command '" + name + "'" + (hint.empty() ? "" : ": " + hint) +
                   "\n  help: it is one of " + input::listed(names));
}

int dispatch(const std::vector<std::string>& words, const Parts& parts) {
  if (words.empty()) {
    std::fputs(help().c_str(), stderr);
    return static_cast<int>(Exit::scene);
  }
  for (const auto& word : words) {
    if (!is_any_of(word, {"--help", "-h"}) && !(word == "help" && &word == &words.front())) continue;
    std::fputs(help().c_str(), stdout);
    return 0;
  }
  if (is_any_of(words[0], {"--version", "version"})) {
    print_version();
    return 0;
  }
  const Command& command = find_command(words[0]);
  return command.call(parse_arguments(command.name, {words.begin() + 1, words.end()}, command.options),
                      parts);
}

// The scene reader's messages already begin with file:line:col: error.
void print_error(const std::string& message) {
  const bool complete = message.substr(0, message.find('\n')).find(": error: ") != std::string::npos;
  std::fprintf(stderr, "%s%s\n", complete ? "" : "freshet: error: ", message.c_str());
}

}  // namespace

std::string program_name = "freshet";

const std::vector<Command>& commands() {
  static const std::vector<Command> all{
      {"run",
       {{"--out", true}, {"--threads", true}, {"--overwrite", false}, {"--quiet", false}},
       run_command},
      {"resume", {{"--threads", true}, {"--quiet", false}}, resume_command},
      {"check", {{"--threads", true}, {"--keys", false}}, check_command},
      {"profile", {{"--steps", true}, {"--threads", true}, {"--json", false}}, profile_command},
      {"list", {}, list_command},
      {"points", {{"--step", true}, {"--csv", true}, {"--list", false}}, points_command},
      {"difference", {}, difference_command}};
  return all;
}

int run_cli(int argc, char** argv, const Parts& parts) {
  if (argc > 0) program_name = argv[0];
  try {
    const int code = dispatch({argv + (argc > 0 ? 1 : 0), argv + argc}, parts);
    if (std::fflush(stdout) != 0 || std::ferror(stdout))
      throw IoError("what was printed could not be written\n  help: is the disk full, or the file closed?");
    return code;
  } catch (const Error& error) {
    print_error(error.what());
    return static_cast<int>(error.exit());
  } catch (const OutOfIds& error) {
    print_error(error.what());
    return static_cast<int>(Exit::scene);
  } catch (const std::bad_alloc&) {
    print_error(
        "not enough memory\n  help: a larger water.spacing or raster.spacing; 'freshet check' says what a "
        "scene takes");
    return static_cast<int>(Exit::scene);
  } catch (const std::exception& error) {
    std::fprintf(stderr,
                 "freshet: internal error: %s\n  please report this with the scene and the command line\n",
                 error.what());
    return static_cast<int>(Exit::internal);
  }
}

}  // namespace freshet
