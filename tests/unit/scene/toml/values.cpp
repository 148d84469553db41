// Errors in what a scene's values mean: ranges, places, files, series, expressions; their places and help.
#include <catch2/catch.hpp>

#include "src/scene/place/place.hpp"
#include "tests/support/run/scene_files.hpp"

using namespace freshet;
using freshet::test::check_error;
using freshet::test::Directory;
using freshet::test::failure;
using freshet::test::pond;

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

TEST_CASE("A gauge outside the domain is an error that states the domain") {
  check_error(pond("[[gauge]]\nname = \"g\"\nat = [11.0, 2.0]\n"),
              "scene.toml:10:6: error: the gauge at (11, 2) lies outside the domain\n"
              "  at = [11.0, 2.0]\n"
              "       ^\n"
              "  help: the domain reaches from (0, 0) to (10, 5)");
  CHECK(failure(pond("[[gauge]]\nname = \"edge\"\nat = [10.0, 5.0]\n")).text == "");
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

TEST_CASE("The state of the exact solution needs one") {
  check_error("[domain]\nbox = [0, 1]\n[water]\nspacing = 0.1\ndepth = { exact = true }\n[time]\nend = 1\n",
              "scene.toml:5:19: error: no exact solution is named\n"
              "  depth = { exact = true }\n"
              "                    ^\n"
              "  help: add 'exact = { type = ... }' under [compare]");
}
