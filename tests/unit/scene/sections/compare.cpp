// [compare]: the exact solutions and what is measured against them.
#include <catch2/catch.hpp>

#include "src/reference/exact.hpp"
#include "tests/support/run/scene_files.hpp"

using namespace freshet;
using freshet::test::failure;
using freshet::test::pond;
using freshet::test::read_text;

namespace {

const std::string dam =
    "[compare]\nexact = { type = \"radial-dam-break\", inner = 2, outer = 1, radius = 3, centre = [4, 5] }\n";

}  // namespace

TEST_CASE("The radial dam break is read with its centre") {
  const Scene scene = read_text(pond(dam));
  CHECK(scene.compare.exact->at(4, 5 + 2.9, 0).depth == 2);
  CHECK(scene.compare.exact->at(4 + 3.1, 5, 0).depth == 1);
  CHECK(scene.compare.exact->at(4, 5 + 3.1, 0.2).v > 0.5);
  CHECK_FALSE(scene.compare.steady);
}

TEST_CASE("A radial dam break that is none is refused") {
  CHECK_THAT(
      failure(pond("[compare]\nexact = { type = \"radial-dam-break\", inner = 1, outer = 2, radius = 3 }\n"))
          .text,
      Catch::Contains("'compare.exact.outer' is 2; it must be below 'inner' (1)"));
  CHECK_THAT(failure(pond("[bed]\nz = 0.1\n" + dam)).text,
             Catch::Contains("the radial dam break has a flat bed"));
}

TEST_CASE("Comparison times increase and lie in the run") {
  const Scene scene = read_text(pond(dam + "times = [0.5, 1]\n"));
  CHECK(scene.compare.times == std::vector<double>{0.5, 1});
  CHECK_THAT(failure(pond(dam + "times = [1, 0.5]\n")).text,
             Catch::Contains(
                 "'compare.times' holds 0.5 as number 2; the times must be above 0 and increase strictly"));
  CHECK_THAT(failure(pond(dam + "times = [1e9]\n")).text, Catch::Contains("the run ends before 1e+09 s"));
  CHECK_THAT(failure(pond("[compare]\ntimes = [1]\n")).text,
             Catch::Contains("'compare.times' needs an exact solution"));
}

TEST_CASE("Where errors count is an expression") {
  const Scene scene = read_text(pond(dam + "where = \"x < 3\"\n"));
  CHECK(scene.compare.where(2, 0) != 0);
  CHECK(scene.compare.where(4, 0) == 0);
  CHECK_FALSE(read_text(pond(dam)).compare.where);
  CHECK_THAT(failure(pond("[compare]\nwhere = \"x < 3\"\n")).text,
             Catch::Contains("'compare.where' needs an exact solution"));
}

TEST_CASE("Still water is watched unless the scene says otherwise") {
  const std::string rest = "[compare]\nexact = { type = \"rest\", level = 1 }\n";
  CHECK(read_text(pond(rest)).compare.steady);
  CHECK_FALSE(read_text(pond(rest + "steady = false\n")).compare.steady);
}
