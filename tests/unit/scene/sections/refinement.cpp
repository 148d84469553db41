// [split] and [merge] as they are read.
#include <catch2/catch.hpp>

#include "tests/support/run/scene_files.hpp"

using namespace freshet;
using freshet::test::failure;
using freshet::test::pond;
using freshet::test::read_text;

namespace {

const std::string canal = "[domain]\nbox = [0, 10]\n[water]\nsurface = 1\nspacing = 0.5\n[time]\nend = 10\n";

bool says(const test::Failure& failed, const std::string& words) {
  return failed.text.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("Splitting and merging are off unless they are named") {
  CHECK_FALSE(read_text(pond()).split);
  CHECK_FALSE(read_text(pond()).merge);
}

TEST_CASE("Areas, regions and defaults of splitting and merging") {
  const Scene scene = read_text(
      pond("[split]\narea = 2.0\n[[split.region]]\nbox = [1, 0, 3, 2]\narea = 0.9\n[[split.region]]\n"
           "polygon = [[0, 0], [1, 0], [0, 1]]\narea = 3\n[merge]\narea = 0.4\nrelax = 5\n"));
  REQUIRE(scene.split);
  CHECK(*scene.split->area.elsewhere == 2);
  REQUIRE(scene.split->area.regions.size() == 2);
  CHECK(scene.split->area.regions[0].corners == std::vector<Point>{{1, 0}, {3, 0}, {3, 2}, {1, 2}});
  CHECK(scene.split->area.regions[0].area == 0.9);
  CHECK(scene.split->area.regions[1].corners.size() == 3);
  CHECK(scene.split->into == 7);
  CHECK(scene.split->alpha == 0.92);
  CHECK_FALSE(scene.split->linear);
  REQUIRE(scene.merge);
  CHECK(scene.merge->relax == 5);
  const Scene line = read_text(canal + "[split]\narea = 2\ninto = 2\n");
  CHECK(line.split->into == 2);
  CHECK(line.split->eps == 0.25);
  CHECK(read_text(canal + "[split]\n[[split.region]]\nbox = [2, 4]\narea = 1\n")
            .split->area.regions[0]
            .corners == std::vector<Point>{{2, 0}, {4, 0}});
}

TEST_CASE("Splitting that cannot be done is an error that says what to write") {
  CHECK(says(failure(pond("[split]\nalpha = 0.9\n")), "names neither an area nor a region"));
  CHECK(says(failure(pond("[split]\narea = 2\ninto = 3\n")), "7 in 2-D"));
  CHECK(says(failure(canal + "[split]\narea = 2\ninto = 7\n"), "between 2 and 3"));
  CHECK(says(failure(pond("[split]\n[[split.region]]\nbox = [3, 0, 1, 2]\narea = 1\n")), "low corner first"));
  CHECK(says(failure(canal + "[split]\n[[split.region]]\npolygon = [[0, 0], [1, 0], [0, 1]]\narea = 1\n"),
             "no polygons"));
  CHECK(says(failure(pond("[split]\n[[split.region]]\narea = 1\n")), "polygon"));
}
