// What the sections give: defaults, expressions, shapes, walls and boundaries.
#include <catch2/catch.hpp>

#include <cmath>

#include "cellgrid/parallel/types.hpp"
#include "src/reference/exact.hpp"
#include "tests/support/run/scene_files.hpp"

using namespace freshet;
using freshet::test::failure;
using freshet::test::pond;
using freshet::test::read_text;

namespace {

std::string canal(const std::string& more = "") {
  return "[domain]\nbox = [0, 10]\n[water]\nsurface = 1\nspacing = 0.5\n[time]\nend = 10\n" + more;
}

std::vector<Point> corners(std::initializer_list<Point> points) { return points; }

}  // namespace

TEST_CASE("Defaults are those of the method") {
  const Scene pool = read_text(pond());
  CHECK(pool.name == "scene");
  CHECK(pool.method == "sph-swe");
  CHECK(pool.gravity == 9.81);
  CHECK_FALSE(pool.manning);
  CHECK_FALSE(pool.bed.elevation);
  CHECK(pool.sph.eta == 1.2);
  CHECK(std::holds_alternative<swe::LaxFriedrichsMuscl>(pool.sph.stabilisation));
  CHECK(pool.sph.acceleration == Acceleration::variational);
  CHECK(pool.water.start == Water::Start::cells);
  CHECK_FALSE(pool.compare.exact);
  const Scene line = read_text(canal());
  CHECK(line.domain.dimension == 1);
  CHECK(line.sph.eta == 1.0);
}

TEST_CASE("Scenes with an exact solution take the classical acceleration unless they say otherwise") {
  const std::string rest = "[compare]\nexact = { type = \"rest\", level = 1 }\n";
  CHECK(read_text(pond(rest)).sph.acceleration == Acceleration::classical);
  CHECK(read_text(pond(rest + "[sph]\nacceleration = \"variational\"\n")).sph.acceleration ==
        Acceleration::variational);
}

TEST_CASE("Expressions know x, y, pi, g, comparisons and the ternary") {
  const Scene scene = read_text(
      pond("[scene]\ngravity = 1.62\n[bed]\nz = \"g*x + cos(pi*y) + (x > 4 && y < 2 ? 100 : 0)\"\n"));
  CHECK(scene.bed.elevation(2, 1) == Approx(1.62 * 2 - 1));
  CHECK(scene.bed.elevation(5, 1) == Approx(1.62 * 5 - 1 + 100));
  CHECK(scene.bed.elevation(2, 0) == Approx(1.62 * 2 + 1));
}

TEST_CASE("Powers bind more tightly than a sign and log is not offered in two meanings") {
  CHECK(read_text(pond("[bed]\nz = \"-x^2\"\n")).bed.elevation(3, 0) == Approx(-9));
  CHECK(read_text(pond("[bed]\nz = \"ln(x + 1) + log10(100)\"\n")).bed.elevation(std::exp(1.0) - 1, 0) ==
        Approx(3));
}

TEST_CASE("Assignments and lists are not expressions") {
  CHECK_THAT(failure(pond("[bed]\nz = \"x = 3\"\n")).text,
             Catch::StartsWith("scene.toml:9:8: error: in 'bed.z': '=' assigns; it cannot stand here"));
  CHECK_THAT(failure(pond("[bed]\nz = \"1,5\"\n")).text,
             Catch::StartsWith("scene.toml:9:7: error: in 'bed.z': one value is wanted"));
}

TEST_CASE("A surface becomes a depth over the bed, a depth does not") {
  const Scene surface = read_text(canal("[bed]\nz = \"0.1*x\"\n"));
  CHECK(surface.water.depth(2, 0) == Approx(0.8));
  CHECK(surface.water.surface(2, 0) == 1);
  const Scene depth = read_text(pond("[bed]\nz = \"0.1*x\"\n"));
  CHECK(depth.water.depth(2, 0) == 1);
  CHECK_FALSE(depth.water.surface);
}

TEST_CASE("Velocities are expressions, one per axis") {
  const Scene scene = read_text(pond(), {"water.velocity=[\"-y\", 0.5]"});
  CHECK(scene.water.velocity[0](0, 2) == -2);
  CHECK(scene.water.velocity[1](0, 2) == 0.5);
  CHECK_THAT(failure(canal(), {"water.velocity=[1, 2]"}).text,
             Catch::Contains("'water.velocity' must be one number or expression, [u] in m/s"));
}

