// Errors in what a scene says its keys are: names, types, choices, tables; their places, carets and help.
#include <catch2/catch.hpp>

#include "tests/support/run/scene_files.hpp"

using namespace freshet;
using freshet::test::check_error;
using freshet::test::failure;
using freshet::test::pond;
using freshet::test::read_text;

TEST_CASE("The scene of these tests is valid") { CHECK(failure(pond()).text == ""); }

TEST_CASE("An unknown key is an error that names the key meant") {
  check_error(pond("[sph]\netta = 1.3\n"),
              "scene.toml:9:1: error: unknown key 'sph.etta'\n"
              "  etta = 1.3\n"
              "  ^\n"
              "  help: did you mean 'eta'?");
}

TEST_CASE("An unknown key far from any known one lists what is known") {
  check_error(pond("[limits]\nviscosity = 1.3\n"),
              "scene.toml:9:1: error: unknown key 'limits.viscosity'\n"
              "  viscosity = 1.3\n"
              "  ^\n"
              "  help: known here: 'mass_error' or 'speed'");
}

TEST_CASE("Unknown tables and unknown keys of inline tables are errors too") {
  check_error(pond("[outptu]\nevery = 1\n"),
              "scene.toml:8:2: error: unknown key 'outptu'\n"
              "  [outptu]\n"
              "   ^\n"
              "  help: did you mean 'output'?");
  check_error(pond("[compare]\nexact = { type = \"rest\", level = 1, lvl = 2 }\n"),
              "scene.toml:9:37: error: unknown key 'compare.exact.lvl'\n"
              "  exact = { type = \"rest\", level = 1, lvl = 2 }\n"
              "                                      ^\n"
              "  help: known here: 'type' or 'level'");
}

TEST_CASE("An unknown value of a choice is an error that names the value meant") {
  check_error(pond("[sph]\nstabilise = \"lax-friedrich\"\n"),
              "scene.toml:9:13: error: 'sph.stabilise' is 'lax-friedrich'; it must be one of 'none', "
              "'artificial-viscosity', "
              "'lax-friedrichs' or 'two-shock'\n"
              "  stabilise = \"lax-friedrich\"\n"
              "              ^\n"
              "  help: did you mean 'lax-friedrichs'?");
}

TEST_CASE("An unknown reference solution is an error") {
  check_error(pond("[compare]\nexact = { type = \"thacker\" }\n"),
              "scene.toml:9:18: error: 'compare.exact.type' is 'thacker'; it must be one of 'stoker', "
              "'ritter', 'thacker-planar', 'thacker-radial', 'radial-dam-break', "
              "'gaussian-hump', 'eddy', 'riemann', 'beach-wave', 'rest', 'bump' or 'macdonald'\n"
              "  exact = { type = \"thacker\" }\n"
              "                   ^");
}

TEST_CASE("A wrong type is an error, quotes around a number are pointed out") {
  check_error(pond("[output]\nevery = true\n"),
              "scene.toml:9:9: error: 'output.every' must be a number, not a boolean\n"
              "  every = true\n"
              "          ^");
  check_error(pond("[output]\nevery = \"0.5\"\n"),
              "scene.toml:9:9: error: 'output.every' must be a number, not a string\n"
              "  every = \"0.5\"\n"
              "          ^\n"
              "  help: remove the quotes around the number");
}

TEST_CASE("output.fields knows the fields of the scene's method and dimension") {
  const Scene scene = read_text(pond("[output]\nfields = [\"depth\", \"u\", \"h\", \"mass\", \"bed\"]\n"));
  CHECK(scene.output.fields == std::vector<std::string>{"depth", "u", "h", "mass", "bed"});
  CHECK(read_text(scene.text).output.fields == scene.output.fields);
  CHECK_FALSE(read_text(pond()).output.fields);
  check_error(
      pond("[output]\nfields = [\"depth\", \"mas\"]\n"),
      "scene.toml:9:20: error: 'output.fields' holds 'mas'; wanted: 'z', 'depth', 'u', 'v', 'mass', 'h', "
      "'bed' or 'size'\n"
      "  fields = [\"depth\", \"mas\"]\n"
      "                     ^\n"
      "  help: did you mean 'mass'?");
  const std::string channel =
      "[domain]\nbox = [0, 10]\n[water]\ndepth = 1\nspacing = 0.5\n[time]\nend = 10\n";
  CHECK_THAT(
      failure(channel + "[output]\nfields = [\"v\"]\n").text,
      Catch::Contains("'output.fields' holds 'v'; wanted: 'z', 'depth', 'u', 'mass', 'h', 'bed' or 'size'"));
}

