// The commands beside run and resume: profile, difference, points, check, list.
#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>

#include "tests/support/run/command_line.hpp"

using namespace freshet;
namespace fs = std::filesystem;
using Catch::Contains;
using test::fake_parts;
using test::freshet_with;
using test::scene_in;
using Result = test::CommandResult;

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
