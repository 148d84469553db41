// Two bodies of water that come together: what is between them is air until they touch, however near that
// makes their surfaces.
#include <catch2/catch.hpp>

#include "kernels/fpm/cells/area.hpp"
#include "tests/support/points/fpm_points.hpp"

using namespace freshet;
using test::FlowPoints;

namespace {

constexpr double dx = 0.1;  // m
constexpr int columns = 15, rows = 4;

// A slab below y = 0 and one above it, `gap` apart, the upper one half a spacing to the side.
std::vector<Point> slabs(double gap) {
  std::vector<Point> all;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      all.push_back({i * dx, -j * dx});
      all.push_back({(i + 0.5) * dx, gap + j * dx});
    }
  return all;
}

// What the cells say of the slabs; `open` is what they remember, by id.
struct Look {
  FlowPoints set;
  VecField<double, 2> open;
  fpm::Voronoi voronoi{fpm::VoronoiRule{}};
  std::vector<Vec<double, 2>> memory;
  // Away from the slabs' ends, whose points look outwards: surface points on the facing rows, places for new
  // points, area [m2].
  int facing = 0, inserted = 0;
  double area = 0;

  Look(double gap, const std::vector<Vec<double, 2>>& before) : set(slabs(gap), dx) {
    const int n = set.size();
    open = {Field<double>("open", static_cast<std::size_t>(n)),
            Field<double>("open", static_cast<std::size_t>(n))};
    const auto id = set.fields.integer("id"), surface = set.fields.integer("surface");
    for (int i = 0; i < n && !before.empty(); ++i) put(open, i, before[static_cast<std::size_t>(id(i))]);
    fpm::Cloud cloud = set.cloud();
    cloud.open = open;
    voronoi.find(cloud, n, surface);
    memory.resize(static_cast<std::size_t>(n));
    const fpm::Radii radii(voronoi.rule(), dx);
    for (int i = 0; i < n; ++i) {
      memory[static_cast<std::size_t>(id(i))] = at(open, i);
      const Point p = set.at(i);
      if (p[0] < 2.2 * dx || p[0] > 11.8 * dx) continue;
      facing += (p[1] == 0 || p[1] == gap) && surface(i) == 1;
      inserted += voronoi.missing()(i).kind != fpm::Gap::none;
      area += fpm::wet_area(fpm::cell_of(cloud, i, 1.3 * dx), cloud, i, radii);
    }
  }
};

}  // namespace

TEST_CASE(
    "fpm gap: two surfaces that approach stay surfaces, and no area or point comes of it, until they are one "
    "spacing apart") {
  std::vector<Vec<double, 2>> memory = Look(4 * dx, {}).memory;
  const Look apart(4 * dx, memory);
  REQUIRE(apart.facing > 15);
  for (double gap = 3.9 * dx; gap > 1.1 * dx; gap -= 0.1 * dx) {  // closed at a circle of 0.6 dx: gap 0.96 dx
    const Look look(gap, memory);
    CAPTURE(gap / dx);
    CHECK(look.facing == apart.facing);
    CHECK(look.inserted == 0);
    CHECK(look.area == Approx(apart.area).epsilon(1e-10));
    memory = look.memory;
  }
}

TEST_CASE("fpm gap: nearer than that it is water, and surfaces that part are found again") {
  std::vector<Vec<double, 2>> memory = Look(4 * dx, {}).memory;
  for (double gap = 3.9 * dx; gap > 1.1 * dx; gap -= 0.1 * dx) memory = Look(gap, memory).memory;
  const Look closed(0.8 * dx, memory);
  CHECK(closed.facing == 0);
  CHECK(closed.area > Look(4 * dx, {}).area + 0.7 * dx * 8 * dx);
  const Look still_closed(1.2 * dx, closed.memory);  // no memory of air: as a body of its own
  CHECK(still_closed.facing == 0);
  CHECK(Look(2.7 * dx, closed.memory).facing > 15);  // circles of 1.4 dx
}

TEST_CASE("fpm gap: without a memory the larger circle alone counts") {
  CHECK(Look(1.5 * dx, {}).facing == 0);
  CHECK(Look(3 * dx, {}).facing > 15);
}
