// [[boundary]]: what each type imposes, series written out, and the errors.
#include <catch2/catch.hpp>

#include "src/scene/read.hpp"
#include "tests/support/run/scene_files.hpp"

using namespace freshet;
using namespace freshet::test;

namespace {

const std::string square =
    "[domain]\nbox = [0, 0, 10, 10]\n[water]\ndepth = 1\nspacing = 0.5\n[time]\nend = 20\n";

OpenBoundary boundary(const std::string& keys) {
  return read_text(square + "[[boundary]]\nside = \"left\"\n" + keys).boundaries.at(0);
}
// What is imposed, `what` = "level".
Series series(const OpenBoundary& boundary, const std::string& what) {
  for (const OpenBoundary::Imposed& imposed : boundary.imposed)
    if (imposed.what == what) return imposed.series;
  return {};
}
std::string error(const std::string& keys) { return failure(square + "[[boundary]]\n" + keys).text; }

}  // namespace

TEST_CASE("boundary types read what they impose") {
  CHECK(series(boundary("type = \"velocity\"\nvelocity = 0.3\n"), "velocity").at(7) == 0.3);
  const OpenBoundary flood = boundary(
      "type = \"discharge\"\ndischarge = { times = [0, 10, 20], values = [0, 4, 2] }\n"
      "distribute = \"width\"\nspacing = 2\n");
  CHECK(series(flood, "discharge").at(5) == 2);
  CHECK(std::get<ImposedDischarge>(flood.at(15)).total == 3);
  CHECK(std::get<ImposedDischarge>(flood.law).by_width);
  CHECK(flood.spacing == 2);
  const OpenBoundary state = boundary("type = \"state\"\ndepth = 0.1\nvelocity = 4\n");
  const auto there = std::get<ImposedState>(state.at(0));
  CHECK(there.stage == 0.1);
  CHECK(there.above_bed);
  CHECK(there.inward == 4);
  CHECK_FALSE(std::get<Transmissive>(boundary("type = \"transmissive\"\n").law).levelled);
  const auto levelled = std::get<Transmissive>(boundary("type = \"transmissive\"\nlevel = 1\n").at(3));
  CHECK(levelled.levelled);
  CHECK(levelled.level == 1);
  CHECK(std::get<ImposedLevel>(
            boundary("type = \"elevation\"\nlevel = { times = [0, 20], values = [1, 2] }\n").at(10))
            .level == 1.5);
}

TEST_CASE("a boundary without a line is an error beside any wall") {
  const std::string wall = "[[wall]]\nline = [[0, 0], [10, 0]]\n";
  CHECK_THAT(error("type = \"transmissive\"\n" + wall),
             Catch::Contains("one of 'line' or 'side' is missing"));
}

TEST_CASE("a boundary may follow a bent line") {
  const Scene scene = read_text(square +
                                "[[boundary]]\nline = [[0, 4], [0, 0], [4, 0]]\ntype = \"transmissive\"\n"
                                "[[wall]]\nline = \"box\"\n");
  CHECK(scene.boundaries[0].line.size() == 3);
  REQUIRE(scene.walls.size() == 1);  // the rest of the box in one piece
  CHECK(scene.walls[0].line.size() == 5);
  CHECK(scene.walls[0].line.front() == Point{4, 0});
  CHECK(scene.walls[0].line.back() == Point{0, 4});
}

TEST_CASE("errors of boundaries say what to do") {
  CHECK_THAT(error("side = \"left\"\ntype = \"velocity\"\n"),
             Catch::Contains("'boundary.0.velocity' is missing"));
  CHECK_THAT(error("side = \"left\"\ntype = \"state\"\nvelocity = 1\n"),
             Catch::Contains("level") && Catch::Contains("depth"));
  CHECK_THAT(error("side = \"left\"\ntype = \"elevation\"\nlevel = 1\nvelocity = 1\n"),
             Catch::Contains("'boundary.0.velocity' belongs to 'velocity' or 'state'"));
  CHECK_THAT(error("side = \"left\"\ntype = \"discharge\"\ndischarge = { times = [0, 1], values = [1] }\n"),
             Catch::Contains("give one value for each time"));
  CHECK_THAT(
      error("side = \"left\"\ntype = \"discharge\"\ndischarge = { times = [0, 5, 5], values = [1, 2, 3] }\n"),
      Catch::Contains("the times must increase strictly"));
  CHECK_THAT(
      error("side = \"left\"\ntype = \"discharge\"\ndischarge = { times = [0, 5], values = [1, 2] }\n"),
      Catch::Contains("the series ends at t = 5 s, the run at 20 s"));
  CHECK_THAT(error("line = [[0, 4], [0, 0], [0.1, 4]]\ntype = \"transmissive\"\n"),
             Catch::Contains("bends by more than 120 degrees"));
  CHECK_THAT(error("line = [[0, 4]]\ntype = \"transmissive\"\n"), Catch::Contains("two or more points"));
  CHECK_THAT(error("side = \"left\"\ntype = \"transmissive\"\n[[boundary]]\nline = [[0, 4], [0, 1]]\ntype = "
                   "\"transmissive\"\n"),
             Catch::Contains("boundary 'boundary 2' lies on boundary 'boundary 1'"));
}

TEST_CASE("the read-back tells what boundaries impose") {
  std::string text;
  for (const std::string& line : describe(read_text(
           square + "[[boundary]]\nname = \"river\"\nside = \"left\"\ntype = \"discharge\"\nspacing = 1\n"
                    "discharge = { times = [0, 20], values = [0, 4] }\n[[boundary]]\nname = \"sea\"\nside = "
                    "\"right\"\n"
                    "type = \"transmissive\"\nlevel = 1\n")))
    text += line + '\n';
  CHECK_THAT(
      text, Catch::Contains("river: imposed discharge by conveyance, (0, 10) to (0, 0), 2 rows, t 0 to 20 s, "
                            "discharge 0 to 4 m3/s, spacing 1 m"));
  CHECK_THAT(text, Catch::Contains("sea: transmissive, (10, 0) to (10, 10), level 1 m"));
}

TEST_CASE("a series written out survives the round trip through the scene's text") {
  const Scene scene = read_text(square +
                                "[[boundary]]\nside = \"left\"\ntype = \"discharge\"\n"
                                "discharge = { times = [0, 10, 20], values = [0, 4, 2] }\n");
  const Scene again = read_text(scene.text);
  CHECK(again.text == scene.text);
  CHECK(series(again.boundaries.at(0), "discharge").value == std::vector<double>{0, 4, 2});
}
