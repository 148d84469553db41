// Walls as a scene names them: polygons, circles, holes, leaks, and where water starts among them.
#include <catch2/catch.hpp>

#include <cmath>

#include "src/scene/place/place.hpp"
#include "src/scene/place/water_region.hpp"
#include "tests/support/run/scene_files.hpp"

using namespace freshet;
using freshet::test::failure;
using freshet::test::read_text;

namespace {

Scene tank(const std::string& walls) {
  return read_text("[domain]\nbox = [0, 0, 4, 4]\n[water]\nsurface = 1\nspacing = 0.1\n[time]\nend = 1\n" +
                   walls);
}

std::string fault(const std::string& walls) {
  return failure("[domain]\nbox = [0, 0, 4, 4]\n[water]\nsurface = 1\nspacing = 0.1\n[time]\nend = 1\n" +
                 walls)
      .text;
}

bool says(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

double water_area(const Scene& scene) {
  double area = 0;
  for (const Placed& p : place(scene, scene.water.depth)) area += p.area;
  return area;
}

}  // namespace

TEST_CASE("Closed walls are turned so that the water is on their left") {
  for (const char* points : {"[[0, 0], [3, 0], [3, 2], [0, 2]]", "[[0, 2], [3, 2], [3, 0], [0, 0]]"}) {
    const std::string polygon = std::string("[[wall]]\npolygon = ") + points + "\nwater = ";
    const Scene in = tank(polygon + "\"inside\"\n"), out = tank(polygon + "\"outside\"\n");
    REQUIRE(in.walls.size() == 1);
    CHECK(in.walls[0].line.front() == in.walls[0].line.back());
    CHECK(signed_area(in.walls[0].line) == Approx(6));
    CHECK(signed_area(out.walls[0].line) == Approx(-6));
  }
}

TEST_CASE("A circle has the area that it is named with") {
  const Scene scene = tank("[[wall]]\ncircle = { centre = [2, 2], radius = 1.5 }\nwater = \"inside\"\n");
  CHECK(signed_area(scene.walls[0].line) == Approx(pi * 2.25).epsilon(1e-12));
  for (const Point& p : scene.walls[0].line)
    CHECK(std::hypot(p[0] - 2, p[1] - 2) == Approx(1.5).epsilon(1e-3));
}

TEST_CASE("Water starts on the wet side of closed walls, cut cells with their part of the area") {
  const std::string circle = "[[wall]]\ncircle = { centre = [2, 2], radius = 1.5 }\nwater = \"inside\"\n";
  const std::string hole =
      "[[wall]]\npolygon = [[1.5, 1.5], [2.5, 1.5], [2.5, 2.5], [1.5, 2.5]]\nwater = \"outside\"\n";
  const double disc = pi * 2.25;
  // Slivers below a quarter of a cell are left out: on average 1/32 of each cell along the wall, 94 dx long:
  // 0.03 m2; and the parts are counted in hundredths.
  CHECK(water_area(tank(circle)) == Approx(disc).margin(0.04));
  CHECK(water_area(tank(circle + hole)) == Approx(disc - 1).margin(0.04));
  for (const Placed& p : place(tank(circle + hole), [](double, double) { return 1.0; })) {
    CHECK(std::hypot(p.x[0] - 2, p.x[1] - 2) < 1.5);
    CHECK((std::abs(p.x[0] - 2) > 0.5 || std::abs(p.x[1] - 2) > 0.5));
  }
}

TEST_CASE("A wall that does not close is told with its gap") {
  const Scene open = tank("[[wall]]\nline = [[0, 0], [4, 0], [4, 4], [0, 4], [0, 0.25]]\n");
  REQUIRE(open.notes.size() == 2);  // both ends
  CHECK(says(open.notes[0], "0.25 m from the next wall"));
  const Scene closed = tank("[[wall]]\nline = [[0, 0], [4, 0], [4, 4], [0, 4], [0, 0]]\n");
  CHECK(closed.notes.empty());
  const Scene joined =
      tank("[[wall]]\nline = [[0, 0], [4, 0], [4, 4]]\n[[wall]]\nline = [[4, 4], [0, 4], [0, 0]]\n");
  CHECK(joined.notes.empty());
}

TEST_CASE("Walls and [sph] settings that cannot be are errors that say what to do") {
  CHECK(says(fault("[[wall]]\npolygon = [[0, 0], [1, 1], [1, 0], [0, 1]]\nwater = \"inside\"\n"),
             "crosses itself"));
  CHECK(says(fault("[[wall]]\npolygon = [[0, 0], [1, 1]]\nwater = \"inside\"\n"), "at least 3 points"));
  CHECK(says(fault("[[wall]]\npolygon = [[0, 0], [1, 0], [0, 1]]\n"), "water' is missing"));
  CHECK(says(fault("[[wall]]\nline = [[0, 0], [1, 0], [1, 0]]\n"), "repeats the one before it"));
  CHECK(says(fault("[[wall]]\nline = [[0, 0], [1, 0]]\n[sph]\nwalls = \"mirror\"\nslip = false\n"),
             "cannot hold"));
  CHECK(says(fault("[sisph]\nslip = false\n"), "slips along any wall"));
  CHECK(says(fault("[sph]\nstabilise = \"two-shock\"\nstrength = 0.5\n"), "strength"));
  CHECK(says(fault("[sph]\nviscosity = [1, 0]\n"), "viscosity"));
  CHECK(says(fault("[sph]\nprecision = \"single\"\n"), "mixed"));
  CHECK(says(fault("[sph]\nprecision = \"mixed\"\nnewton_tolerance = 1e-9\n"), "1e-6"));
  CHECK(says(fault("[sph]\nprecision = \"mixed\"\nwell_balanced = true\n"), "round-off"));
  CHECK(says(fault("[sph]\nwell_balanced = true\nacceleration = \"variational\"\n"), "well-balanced"));
}
