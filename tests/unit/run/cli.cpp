// The command line: runs and their files, exit codes, refusals, suggestions, interruption.
#include <catch2/catch.hpp>

#include <csignal>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "src/run/commands/commands.hpp"
#include "tests/support/run/command_line.hpp"

using namespace freshet;
namespace fs = std::filesystem;
using Catch::Contains;
using test::fake_parts;
using test::freshet_with;
using test::scene_in;
using Result = test::CommandResult;

TEST_CASE("a finished run exits with 0 and leaves all its files") {
  const test::Scratch scratch;
  const Result run = freshet_with({"run", scene_in(scratch), "--out", scratch / "results"});
  CHECK(run.code == 0);
  CHECK_THAT(run.out, Contains("middle") && Contains("shore") && Contains("particle-steps/s"));
  for (const char* name : {"particles.h5part", "gauges.csv", "summary.json", "state.h5"}) {
    CHECK(fs::exists(scratch / ("results/" + std::string(name))));
  }
  const Result again = freshet_with({"resume", scratch / "results"});
  CHECK(again.code == 0);
  CHECK_THAT(again.out, Contains("complete"));
}

TEST_CASE("with --quiet a run prints nothing") {
  const test::Scratch scratch;
  const Result run = freshet_with({"run", scene_in(scratch), "--quiet", "--out=" + (scratch / "results")});
  CHECK(run.code == 0);
  CHECK(run.out.empty());
  CHECK(run.err.empty());
}

TEST_CASE("a directory that holds results is refused unless --overwrite is given") {
  const test::Scratch scratch;
  const std::string scene = scene_in(scratch), results = scratch / "results";
  fs::create_directory(results);
  write_text(results + "/gauges.csv", "precious");
  write_text(results + "/notes.txt", "mine");
  const Result refused = freshet_with({"run", scene, "--out", results});
  CHECK(refused.code == 2);
  CHECK_THAT(refused.err, Contains(results) && Contains("gauges.csv") && Contains("--overwrite"));
  CHECK(read_text(results + "/gauges.csv") == "precious");
  CHECK(freshet_with({"run", scene, "--out", results, "--overwrite"}).code == 0);
  CHECK(read_text(results + "/notes.txt") == "mine");  // only results are replaced
}

TEST_CASE(
    "the files of a run with everything switched on are those that are refused, replaced and named by "
    "--help") {
  const test::Scratch scratch;
  const std::string scene = scene_in(scratch), results = scratch / "results";
  const auto observed = [](const Parts& parts) {
    Parts all = parts;
    all.read = [](const std::string&, const std::vector<std::string>&) { return test::observed_scene(); };
    return all;
  };
  REQUIRE(freshet_with(observed(fake_parts()), {"run", scene, "--out", results}).code == 0);
  const Parts failing = fake_parts([](auto& m) { m.trouble = {test::Trouble::Kind::fast, 5, 1}; });
  REQUIRE(freshet_with(observed(failing), {"run", scene, "--out", scratch / "failed"}).code == 4);
  std::set<std::string> left;
  for (const auto& folder : {results, scratch / "failed"})
    for (const auto& entry : fs::directory_iterator(folder)) left.insert(entry.path().filename().string());
  const auto known = result_files();
  CHECK(left == std::set<std::string>(known.begin(), known.end()));
  CHECK(known.size() == left.size());  // each once

  const std::string help = freshet_with({"--help"}).out;
  for (const auto& name : known) {
    CAPTURE(name);
    CHECK_THAT(help, Contains(name));
    const std::string used = scratch / ("with_" + name);
    fs::create_directory(used);
    write_text(used + '/' + name, "precious");
    const Result refused = freshet_with({"run", scene, "--out", used});
    CHECK(refused.code == 2);
    CHECK_THAT(refused.err, Contains("holds results (" + name + ")"));
  }
  // A plain run in the place of the other leaves nothing of it.
  REQUIRE(freshet_with({"run", scene, "--out", results, "--overwrite"}).code == 0);
  CHECK_FALSE(fs::exists(results + "/profiles.csv"));
  CHECK_FALSE(fs::exists(results + "/rasters"));
}

