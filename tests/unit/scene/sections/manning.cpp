// bed.manning: a number, a raster or regions, how the reader turns each into n by place, and the table that
// friction uses.
#include <catch2/catch.hpp>

#include "kernels/ground/nearest_table.hpp"
#include "tests/support/run/scene_files.hpp"

using namespace freshet;
using test::Directory;
using test::failure;
using test::pond;
using test::read_text;

namespace {

// 4 x 3 cells of 5 m from the origin; the first row is the highest y.
const char* const header = "ncols 4\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 5\nNODATA_value -9999\n";

Scene with_raster(const Directory& here, const std::string& rows, const std::string& keys) {
  here.write("n.asc", header + rows);
  return read_scene_text(pond("[bed]\nmanning = { file = \"n.asc\"" + keys + " }\n"),
                         here.path() + "/scene.toml");
}

test::Failure raster_failure(const std::string& rows, const std::string& keys) {
  const Directory here;
  here.write("n.asc", header + rows);
  return failure(pond("[bed]\nmanning = { file = \"n.asc\"" + keys + " }\n"), {},
                 here.path() + "/scene.toml");
}

const char* const rows = "0.04 0.04 0.05 0.05\n0.03 0.03 0.03 0.03\n0.01 0.02 0.03 0.04\n";

}  // namespace

TEST_CASE("manning: a number is n everywhere and makes no map") {
  const Scene scene = read_text(pond("[bed]\nmanning = 0.035\n"));
  REQUIRE(scene.manning);
  CHECK(scene.manning->n == 0.035);
  CHECK_FALSE(scene.manning->map);
}

TEST_CASE("manning: the first region that holds a place decides, the default holds elsewhere") {
  const Scene scene =
      read_text(pond("[bed]\nmanning = { default = 0.03, regions = [{ box = [0, 0, 4, 2], n = 0.1 }, "
                     "{ polygon = [[0, 0], [10, 0], [0, 5]], n = 0.05 }] }\n"));
  REQUIRE(scene.manning);
  const Function& n = scene.manning->map;
  REQUIRE(n);
  CHECK(n(1, 1) == 0.1);     // in both
  CHECK(n(1, 3) == 0.05);    // left of the line from (10, 0) to (0, 5)
  CHECK(n(6, 1.9) == 0.05);  // 6/10 + 1.9/5 = 0.98
  CHECK(n(6, 2.1) == 0.03);  // 1.02
  CHECK(n(9, 4) == 0.03);
  CHECK(scene.manning->step == Point{0.5, 0.5});  // the water's spacing where the bed has none
}

TEST_CASE("manning: a polygon may be concave") {
  // A U of arms 1 m wide.
  const Scene scene =
      read_text(pond("[bed]\nmanning = { default = 0.01, regions = [{ n = 0.2, polygon = "
                     "[[0, 0], [3, 0], [3, 3], [2, 3], [2, 1], [1, 1], [1, 3], [0, 3]] }] }\n"));
  CHECK(scene.manning->map(0.5, 2) == 0.2);
  CHECK(scene.manning->map(1.5, 2) == 0.01);
  CHECK(scene.manning->map(2.5, 2) == 0.2);
  CHECK(scene.manning->map(1.5, 0.5) == 0.2);
}

TEST_CASE("manning: in 1-D a box is an interval") {
  const Scene scene = read_text(
      "[domain]\nbox = [0, 10]\n[water]\nsurface = 1\nspacing = 0.5\n[time]\nend = 10\n"
      "[bed]\nmanning = { default = 0.03, regions = [{ box = [2, 4], n = 0.1 }] }\n");
  CHECK(scene.manning->map(3, 0) == 0.1);
  CHECK(scene.manning->map(5, 0) == 0.03);
}

TEST_CASE("manning: a raster's value holds in its cell") {
  const Directory here;
  const Scene scene = with_raster(here, rows, ", registration = \"cell\"");
  const Function& n = scene.manning->map;
  CHECK(n(0.1, 0.1) == 0.01);  // cell (0, 0) from the origin to (5, 5)
  CHECK(n(4.9, 4.9) == 0.01);
  CHECK(n(5.1, 4.9) == 0.02);
  CHECK(n(9.9, 0.1) == 0.02);
  CHECK(n(4.9, 5.1) == 0.03);
  CHECK(scene.manning->node == Point{2.5, 2.5});
  const Scene nodes = with_raster(here, rows, ", registration = \"node\"");
  CHECK(nodes.manning->map(2.4, 2.4) == 0.01);  // node (0, 0) on the corner
  CHECK(nodes.manning->map(2.6, 2.4) == 0.02);
}