TEST_CASE("A missing key is an error at its table, a missing table at the file's start") {
  check_error("[domain]\nbox = [0, 1]\n[water]\nspacing = 0.1\ndepth = 1\n[time]\ncfl = 0.4\n",
              "scene.toml:6:1: error: 'time.end' is missing\n"
              "  [time]\n"
              "  ^\n"
              "  help: add 'end' (a number in s) under [time]");
  check_error("[domain]\nbox = [0, 1]\n[water]\nspacing = 0.1\ndepth = 1\n",
              "scene.toml:1:1: error: 'time.end' is missing\n"
              "  [domain]\n"
              "  ^\n"
              "  help: add 'end' (a number in s) under [time]");
}

TEST_CASE("A misspelt required key is one error, not two") {
  check_error("[domain]\nbox = [0, 1]\n[water]\nspacng = 0.1\ndepth = 1\n[time]\nend = 1\n",
              "scene.toml:4:1: error: unknown key 'water.spacng'\n"
              "  spacng = 0.1\n"
              "  ^\n"
              "  help: did you mean 'spacing'?");
}

TEST_CASE("Keys that exclude each other are an error at the second") {
  check_error(pond("[bed]\nz = 0\nshape = { type = \"slope\", gradient = 0.1 }\n"),
              "scene.toml:10:1: error: 'bed.z' and 'bed.shape' exclude each other\n"
              "  shape = { type = \"slope\", gradient = 0.1 }\n"
              "  ^\n"
              "  help: keep one of them");
}

TEST_CASE("Names of gauges are unique") {
  check_error(pond("[[gauge]]\nname = \"g\"\nat = [1, 2]\n[[gauge]]\nname = \"g\"\nat = [2, 2]\n"),
              "scene.toml:12:8: error: the name 'g' stands for two of them\n"
              "  name = \"g\"\n"
              "         ^\n"
              "  help: results are listed by name");
}

TEST_CASE("A data error beside a scene error counts as a scene error") {
  const test::Failure found = failure(pond("[bed]\nfile = \"none.asc\"\nmannning = 0.1\n"));
  CHECK(found.exit == Exit::scene);
  CHECK_THAT(found.text, Catch::Contains("cannot find the file") && Catch::Contains("'bed.mannning'"));
}

TEST_CASE("A misspelt exact solution causes no errors where it is used") {
  const test::Failure found = failure(
      "[domain]\nbox = [0, 0, 1, 1]\n[water]\ndepth = { exact = true }\nspacing = 0.1\n"
      "[time]\nend = { periods = 1 }\n[compare]\nexact = { type = \"thacker-plannar\" }\n");
  CHECK(found.text ==
        "scene.toml:9:18: error: 'compare.exact.type' is 'thacker-plannar'; it must be one of 'stoker', "
        "'ritter', 'thacker-planar', 'thacker-radial', 'radial-dam-break', "
        "'gaussian-hump', 'eddy', 'riemann', 'beach-wave', 'rest', 'bump' or 'macdonald'\n"
        "  exact = { type = \"thacker-plannar\" }\n"
        "                   ^\n"
        "  help: did you mean 'thacker-planar'?");
}

TEST_CASE("All errors of meaning are shown together, in the order of the file") {
  const std::string text = failure(pond("[sph]\neta = -1\n[scene]\nname = 3\n[limits]\nspede = 1\n")).text;
  const std::size_t eta = text.find("scene.toml:9:7:"), name = text.find("scene.toml:11:8:");
  const std::size_t speed = text.find("scene.toml:13:1:");
  REQUIRE(speed != std::string::npos);
  CHECK(eta < name);
  CHECK(name < speed);
}

TEST_CASE("Of a syntax error the first is shown") {
  const test::Failure found = failure("[scene]\nname = \"x\n[domain\n");
  CHECK(found.exit == Exit::scene);
  CHECK_THAT(found.text,
             Catch::StartsWith("scene.toml:2:10: error: ") && Catch::Contains("\n  name = \"x\n"));
  CHECK(found.text.find("scene.toml:3") == std::string::npos);
}

TEST_CASE("The caret stands under its column after tabs and multi-byte letters") {
  check_error(pond("[limits]\n\tspeed = -1\n"),
              "scene.toml:9:10: error: 'limits.speed' is -1; it must be positive\n"
              "  \tspeed = -1\n"
              "  \t        ^");
  check_error(pond("[compare]\nexact = { type = \"rest\", \"lüvel\" = 1, level = 1 }\n"),
              "scene.toml:9:26: error: unknown key 'compare.exact.lüvel'\n"
              "  exact = { type = \"rest\", \"lüvel\" = 1, level = 1 }\n"
              "                           ^\n"
              "  help: did you mean 'level'?");
}

TEST_CASE("A scene file that cannot be read is a scene error") {
  CHECK_THROWS_AS(read_scene("/no/such/scene.toml"), SceneError);
}
