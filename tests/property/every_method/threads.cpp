// The program gives the same bytes with one and two threads, and whether it runs straight or is interrupted
// and resumed.
#include <catch2/catch.hpp>

#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <chrono>
#include <cstring>
#include <filesystem>
#include <thread>

#include "src/io/files.hpp"
#include "src/io/hdf5.hpp"
#include "tests/support/watch/scratch.hpp"

#ifndef FRESHET_PROGRAM
#define FRESHET_PROGRAM "build/release/freshet"
#endif

extern char** environ;

using namespace freshet;
namespace fs = std::filesystem;

namespace {

using Words = std::vector<std::string>;

pid_t start(Words words) {
  words.insert(words.begin(), FRESHET_PROGRAM);
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_t child = 0;
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, 1, "/dev/null", 1, 0);  // O_WRONLY: the tables and "go on with"
  INFO(FRESHET_PROGRAM);
  REQUIRE(posix_spawn(&child, argv[0], &files, nullptr, argv.data(), environ) == 0);
  posix_spawn_file_actions_destroy(&files);
  return child;
}

int wait_for(pid_t child) {
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

int freshet_program(const Words& words) { return wait_for(start(words)); }

Words run_words(Words scene, const std::string& directory, int threads) {
  scene.insert(scene.begin(), "run");
  for (const auto& word : {std::string("--quiet"), std::string("--threads"), std::to_string(threads),
                           std::string("--out"), directory})
    scene.push_back(word);
  return scene;
}

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

// Positions, velocities, depths and all else that the state holds of the particles, and the gauges' file.
void require_same_results(const std::string& a, const std::string& b) {
  const auto left = hdf5::File::look(a + "/state.h5"), right = hdf5::File::look(b + "/state.h5");
  const auto reals = left.open("reals"), other_reals = right.open("reals");
  REQUIRE(reals.names() == other_reals.names());
  for (const char* needed : {"x", "u"}) REQUIRE(reals.has(needed));
  Words different;
  for (const auto& name : reals.names())
    if (!same_bytes(reals.reals(name), other_reals.reals(name))) different.push_back(name);
  CHECK(different == Words{});
  CHECK(same_bytes(left.open("integers").integers("id"), right.open("integers").integers("id")));
  REQUIRE(fs::exists(a + "/gauges.csv") == fs::exists(b + "/gauges.csv"));
  if (fs::exists(a + "/gauges.csv")) CHECK((read_text(a + "/gauges.csv") == read_text(b + "/gauges.csv")));
}

void check_threads(const Words& scene) {
  const test::Scratch scratch;
  REQUIRE(freshet_program(run_words(scene, scratch / "one", 1)) == 0);
  REQUIRE(freshet_program(run_words(scene, scratch / "two", 2)) == 0);
  require_same_results(scratch / "one", scratch / "two");
}

// A channel with a wave boundary, an uneven bed from an expression, friction, walls, a gauge in the water and
// one at the shore.
std::string channel(const test::Scratch& scratch, double end) {
  std::string wave = "t,level\n";
  for (int k = 0; k <= 400; ++k) {
    const double t = 0.25 * k;
    wave += std::to_string(t) + "," + std::to_string(0.02 * std::sin(1.3 * t) * std::min(1.0, t)) + "\n";
  }
  write_text(scratch / "wave.csv", wave);
  write_text(scratch / "channel.toml", R"([scene]
name = "channel"
[domain]
box = [0.0, 0.0, 3.0, 0.5]
[bed]
z = "-0.2 + 0.08*x + 0.01*sin(7*y)*x"
manning = 0.01
[water]
surface = 0.0
spacing = 0.05
[[boundary]]
name = "sea"
side = "left"
type = "wave"
series = { file = "wave.csv", t = "t", value = "level" }
[[wall]]
line = "box"
[[gauge]]
name = "near"
at = [0.6, 0.2]
[[gauge]]
name = "shore"
at = [2.5, 0.3]
[time]
end = )" + std::to_string(end) + R"(
[output]
every = 5.0
gauges_every = 0.05
)");
  return scratch / "channel.toml";
}

std::size_t lines_of(const std::string& path) {
  if (!fs::exists(path)) return 0;
  const std::string text = read_text(path);
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

// Starts the run, sends SIGINT once the gauges have so many rows, and returns the exit code.
int interrupted_run(const Words& words, const std::string& directory, std::size_t rows) {
  const pid_t child = start(words);
  int status = 0;
  while (lines_of(directory + "/gauges.csv") < rows) {
    if (waitpid(child, &status, WNOHANG) == child)
      return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  kill(child, SIGINT);
  return wait_for(child);
}

}  // namespace

TEST_CASE("threads: one and two give the same bytes: dam break") {
  check_threads({"cases/dam_break_wet.toml", "water.spacing=10", "time.end=20"});
}

TEST_CASE("threads: one and two give the same bytes: Thacker") {
  check_threads({"cases/thacker.toml", "water.spacing=200", "time.end=300"});
}

TEST_CASE("threads: one and two give the same bytes: splitting and merging") {
  check_threads({"cases/dam_break_dry_strip.toml", "time.end=15", "split.area=1.5", "merge.area=0.35"});
}

TEST_CASE("threads: one and two give the same bytes: semi-implicit") {
  check_threads({"cases/sisph_bump.toml", "water.disorder=0.2", "time.end=0.03"});
  check_threads({"cases/thacker.toml", "scene.method=sisph", "water.spacing=150", "time.end=300"});
  check_threads({"cases/sisph_seiche.toml", "time.end=0.1"});
  check_threads(
      {"cases/sisph_seiche.toml", "sisph.formulation=moving", "water.depth=1+0.1*cos(pi*x)", "time.end=0.1"});
}

TEST_CASE("threads: one and two give the same bytes: incompressible dam break") {
  check_threads({"cases/fpm_martin_moyce.toml", "water.spacing=0.004", "time.end=0.05"});
}

TEST_CASE("threads: one and two give the same bytes: open channel") {
  const test::Scratch scratch;
  check_threads({channel(scratch, 10)});
}

TEST_CASE("threads: a run that is interrupted and resumed ends with the bytes of the straight one") {
  const test::Scratch scratch;
  const std::string scene = channel(scratch, 40), straight = scratch / "straight",
                    pieces = scratch / "pieces";
  REQUIRE(freshet_program(run_words({scene}, straight, 1)) == 0);
  const std::size_t rows = lines_of(straight + "/gauges.csv");
  REQUIRE(rows > 500);
  int code = 0;
  for (int attempt = 0; attempt < 5 && code == 0;
       ++attempt) {  // 0: the machine was busy and the signal came too late
    fs::remove_all(pieces);
    code = interrupted_run(run_words({scene}, pieces, 2), pieces, rows / 4);
  }
  REQUIRE(code == 130);
  const std::size_t first = lines_of(pieces + "/gauges.csv");
  CHECK(first < rows);
  REQUIRE(freshet_program({"resume", pieces, "--quiet", "--threads", "2"}) == 0);
  require_same_results(straight, pieces);
}