TEST_CASE("The hump of thesis (1.13) is the shape with height 2c, middle 0.5 and width 0.5") {
  const Scene scene =
      read_text(canal("[bed]\nshape = { type = \"hump\", height = 0.1, at = 0.5, width = 0.5 }\n"));
  const double c = 0.05;
  for (const double x : {0.1, 0.25, 0.3, 0.5, 0.62, 0.75, 0.9}) {
    const double thesis = x > 0.25 && x < 0.75 ? c * (1 + std::sin(pi * (4 * x + 0.5))) : 0.0;
    CHECK(scene.bed.elevation(x, 0) == Approx(thesis).margin(1e-15));  // rounding of sin and cos
  }
}

TEST_CASE("Shapes: round hump, ridge, step, paraboloid, slope") {
  const auto shape = [](const std::string& keys) {
    return read_text(pond("[bed]\nshape = { " + keys + " }\n")).bed.elevation;
  };
  CHECK(shape("type = \"hump\", height = 2, at = [3, 4], width = 2")(3.5, 4) == Approx(1));
  CHECK(shape("type = \"hump\", height = 2, at = [3, 4], width = 2")(3, 1) == 0);
  CHECK(shape("type = \"hump\", height = 2, at = 3, width = 2")(3, 1) == Approx(2));
  CHECK(shape("type = \"step\", at = 3, left = 1, right = 2")(3.5, 0) == 2);
  CHECK(shape("type = \"paraboloid\", depth = 10, radius = 5, centre = [1, 0]")(1, 5) ==
        Approx(0).margin(1e-12));
  CHECK(shape("type = \"paraboloid\", depth = 10, radius = 5, centre = [1, 0]")(1, 0) == Approx(-10));
  CHECK(shape("type = \"slope\", gradient = [0.1, 0.2], from = [1, 1], level = 3")(2, 2) == Approx(3.3));
  CHECK(shape("type = \"slope\", gradient = 0.1")(2, 2) == Approx(0.2));
}

TEST_CASE("Keys that belong to files are refused for other beds") {
  CHECK_THAT(failure(pond("[bed]\nz = 0\nvertical = \"down\"\n")).text,
             Catch::StartsWith("scene.toml:10:1: error: 'bed.vertical' applies to 'bed.file' only"));
}

TEST_CASE("Box walls run counter-clockwise around the water") {
  const Scene scene = read_text(pond("[[wall]]\nline = \"box\"\n"));
  REQUIRE(scene.walls.size() == 1);
  CHECK(scene.walls[0].line == corners({{0, 0}, {10, 0}, {10, 5}, {0, 5}, {0, 0}}));
}

TEST_CASE("Open boundaries are left out of box walls, wherever they stand in the file") {
  const std::string open = "[[boundary]]\ntype = \"wave\"\nlevel = 0\n";
  const auto walls = [&](const std::string& where) {
    return read_text(pond("[[wall]]\nline = \"box\"\n" + open + where + "\n")).walls;
  };
  CHECK(walls("side = \"left\"")[0].line == corners({{0, 0}, {10, 0}, {10, 5}, {0, 5}}));
  CHECK(walls("side = \"bottom\"")[0].line == corners({{10, 0}, {10, 5}, {0, 5}, {0, 0}}));
  CHECK(walls("side = \"right\"")[0].line == corners({{10, 5}, {0, 5}, {0, 0}, {10, 0}}));
  // A boundary on part of a side leaves the rest of it closed.
  CHECK(walls("line = [[0, 4], [0, 1]]")[0].line ==
        corners({{0, 1}, {0, 0}, {10, 0}, {10, 5}, {0, 5}, {0, 4}}));
  // A boundary inside the domain opens nothing.
  CHECK(walls("line = [[2, 4], [2, 1]]")[0].line.size() == 5);
}

TEST_CASE("In one dimension walls are the ends, less an open one") {
  CHECK(read_text(canal("[[wall]]\nline = \"box\"\n")).walls.size() == 2);
  const Scene open = read_text(
      canal("[[boundary]]\ntype = \"elevation\"\nlevel = 1\nside = \"left\"\n[[wall]]\nline = \"box\"\n"));
  REQUIRE(open.walls.size() == 1);
  CHECK(open.walls[0].line == corners({{10, 0}}));
  CHECK(read_text(canal("[[wall]]\nat = 3\n")).walls[0].line == corners({{3, 0}}));
}

