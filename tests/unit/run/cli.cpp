// The command line: exit codes, refusals, suggestions, interruption.
#include <catch2/catch.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "src/errors.hpp"
#include "src/io/files.hpp"
#include "src/run/commands/cli.hpp"
#include "src/run/commands/commands.hpp"
#include "tests/support/run/fake_method.hpp"
#include "tests/support/watch/scratch.hpp"

using namespace freshet;
namespace fs = std::filesystem;
using Catch::Contains;

namespace {

// The fake method behind the real command line; `prepare` sees each method before it runs.
Parts fake_parts(std::function<void(test::FakeMethod&)> prepare = {}) {
  Parts parts;
  parts.read = [](const std::string& path, const std::vector<std::string>& overrides) {
    if (!overrides.empty()) throw SceneError(path + ":1:1: error: unknown key '" + overrides[0] + "'");
    Scene scene = test::fake_scene();
    scene.file = path;
    return scene;
  };
  parts.read_again = [](const std::string&, const std::string&) { return test::fake_scene(); };
  parts.make = [prepare](const Scene& scene) {
    auto method = std::make_unique<test::FakeMethod>(scene);
    if (prepare) prepare(*method);
    return method;
  };
  parts.describe = [](const Scene& scene) { return std::vector<std::string>{"scene       " + scene.name}; };
  return parts;
}

struct Result {
  int code;
  std::string out, err;
};

// Sends a standard stream to a file for the length of a scope.
class Redirect {
 public:
  Redirect(std::FILE* stream, const std::string& path) : stream_(stream), saved_(::dup(::fileno(stream))) {
    std::fflush(stream_);
    const int file = ::open(path.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
    ::dup2(file, ::fileno(stream_));
    ::close(file);
  }
  ~Redirect() {
    std::fflush(stream_);
    ::dup2(saved_, ::fileno(stream_));
    ::close(saved_);
  }

 private:
  std::FILE* stream_;
  int saved_;
};

Result freshet_with(const Parts& parts, std::vector<std::string> words) {
  const test::Scratch scratch;
  words.insert(words.begin(), "freshet");
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  Result result{};
  {
    const Redirect out(stdout, scratch / "out"), err(stderr, scratch / "err");
    result.code = run_cli(static_cast<int>(argv.size()), argv.data(), parts);
  }
  result.out = read_text(scratch / "out");
  result.err = read_text(scratch / "err");
  return result;
}

Result freshet_with(std::vector<std::string> words) { return freshet_with(fake_parts(), std::move(words)); }

// A scene file for the fake reader, which does not look into it.
std::string scene_in(const test::Scratch& scratch) {
  write_text(scratch / "scene.toml", "");
  return scratch / "scene.toml";
}

}  // namespace

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

TEST_CASE("profile prints a table or JSON and leaves no files") {
  const test::Scratch scratch;
  const Result lines = freshet_with({"profile", scene_in(scratch), "--steps", "3"});
  CHECK(lines.code == 0);
  CHECK_THAT(lines.out,
             Contains("steps 21 to 23") && Contains("run::monitor") && Contains("particle-steps/s"));
  const Result text = freshet_with({"profile", scene_in(scratch), "--steps=3", "--json"});
  CHECK(text.code == 0);
  CHECK_THAT(text.out, Contains("\"steps\": 3,") && Contains("\"label\": \"run::monitor\""));
  for (const auto& entry : fs::directory_iterator(scratch.path()))
    CHECK(entry.path().filename() == "scene.toml");
  CHECK(freshet_with({"profile", scene_in(scratch), "--steps", "none"}).code == 2);
  CHECK(freshet_with({"profile"}).code == 2);
}

TEST_CASE("difference finds the one particle that moved") {
  const test::Scratch scratch;
  const std::string scene = scene_in(scratch);
  const auto run = [&](const Parts& parts, const std::string& name) {
    return freshet_with(parts, {"run", scene, "--out", scratch / name}).code;
  };
  REQUIRE(run(fake_parts(), "a") == 0);
  REQUIRE(run(fake_parts(), "b") == 0);
  long last = 0;
  REQUIRE(run(fake_parts([&](test::FakeMethod& method) { method.on_step = [&](long step) { last = step; }; }),
              "b2") == 0);
  const auto moved = [&](test::FakeMethod& method) {
    method.on_step = [&method, last](long step) {
      const Field<int> id = method.fields().integer("id");
      const Field<double> y = method.fields().real("y");
      for (int i = 0; step == last && i < method.fields().size(); ++i) y(i) += id(i) == 7 ? 0.125 : 0;
    };
  };
  REQUIRE(run(fake_parts(moved), "c") == 0);
  const Result same = freshet_with({"difference", scratch / "a", scratch / "b"});
  CHECK(same.code == 0);
  CHECK_THAT(same.out, Contains("\nmass "));
  const auto lines = [](const std::string& text, const std::string& end) {
    int n = 0;
    for (auto at = text.find(end); at != std::string::npos; at = text.find(end, at + 1)) ++n;
    return n;
  };
  CHECK(lines(same.out, "\n") == 2 + lines(same.out, " 0            0\n"));  // no field differs anywhere
  const Result other = freshet_with({"difference", scratch / "a", scratch / "c"});
  CHECK_THAT(other.out, Contains("0.125") && Contains(" 7\n"));
  CHECK(lines(other.out, "\n") == 3 + lines(other.out, " 0            0\n"));
  CHECK(freshet_with({"difference", scratch / "a"}).code == 2);
  const Result none = freshet_with({"difference", scratch / "a", scratch / "nowhere"});
  CHECK(none.code == 2);
  CHECK_THAT(none.err, Contains("nowhere/state.h5 is not there"));
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

TEST_CASE("points prints the particles of an output") {
  const test::Scratch scratch;
  REQUIRE(freshet_with({"run", scene_in(scratch), "--out", scratch / "r", "--quiet"}).code == 0);
  const Result list = freshet_with({"points", scratch / "r", "--list"});
  CHECK(list.out == "step,t [s]\n0,0\n1,0.25\n2,0.5\n3,0.75\n4,1\n");
  const Result first = freshet_with({"points", scratch / "r", "--step", "0"});
  CHECK(first.code == 0);
  CHECK(first.out.rfind("x [m],y [m],z [m],depth [m],v_0 [m/s],v_1 [m/s],id [1],size [m]\n0.025,0.025,1.0025",
                        0) == 0);
  CHECK(std::count(first.out.begin(), first.out.end(), '\n') == 401);
  CHECK(freshet_with({"points", scratch / "r", "--step", "0", "--csv", scratch / "p.csv"}).code == 0);
  CHECK(read_text(scratch / "p.csv") == first.out);
  CHECK(freshet_with({"points", scratch / "r", "--step", "9"}).code == 2);
  CHECK(freshet_with({"points", scratch / "r", "--csv", scratch / "no/p.csv"}).code == 5);
  CHECK(freshet_with({"points", scratch / "r", "--csv", "/dev/full"}).code == 5);
}

TEST_CASE("check, list, version and help") {
  const test::Scratch scratch;
  const Result check = freshet_with({"check", scene_in(scratch)});
  CHECK(check.code == 0);
  // 0.3 dx = 0.015 s: 66.7 steps to 1 s.
  CHECK_THAT(check.out, Contains("scene       fake") && Contains("particles   400") &&
                            Contains("about 67 of 0.015 s") && Contains("flight"));
  CHECK_THAT(freshet_with({"list"}).out, Contains("okushiri") && Contains("thacker"));  // run in the checkout
  CHECK_THAT(freshet_with({"--version"}).out,
             Contains("backend") && Contains("compiler") && Contains("threads"));
  CHECK_THAT(freshet_with({"--help"}).out, Contains("examples:") && Contains("exit codes:"));
  CHECK(freshet_with({"run", "--help"}).code == 0);
}
