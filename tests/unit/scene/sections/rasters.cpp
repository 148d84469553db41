// [raster] and water.disorder: defaults, what is asked for, errors.
#include <catch2/catch.hpp>

#include "src/scene/place/place.hpp"
#include "tests/support/run/scene_files.hpp"

using namespace freshet;
using test::failure;
using test::pond;
using test::read_text;

TEST_CASE("raster: absent unless named, with the defaults of the read-me") {
  CHECK_FALSE(read_text(pond()).rasters);
  const Scene scene = read_text(pond("[output]\nevery = 2\n[raster]\nwhat = [\"depth\", \"speed\"]\n"));
  REQUIRE(scene.rasters);
  CHECK(scene.rasters->spacing == 1.0);  // twice the water's
  CHECK(scene.rasters->every == 2);
  CHECK(scene.rasters->what ==
        std::vector<Rasters::Quantity>{Rasters::Quantity::depth, Rasters::Quantity::speed});
  CHECK_FALSE(scene.rasters->maxima);
  CHECK(scene.rasters->arrival == 0.01);
}

TEST_CASE("raster: every key is read, and the scene's text reads back to the same") {
  const std::string text = pond(
      "[raster]\nspacing = 0.7\nevery = 3\nwhat = [\"surface\", \"u\", \"v\"]\nmaxima = true\narrival = "
      "0.05\n");
  for (const Scene& scene : {read_text(text), read_text(read_text(text).text)}) {
    REQUIRE(scene.rasters);
    CHECK(scene.rasters->spacing == 0.7);
    CHECK(scene.rasters->every == 3);
    CHECK(scene.rasters->what.size() == 3);
    CHECK(scene.rasters->maxima);
    CHECK(scene.rasters->arrival == 0.05);
  }
}

TEST_CASE("raster: errors say what is wanted") {
  CHECK(
      failure(pond("[raster]\nwhat = [\"depth\", \"sped\"]\n")).text ==
      "scene.toml:9:18: error: 'raster.what' holds 'sped'; wanted: 'depth', 'surface', 'u', 'v' or 'speed'\n"
      "  what = [\"depth\", \"sped\"]\n"
      "                   ^\n"
      "  help: did you mean 'speed'?");
  CHECK_THAT(failure(pond("[raster]\nwhat = \"depth\"\n")).text,
             Catch::Contains("'raster.what' must be an array of 'depth'"));
  CHECK_THAT(failure(pond("[raster]\nspacing = 1\n")).text, Catch::Contains("[raster] asks for nothing"));
  CHECK_THAT(failure(pond("[raster]\nmaxima = true\nspacing = 0\n")).text,
             Catch::Contains("it must be positive"));
  CHECK_THAT(failure("[domain]\nbox = [0, 10]\n[water]\nsurface = 1\nspacing = 0.5\n[time]\nend = "
                     "10\n[raster]\nmaxima = true\n")
                 .text,
             Catch::Contains("a raster needs a 2-D scene"));
}

namespace {

std::vector<Placed> placed(const std::string& keys) {
  const Scene scene =
      read_text("[domain]\nbox = [0, 0, 10, 5]\n[water]\ndepth = \"1 + 0.1*x\"\nspacing = 0.5\n" + keys +
                "[time]\nend = 10\n");
  return place(scene, scene.water.depth);
}

}  // namespace

TEST_CASE("disorder: moves every particle within its bound, the same way for the same seed") {
  const auto lattice = placed(""), moved = placed("disorder = 0.3\n"),
             again = placed("disorder = 0.3\nseed = 1\n"), other = placed("disorder = 0.3\nseed = 2\n");
  REQUIRE(moved.size() == lattice.size());
  double most = 0, sum = 0, repeated = 0, same = 0;
  for (std::size_t k = 0; k < moved.size(); ++k)
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double off = moved[k].x[axis] - lattice[k].x[axis];
      most = std::max(most, std::abs(off));
      sum += off;
      repeated += moved[k].x[axis] == again[k].x[axis];
      same += moved[k].x[axis] == other[k].x[axis];
    }
  CHECK(most <= 0.3 * 0.5);
  CHECK(most > 0.29 * 0.5);                     // 400 numbers: the largest is nearly the bound
  CHECK(std::abs(sum / 400) < 4 * 0.087 / 20);  // uniform on +-0.15: deviation 0.087, four of the mean's
  CHECK(repeated == 400);
  CHECK(same == 0);
  CHECK(moved[7].depth == Approx(1 + 0.1 * moved[7].x[0]));  // the depth of the place that it moved to
}

TEST_CASE("disorder: is of cells") {
  CHECK_THAT(failure("[domain]\nbox = [0, 10]\n[water]\nsurface = 1\nspacing = 0.5\nstart = "
                     "\"equal-mass\"\ndisorder = 0.1\n[time]\nend = 10\n")
                 .text,
             Catch::Contains("'water.disorder' moves cells, and 'water.start' is 'equal-mass'"));
}