TEST_CASE("mistakes on the command line exit with 2 and a suggestion") {
  const test::Scratch scratch;
  const std::string scene = scene_in(scratch);
  CHECK_THAT(freshet_with({"rum", scene}).err, Contains("did you mean 'run'?"));
  CHECK(freshet_with({"rum", scene}).code == 2);
  CHECK(freshet_with({}).code == 2);
  CHECK(freshet_with({"run"}).code == 2);
  CHECK(freshet_with({"run", scene, "too many"}).code == 2);
  const Result option = freshet_with({"run", scene, "--ouput", "x"});
  CHECK(option.code == 2);
  CHECK_THAT(option.err, Contains("did you mean"));
  CHECK(freshet_with({"run", scene, "--threads", "two"}).code == 2);
  CHECK(freshet_with({"run", scene, "--threads", "9999"}).code == 2);
  CHECK(freshet_with({"run", scene, "--out"}).code == 2);
  CHECK(freshet_with({"run", scene, "--quiet=yes"}).code == 2);
  CHECK(freshet_with({"run", scratch / "missing.toml"}).code == 2);
  CHECK(freshet_with({"resume", scratch.path()}).code == 2);
  CHECK(freshet_with({"points", scratch.path()}).code == 2);
}

TEST_CASE("the reader's own messages are printed as they are") {
  const test::Scratch scratch;
  const Result run = freshet_with({"run", scene_in(scratch), "water.spacin=1"});
  CHECK(run.code == 2);
  CHECK(run.err == (scratch / "scene.toml") + ":1:1: error: unknown key 'water.spacin=1'\n");
}

TEST_CASE("each failure has its exit code") {
  const test::Scratch scratch;
  const std::string scene = scene_in(scratch);
  const auto code = [&](Parts parts, const std::string& out) {
    return freshet_with(parts, {"run", scene, "--out", scratch / out}).code;
  };
  Parts data = fake_parts();
  data.read = [](const std::string&, const std::vector<std::string>&) -> Scene {
    throw DataError("no such file");
  };
  CHECK(code(data, "a") == 3);
  CHECK(code(fake_parts([](auto& m) { m.trouble = {test::Trouble::Kind::fast, 5, 1}; }), "b") == 4);
  CHECK(code(fake_parts(), "scene.toml") == 5);  // a file where the directory should be
  CHECK(code(fake_parts(), "scene.toml/below") == 5);
  const Parts broken =
      fake_parts([](auto& m) { m.on_step = [](long) { throw std::logic_error("two and two"); }; });
  CHECK(code(broken, "c") == 1);
  const Result told = freshet_with(broken, {"run", scene, "--out", scratch / "d"});
  CHECK_THAT(told.err, Contains("internal error: two and two") && Contains("please report"));
}

TEST_CASE("SIGINT and SIGTERM finish the step, write the state and exit with 130, the run can be resumed") {
  const test::Scratch scratch;
  const int signal = GENERATE(SIGINT, SIGTERM);
  const std::string results = scratch / "results";
  const auto interrupt = [signal](auto& method) {
    method.on_step = [signal](long step) {
      if (step == 20) std::raise(signal);
    };
  };
  const Result run = freshet_with(fake_parts(interrupt), {"run", scene_in(scratch), "--out", results});
  CHECK(run.code == 130);
  CHECK_THAT(run.out, Contains("step 20") && Contains("freshet resume " + results));
  CHECK_FALSE(fs::exists(results + "/summary.json"));
  const Result resumed = freshet_with({"resume", results});
  CHECK(resumed.code == 0);
  CHECK(fs::exists(results + "/summary.json"));
}

TEST_CASE("an echo of the signal does not kill the run before its state is written") {
  const test::Scratch scratch;
  const auto interrupt = [](auto& method) {
    method.on_step = [](long step) {
      if (step == 20) std::raise(SIGTERM), std::raise(SIGTERM);  // as timeout(1) does
    };
  };
  CHECK(freshet_with(fake_parts(interrupt), {"run", scene_in(scratch), "--out", scratch / "r"}).code == 130);
  CHECK(fs::exists(scratch / "r/state.h5"));
}
