// Every kind of error of meaning, with its exact place, caret and help.
#include <catch2/catch.hpp>

#include "src/scene/place/place.hpp"
#include "tests/support/run/scene_files.hpp"

using namespace freshet;
using freshet::test::Directory;
using freshet::test::failure;
using freshet::test::pond;
using freshet::test::read_text;

namespace {

void check_error(const std::string& scene, const std::string& expected) {
  const test::Failure found = failure(scene);
  CHECK(found.text == expected);
  CHECK(found.exit == Exit::scene);
}

}  // namespace

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

TEST_CASE("A number out of its range is an error") {
  check_error(pond("[bed]\nmanning = -0.01\n"),
              "scene.toml:9:11: error: 'bed.manning' is -0.01; it must be at least 0\n"
              "  manning = -0.01\n"
              "            ^");
  check_error(pond("[sph]\nh_floor = 1.5\n"),
              "scene.toml:9:11: error: 'sph.h_floor' is 1.5; it must be between 0 and 1\n"
              "  h_floor = 1.5\n"
              "            ^");
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

TEST_CASE("A gauge outside the domain is an error that states the domain") {
  check_error(pond("[[gauge]]\nname = \"g\"\nat = [11.0, 2.0]\n"),
              "scene.toml:10:6: error: the gauge at (11, 2) lies outside the domain\n"
              "  at = [11.0, 2.0]\n"
              "       ^\n"
              "  help: the domain reaches from (0, 0) to (10, 5)");
  CHECK(failure(pond("[[gauge]]\nname = \"edge\"\nat = [10.0, 5.0]\n")).text == "");
}

TEST_CASE("Names of gauges are unique") {
  check_error(pond("[[gauge]]\nname = \"g\"\nat = [1, 2]\n[[gauge]]\nname = \"g\"\nat = [2, 2]\n"),
              "scene.toml:12:8: error: the name 'g' stands for two of them\n"
              "  name = \"g\"\n"
              "         ^\n"
              "  help: results are listed by name");
}

TEST_CASE("A missing data file is a data error that says where it was looked for") {
  const Directory here;
  const std::string file = here.path() + "/scene.toml";
  const test::Failure found = failure(pond("[bed]\nfile = \"none.asc\"\n"), {}, file);
  CHECK(found.exit == Exit::data);
  CHECK_THAT(found.text, Catch::StartsWith(file +
                                           ":9:8: error: cannot find the file 'none.asc'\n"
                                           "  file = \"none.asc\"\n"
                                           "         ^\n"
                                           "  help: looked in " +
                                           here.path()));
}

TEST_CASE("An imposed series that does not span the run is a data error") {
  const Directory here;
  here.write("wave.csv", "t,eta\n1,0.1\n9,0.2\n");
  const test::Failure found = failure(pond("[[boundary]]\nside = \"left\"\ntype = \"elevation\"\n"
                                           "series = { file = \"wave.csv\", t = \"t\", value = \"eta\" }\n"),
                                      {}, here.path() + "/scene.toml");
  CHECK(found.exit == Exit::data);
  const std::string place = here.path() + "/scene.toml:11:10: error: ";
  const std::string line =
      "  series = { file = \"wave.csv\", t = \"t\", value = \"eta\" }\n"
      "           ^\n";
  CHECK(found.text == place + "the series begins at t = 1 s, the run at 0\n" + line +
                          "  help: add a row for t = 0\n\n" + place +
                          "the series ends at t = 9 s, the run at 10 s\n" + line +
                          "  help: lengthen the series or shorten time.end");
}

TEST_CASE("A data error beside a scene error counts as a scene error") {
  const test::Failure found = failure(pond("[bed]\nfile = \"none.asc\"\nmannning = 0.1\n"));
  CHECK(found.exit == Exit::scene);
  CHECK_THAT(found.text, Catch::Contains("cannot find the file") && Catch::Contains("'bed.mannning'"));
}

TEST_CASE("Errors inside an expression point into the string") {
  check_error(pond("[bed]\nz = \"0.1*x + foo*2\"\n"),
              "scene.toml:9:14: error: in 'bed.z': unknown name 'foo'\n"
              "  z = \"0.1*x + foo*2\"\n"
              "               ^\n"
              "  help: variables are x and y [m], constants pi and g");
  check_error(pond("[bed]\nz = \"\"\"\n1 + x*\n  sn(y)\"\"\"\n"),
              "scene.toml:11:3: error: in 'bed.z': unknown name 'sn'\n"
              "    sn(y)\"\"\"\n"
              "    ^\n"
              "  help: did you mean 'sin'?");
}

TEST_CASE("Expressions do not depend on time") {
  check_error(pond("[bed]\nz = \"sin(t)\"\n"),
              "scene.toml:9:10: error: in 'bed.z': unknown name 't'\n"
              "  z = \"sin(t)\"\n"
              "           ^\n"
              "  help: beds and initial states do not depend on time");
}

TEST_CASE("A bed that is not a number somewhere is an error that says where") {
  const test::Failure found = failure(pond("[bed]\nz = \"sqrt(4.9 - x)\"\n"));
  CHECK_THAT(found.text, Catch::StartsWith("scene.toml:9:5: error: the bed is not a number at (5, 0)\n"));
}

TEST_CASE("A boundary whose water lies outside the domain is the wrong way round") {
  check_error(
      pond("[[boundary]]\ntype = \"transmissive\"\nline = [[2, 5], [3, 5]]\n"),
      "scene.toml:10:8: error: the left of 'boundary.0.line', where its water is, lies outside the domain\n"
      "  line = [[2, 5], [3, 5]]\n"
      "         ^\n"
      "  help: reverse its points");
  CHECK(failure(pond("[[boundary]]\ntype = \"transmissive\"\nline = [[3, 5], [2, 5]]\n")).text == "");
}

TEST_CASE("A negative depth is an error, a level below zero is not") {
  const std::string rest = "spacing = 0.5\n[time]\nend = 10\n",
                    box = "[domain]\nbox = [0, 0, 10, 5]\n[water]\n";
  check_error(box + "depth = -0.5\n" + rest,
              "scene.toml:4:9: error: 'water.depth' is -0.5; it must be at least 0\n"
              "  depth = -0.5\n"
              "          ^\n"
              "  help: 0 is dry; levels are 'surface', depths are above the bed");
  CHECK(failure(box + "surface = -0.5\n" + rest + "[bed]\nz = -2\n").text == "");
  CHECK(failure(box + "depth = \"1 - x\"\n" + rest).text == "");  // dry where negative
}

TEST_CASE("More particles than the memory holds are refused, with the spacing that would do") {
  const Scene scene = test::read_text(pond(), {"water.spacing=1e-4"});
  CHECK_THROWS_WITH(place(scene, scene.water.depth),
                    Catch::Contains("this machine's memory does not hold") &&
                        Catch::Contains("a larger water.spacing than 0.0001 m"));
}

TEST_CASE("A raster of billions of cells is refused") {
  const std::string text = failure(pond("[raster]\nspacing = 1e-4\nwhat = [\"depth\"]\n")).text;
  CHECK_THAT(text, Catch::StartsWith(
                       "scene.toml:9:11: error: a raster of cells of 0.0001 m has 5000 million; at most"));
}

TEST_CASE("Periods need a periodic exact solution") {
  check_error(pond("[output]\nevery = { periods = 0.5 }\n"),
              "scene.toml:9:21: error: 'output.every.periods' needs a periodic exact solution\n"
              "  every = { periods = 0.5 }\n"
              "                      ^\n"
              "  help: name one under [compare], or give the duration in seconds");
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

TEST_CASE("The state of the exact solution needs one") {
  check_error("[domain]\nbox = [0, 1]\n[water]\nspacing = 0.1\ndepth = { exact = true }\n[time]\nend = 1\n",
              "scene.toml:5:19: error: no exact solution is named\n"
              "  depth = { exact = true }\n"
              "                    ^\n"
              "  help: add 'exact = { type = ... }' under [compare]");
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