TEST_CASE("The water is on the left of every side") {
  for (const char* side : {"left", "right", "bottom", "top"}) {
    const Scene scene =
        read_text(pond("[[boundary]]\ntype = \"wave\"\nlevel = 0.2\nside = \"" + std::string(side) + "\"\n"));
    const auto& line = scene.boundaries[0].line;
    const Point middle{5, 2.5};
    const double cross = (line[1][0] - line[0][0]) * (middle[1] - line[0][1]) -
                         (line[1][1] - line[0][1]) * (middle[0] - line[0][0]);
    CHECK(cross > 0);
    CHECK(scene.boundaries[0].imposed.at(0).series.at(3) == 0.2);
  }
  const auto left =
      read_text(canal("[[boundary]]\ntype = \"wave\"\nlevel = 0\nside = \"left\"\n")).boundaries[0].line;
  CHECK((left[1][1] - left[0][1]) * -1 > 0);  // downwards: x > 0 is on its left
}

TEST_CASE("Lines and sides that do not fit the dimension are errors") {
  CHECK_THAT(failure(canal("[[wall]]\nline = [[0, 0], [0, 1]]\n")).text,
             Catch::Contains("a 1-D scene has no lines"));
  CHECK_THAT(failure(canal("[[boundary]]\ntype = \"wave\"\nlevel = 0\nside = \"top\"\n")).text,
             Catch::Contains("it must be one of 'left' or 'right'"));
  CHECK_THAT(failure(pond("[[wall]]\nat = 3\n")).text, Catch::Contains("'wall.at' belongs to 1-D scenes"));
  CHECK_THAT(failure(pond("[[wall]]\nline = [[0, 0], [11, 1]]\n")).text,
             Catch::Contains("the wall at (11, 1) lies outside the domain"));
}

TEST_CASE("The comparison window follows the particle spacing and may lie around time.end") {
  const std::string dam =
      "[domain]\nbox = [0, 2000]\n[water]\ndepth = { exact = true }\nspacing = 20\nstart = \"equal-mass\"\n"
      "[time]\nend = 50\n[compare]\nexact = { type = \"stoker\", left = 10, right = 5, dam = 1000 }\n"
      "samples = 9\nwindow = { shock_cells = 2 }\n";
  // Two particles ahead of the shock, each 2 dx long, at 9.3538 m/s (four decimals given, hence 1e-5).
  const Scene before = read_text(dam);
  CHECK(before.compare.window == Approx(2 * 40 / 9.3538).epsilon(1e-5));
  CHECK(before.end_time == 50);
  const Scene around = read_text(dam + "spread = \"around\"\n", {"water.spacing=10"});
  CHECK(around.compare.window == Approx(2 * 20 / 9.3538).epsilon(1e-5));
  CHECK(around.end_time == Approx(50 + 20 / 9.3538).epsilon(1e-6));
  CHECK(around.water.depth(3, 0) == 10);
  CHECK(around.water.velocity[0](3, 0) == 0);
}

TEST_CASE("The read-back names extent, bed, boundaries and stations") {
  const std::vector<std::string> lines = describe(
      read_text(pond("[bed]\nz = \"-0.1*x\"\nmanning = 0.02\n[[boundary]]\nname = \"sea\"\ntype = \"wave\"\n"
                     "level = 0.1\nside = \"left\"\n[[gauge]]\nname = \"g\"\nat = [1, 2]\n")));
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  CHECK_THAT(text, Catch::Contains("2-D, x 0 to 10, y 0 to 5 m"));
  CHECK_THAT(text, Catch::Contains("expression -0.1*x, -1 to 0 m, lattice 0.5 m, not smoothed"));
  CHECK_THAT(text, Catch::Contains("Manning n = 0.02 s/m^(1/3)"));
  CHECK_THAT(text, Catch::Contains("sea: incoming wave, (0, 5) to (0, 0), level 0.1 m"));
  CHECK_THAT(text, Catch::Contains("g at (1, 2)"));
}
