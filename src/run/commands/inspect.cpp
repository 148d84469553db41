// Commands that compute nothing: check, list, points, version.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>

#include "src/errors.hpp"
#include "src/io/build.hpp"
#include "src/io/fluid.hpp"
#include "src/io/h5part.hpp"
#include "src/run/commands/commands.hpp"
#include "src/scene/read.hpp"
#include "src/scene/toml/diagnostics.hpp"
#include "src/text.hpp"

namespace freshet {
namespace fs = std::filesystem;
namespace {

// The comment block at the head of the file up to the end of its first sentence or clause.
std::string first_comment(const fs::path& path) {
  std::ifstream file(path);
  std::string line, text;
  while (std::getline(file, line) && line.rfind('#', 0) == 0) {
    const auto begin = line.find_first_not_of("# \t"), end = line.find_last_not_of(" \t\r");
    if (begin != std::string::npos) text += (text.empty() ? "" : " ") + line.substr(begin, end - begin + 1);
  }
  std::size_t length = text.size();
  for (const char* mark : {" (", ": ", ". ", "; "}) length = std::min(length, text.find(mark));
  return text.substr(0, length);
}

double megabytes(const FieldSet& fields) {
  const auto bytes = fields.reals().size() * sizeof(double) + fields.integers().size() * sizeof(int);
  return static_cast<double>(bytes) * fields.capacity() / 1e6;
}

void print_method(const Scene& scene, const Method& method) {
  const FieldSet& fields = method.fields();
  const int fluid = fluid_count(fields);
  std::printf("method      %s\n", method.name().c_str());
  std::printf("particles   %d", fluid);
  if (fields.size() > fluid) std::printf(" and %d at open boundaries", fields.size() - fluid);
  std::printf("\nmemory      %.1f MB in %zu fields; neighbour lists come on top\n", megabytes(fields),
              fields.reals().size() + fields.integers().size());
  const double dt = method.stable_dt();
  std::printf("steps       about %.0f of %.3g s (the first stable step) to t = %g s\n",
              std::ceil(scene.end_time / dt), dt, scene.end_time);
  std::printf("water       %.9g m3\n", method.totals().mass);
  for (const auto& feature : method.features()) std::printf("on          %s\n", feature.c_str());
}

int print_keys(const std::vector<KeyNote>& keys) {
  std::printf("key\twhat\trule\tdefault\n");
  for (const KeyNote& k : keys)
    std::printf("%s\t%s\t%s\t%s\n", k.path.c_str(), k.what.c_str(), k.rule.c_str(), k.standard.c_str());
  return 0;
}

void print_rows(std::FILE* out, const ParticleStep& step) {
  const char* comma = "";
  for (const ParticleColumn& column : step.columns) {
    std::fprintf(out, "%s%s [%s]", comma, column.name.c_str(), column.unit.c_str());
    comma = ",";
  }
  for (std::size_t i = 0; i < step.size(); ++i) {
    comma = "\n";
    for (const ParticleColumn& column : step.columns) {
      std::fprintf(out, "%s%.*g", comma, column.digits, column.values[i]);
      comma = ",";
    }
  }
  std::fputc('\n', out);
}

void write_rows(const std::string& path, const ParticleStep& step) {
  if (path == "-") return print_rows(stdout, step);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "w"), std::fclose);
  if (!file) throw IoError(path + ": cannot be written\n  help: choose another file with --csv FILE");
  print_rows(file.get(), step);
  if (std::fflush(file.get()) != 0) throw IoError(path + ": cannot be written: is the disk full?");
}

}  // namespace

std::vector<Case> find_cases() {
  fs::path folder = "cases";
  if (!fs::is_directory(folder)) folder = fs::path(build::source_dir) / "cases";
  std::vector<Case> cases;
  if (!fs::is_directory(folder)) return cases;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path& path = entry.path();
    if (path.extension() == ".toml")
      cases.push_back({path.stem().string(), path.string(), first_comment(path)});
  }
  std::sort(cases.begin(), cases.end(), [](const Case& a, const Case& b) { return a.name < b.name; });
  return cases;
}

std::string find_scene(const std::string& path_or_case) {
  if (fs::exists(path_or_case)) return path_or_case;
  std::vector<std::string> names;
  for (const auto& one : find_cases()) {
    if (one.name == path_or_case) return one.path;
    names.push_back(one.name);
  }
  const std::string hint = input::did_you_mean(path_or_case, names);
  throw SceneError("'" + path_or_case + "' is neither a file nor a case" + (hint.empty() ? "" : ": " + hint) +
                   "\n  help: 'freshet list' shows the cases");
}

int check_command(const Arguments& arguments, const Parts& parts) {
  if (arguments.words.size() != 1) throw SceneError("usage: freshet check SCENE [key=value ...] [--keys]");
  if (arguments.has("--keys"))
    return print_keys(known_keys(find_scene(arguments.words[0]), arguments.overrides));
  const Scene scene = parts.read(find_scene(arguments.words[0]), arguments.overrides);
  for (const auto& line : parts.describe(scene)) std::printf("%s\n", line.c_str());
  const auto runtime = start_kokkos(threads_asked(arguments, 0));
  print_method(scene, *parts.make(scene));
  return 0;
}

int list_command(const Arguments&, const Parts&) {
  for (const auto& one : find_cases()) std::printf("%-16s %s\n", one.name.c_str(), one.comment.c_str());
  return 0;
}

int points_command(const Arguments& arguments, const Parts&) {
  if (arguments.words.size() != 1)
    throw SceneError("usage: freshet points DIR --step K [--csv FILE|-] | --list");
  const fs::path given = arguments.words[0];
  const std::string path = fs::is_directory(given) ? (given / "particles.h5part").string() : given.string();
  if (!fs::exists(path)) throw SceneError(path + " is not there: 'freshet run' writes it");
  const auto steps = list_particle_steps(path);
  if (arguments.has("--list")) {
    std::printf("step,t [s]\n");
    for (const auto& step : steps) std::printf("%d,%.9g\n", step.step, step.t);
    return 0;
  }
  const int last = steps.empty() ? 0 : steps.back().step;
  const bool wants_last = arguments.value("--step", "last") == "last";
  write_rows(arguments.value("--csv", "-"),
             read_particle_step(path, wants_last ? last : arguments.number("--step", 0, 0)));
  return 0;
}

void print_version() {
  const auto runtime = start_kokkos(0);
  const std::string better = better_registers();
  std::printf(
      "freshet %s (%s)\nbackend   %s, %d threads\nregisters %s%s%s\nKokkos    %s\ncompiler  %s\nbuild     "
      "%s: %s\n",
      build::version, build::git, backend_name(), thread_count(), registers_name(),
      better.empty() ? "" : "; ", better.c_str(), build::kokkos, build::compiler, build::type, build::flags);
}

}  // namespace freshet
