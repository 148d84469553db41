// Command-line overrides: what they change, what they refuse, where their errors point.
#include <catch2/catch.hpp>

#include "tests/support/run/scene_files.hpp"

using namespace freshet;
using freshet::test::failure;
using freshet::test::pond;
using freshet::test::read_text;

namespace {

const char* const two_gauges =
    "[[gauge]]\nname = \"ch5\"\nat = [1, 2]\n"
    "[[gauge]]\nname = \"ch7\"\nat = [3, 4]\n";

void check_error(const std::string& override_text, const std::string& expected) {
  const test::Failure found = failure(pond(two_gauges), {override_text});
  CHECK(found.text == expected);
  CHECK(found.exit == Exit::scene);
}

}  // namespace

TEST_CASE("An override replaces a value and adds keys and tables") {
  const Scene scene = read_text(pond(), {"water.spacing=0.25", "sph.eta=1.3", "time.end = 20"});
  CHECK(scene.water.spacing == 0.25);
  CHECK(scene.sph.eta == 1.3);
  CHECK(scene.end_time == 20);
}

TEST_CASE("Words and expressions need no quotes in an override") {
  const Scene scene = read_text(pond(), {"scene.name=trial run", "bed.z=0.1*x", "water.depth=x < 5 ? 2 : 1"});
  CHECK(scene.name == "trial run");
  CHECK(scene.bed.elevation(2, 0) == Approx(0.2));
  CHECK(scene.water.depth(4, 0) == 2);
  CHECK(scene.water.depth(6, 0) == 1);
}

TEST_CASE("Array elements are overridden by index or by name") {
  const Scene by_name = read_text(pond(two_gauges), {"gauge.ch7.at=[5, 1]"});
  CHECK(by_name.gauges[0].at == Point{1, 2});
  CHECK(by_name.gauges[1].at == Point{5, 1});
  const Scene by_index = read_text(pond(two_gauges), {"gauge.0.at=[5, 1]", "gauge.1.peak_after=3"});
  CHECK(by_index.gauges[0].at == Point{5, 1});
  CHECK(by_index.gauges[1].peak_after == 3);
}

TEST_CASE("An inline table replaces a table, a dotted path changes one of its keys") {
  const std::string hump = "[bed]\nshape = { type = \"hump\", height = 1, at = 5, width = 2 }\n";
  CHECK(read_text(pond(hump), {"bed.shape.height=3"}).bed.elevation(5, 0) == Approx(3));
  const Scene slope = read_text(pond(hump), {"bed.shape={type = \"slope\", gradient = 2}"});
  CHECK(slope.bed.elevation(5, 0) == Approx(10));
}

TEST_CASE("Later overrides win") { CHECK(read_text(pond(), {"time.end=20", "time.end=30"}).end_time == 30); }

TEST_CASE("An unknown path is an error on the command line") {
  check_error("water.spacng=25",
              "command line: error: unknown key 'water.spacng'\n"
              "  water.spacng=25\n"
              "        ^\n"
              "  help: did you mean 'spacing'?");
  check_error("watr.spacing=25",
              "command line: error: unknown key 'watr'\n"
              "  watr.spacing=25\n"
              "  ^\n"
              "  help: did you mean 'water'?");
  check_error("gauge.ch6.at=[1, 1]",
              "command line: error: there is no 'gauge.ch6'\n"
              "  gauge.ch6.at=[1, 1]\n"
              "        ^\n"
              "  help: did you mean 'ch5'?");
  check_error("gauge.7.at=[1, 1]",
              "command line: error: there is no 'gauge.7'\n"
              "  gauge.7.at=[1, 1]\n"
              "        ^\n"
              "  help: there are 'ch5' or 'ch7', or 0 to 1");
  check_error("wall.0.line=box",
              "command line: error: the scene has no [[wall]] to change\n"
              "  wall.0.line=box\n"
              "  ^");
}

TEST_CASE("A bad value is an error at its place on the command line") {
  check_error("water.spacing=-25",
              "command line: error: 'water.spacing' is -25; it must be positive\n"
              "  water.spacing=-25\n"
              "                ^");
  check_error("water.spacing=small",
              "command line: error: 'water.spacing' must be a number, not a string\n"
              "  water.spacing=small\n"
              "                ^");
  check_error("bed.z=0.1*q2",
              "command line: error: in 'bed.z': unknown name 'q2'\n"
              "  bed.z=0.1*q2\n"
              "            ^\n"
              "  help: variables are x and y [m], constants pi and g");
}

TEST_CASE("What is no override is an error") {
  check_error("spacing",
              "command line: error: 'spacing' is not an override\n"
              "  spacing\n"
              "  ^\n"
              "  help: write key=value, as in water.spacing=25");
  CHECK_THAT(failure(pond(), {"time.end=[1"}).text, Catch::StartsWith("command line: error: "));
}

TEST_CASE("Errors of the file come before those of the command line") {
  const std::string text = failure(pond("[limits]\nspede = 1\n"), {"time.endd=3"}).text;
  CHECK(text.find("scene.toml:9:1") < text.find("command line"));
}

TEST_CASE("The scene's text holds the overrides, keeps numbers and reads back to itself") {
  const Scene scene =
      read_text(pond(two_gauges), {"water.spacing=0.1", "sph.muscl=false", "gauge.ch5.arrival_level=1e-7"});
  CHECK_THAT(scene.text, Catch::Contains("spacing = 0.1\n") && Catch::Contains("arrival_level = 1e-07\n"));
  const Scene again = read_text(scene.text);
  CHECK(again.text == scene.text);
  CHECK(again.water.spacing == 0.1);
  CHECK(again.gauges[0].arrival_level == 1e-7);
  CHECK(read_scene_text(scene.text, "/elsewhere/state.toml").name == "scene");  // as the first file was named
  CHECK(std::holds_alternative<swe::LaxFriedrichs>(again.sph.stabilisation));
}