TEST_CASE("manning: missing values and places outside a raster take the default") {
  const Directory here;
  const Scene scene = with_raster(here, "0.04 0.04 0.05 0.05\n0.03 0.03 0.03 0.03\n-9999 0.02 0.03 0.04\n",
                                  ", registration = \"cell\", default = 0.07");
  CHECK(scene.manning->map(1, 1) == 0.07);
  CHECK(scene.manning->map(6, 1) == 0.02);
  CHECK(scene.manning->map(-1, 1) == 0.07);
}

TEST_CASE("manning: errors name file, line, what is wrong and what to do") {
  CHECK(failure(pond("[bed]\nmanning = { default = 0.03, regions = [{ box = [0, 0, 4, 2], n = 30 }] }\n"))
            .text ==
        "scene.toml:9:66: error: 'bed.manning.regions.0.n' is 30; it must be at most 1\n"
        "  manning = { default = 0.03, regions = [{ box = [0, 0, 4, 2], n = 30 }] }\n"
        "                                                                   ^\n"
        "  help: n is 0.01 (concrete) to 0.2 (forest) s/m^(1/3); a Strickler coefficient of 30 is n = 1/30");
  const auto wrong = [](const std::string& manning) {
    return failure(pond("[bed]\nmanning = " + manning + "\n")).text;
  };
  CHECK_THAT(wrong("{ regions = [{ box = [0, 0, 1, 1], n = 0.1 }] }"),
             Catch::Contains("'bed.manning.default' is missing"));
  CHECK_THAT(wrong("{ default = 0.03, regions = [{ box = [0, 0, 1, 1] }] }"),
             Catch::Contains("'bed.manning.regions.0.n' is missing"));
  CHECK_THAT(wrong("{ default = 0.03, regions = [{ n = 0.1 }] }"),
             Catch::Contains("one of 'box' or 'polygon' is missing"));
  CHECK_THAT(wrong("{ default = 0.03, regions = [{ box = [0, 1], n = 0.1 }] }"),
             Catch::Contains("must be [x0, y0, x1, y1], its low corner first"));
  CHECK_THAT(wrong("{ default = 0.03, regions = [{ polygon = [[0, 0], [1, 1]], n = 0.1 }] }"),
             Catch::Contains("must have three points at least"));
  CHECK_THAT(wrong("{ default = 0.03 }"), Catch::Contains("one of 'file' or 'regions' is missing"));
}

TEST_CASE("manning: errors of a raster name it and the place") {
  const test::Failure strickler = raster_failure(
      "0.04 0.04 0.05 0.05\n0.03 0.03 30 0.03\n0.01 0.02 0.03 0.04\n", ", registration = \"cell\"");
  CHECK(strickler.exit == Exit::data);
  CHECK_THAT(strickler.text,
             Catch::Contains("'n.asc' has n = 30 at (12.5, 7.5); it must be between 0 and 1"));
  CHECK_THAT(raster_failure("1 2\n", ", registration = \"cell\"").text,
             Catch::Contains("n.asc:7: the header promises 4 x 3 = 12 values"));
  CHECK_THAT(raster_failure(rows, "").text, Catch::Contains("'bed.manning.registration' is missing"));
  CHECK_THAT(raster_failure("0.04 0.04 0.05 0.05\n0.03 0.03 0.03 0.03\n-9999 0.02 0.03 0.04\n",
                            ", registration = \"cell\"")
                 .text,
             Catch::Contains("'n.asc' has no value at (2.5, 2.5)"));
  const Directory here;
  here.write("n.asc", "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 3\n0.1 0.1\n0.1 0.1\n");
  CHECK_THAT(failure(pond("[bed]\nmanning = { file = \"n.asc\", registration = \"cell\" }\n"), {},
                     here.path() + "/scene.toml")
                 .text,
             Catch::Contains("'n.asc' covers x = 0 to 6 m, the domain 0 to 10 m"));
}

TEST_CASE("manning: a table of the nearest values, in packs as in scalars, constant beyond its rim") {
  const auto value = [](double x, double y) { return std::floor(x) + 10 * std::floor(y); };
  const NearestTable table(value, {{0, 0}, {10, 5}, {0.5, 0.5}, {1, 1}});
  REQUIRE(table.given());
  CHECK_FALSE(NearestTable{}.given());
  double worst = 0;
  for (int k = 0; k < 200; ++k) {
    const double x = 10 * std::fmod(k * 0.7548776662466927, 1.0),
                 y = 5 * std::fmod(k * 0.5698402909980532, 1.0);
    worst = std::max(worst, std::abs(table.at(Vec<double, 2>{x, y}) - value(x, y)));
    const Vec<Lane, 2> pack{Lane(x), Lane(y)};
    worst = std::max(worst, std::abs(lane_of(table.at(pack), lanes - 1) - value(x, y)));
  }
  CHECK(worst == 0);
  CHECK(table.at(Vec<double, 2>{-100, 2.5}) == table.at(Vec<double, 2>{0.5, 2.5}));
  CHECK(table.at(Vec<double, 2>{100, 200}) == table.at(Vec<double, 2>{9.9, 4.9}));
}
