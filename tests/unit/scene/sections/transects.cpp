// Measured profiles, scaled times and points that come from files.
#include <catch2/catch.hpp>

#include <cmath>

#include "tests/support/run/scene_files.hpp"

using namespace freshet;
using freshet::test::Directory;
using freshet::test::failure;
using freshet::test::pond;
using freshet::test::read_in;

TEST_CASE("Times of a series are scaled and shifted, profiles are measured over places") {
  const Directory here;
  here.write("g.csv", "0 1\n60 2\n");
  const Scene scene =
      read_in(here, pond("[[gauge]]\nname = \"g\"\nat = [1, 1]\nmeasured = { file = \"g.csv\", t_scale = "
                         "0.1, t_offset = -2 }\n"
                         "[[profile]]\nname = \"p\"\nline = [[0, 1], [10, 1]]\ntime = 5\n"
                         "measured = { file = \"g.csv\", x_scale = 0.1, scale = 2, offset = 1 }\n"));
  CHECK(scene.gauges[0].measured->t == std::vector<double>{-2, 4});
  CHECK(scene.profiles[0].measured->t == std::vector<double>{0, 6});
  CHECK(scene.profiles[0].measured->value == std::vector<double>{3, 5});
  CHECK(scene.profiles[0].at(2.5) == Point{2.5, 1});
  CHECK(scene.profiles[0].spacing == scene.water.spacing);
}

TEST_CASE("Profiles that cannot be taken are errors") {
  const auto error = [](const std::string& keys) {
    return failure(pond("[[profile]]\nname = \"p\"\n" + keys)).text;
  };
  CHECK_THAT(error("line = [[0, 1], [11, 1]]\ntime = 5\n"),
             Catch::Contains("the profile at (11, 1) lies outside the domain"));
  CHECK_THAT(error("line = [[0, 1], [0, 1]]\ntime = 5\n"),
             Catch::Contains("'profile.p.line' must have two different points"));
  CHECK_THAT(error("line = [[0, 1], [5, 1]]\ntime = 11\n"),
             Catch::Contains("it must be at most time.end (10)"));
  CHECK_THAT(error("line = [[0, 1], [5, 1]]\n"), Catch::Contains("time"));
}

TEST_CASE("Points may come from a file, with or without a title") {
  const Directory here;
  here.write("house.csv", std::string(GENERATE("", "x,y\n")) + "2.0,1.0\n4,1\n\n4,3\n");
  const Scene scene = read_in(here, pond("[[wall]]\npolygon = \"house.csv\"\nwater = \"outside\"\n"));
  REQUIRE(scene.walls.size() == 1);
  CHECK(scene.walls[0].line ==
        std::vector<Point>{{2, 1}, {4, 3}, {4, 1}, {2, 1}});  // clockwise: the water is on its left
  CHECK(scene.text.find(here.path() + "/house.csv") != std::string::npos);  // so that a resume finds it
}

TEST_CASE("A file of points with anything else in it is a data error that names its line") {
  const Directory here;
  here.write("house.csv", "2,1\n4,high\n4,3\n");
  const test::Failure found = failure(pond("[[wall]]\npolygon = \"house.csv\"\nwater = \"outside\"\n"), {},
                                      here.path() + "/scene.toml");
  CHECK(found.exit == Exit::data);
  CHECK_THAT(found.text, Catch::Contains("house.csv:2: this is not a point, x and y in m"));
}
