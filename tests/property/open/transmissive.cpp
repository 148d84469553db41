// Transmissive boundaries where nothing pushes the water out: slow flow, flow along the line, shorelines that
// cross it.
#include <catch2/catch.hpp>

#include "tests/support/run/scenes.hpp"

using namespace freshet;
using test::Flow;

namespace {

OpenBoundary open_line(const char* name, const OpenLaw& law, std::vector<freshet::Point> line) {
  OpenBoundary boundary;
  boundary.name = name;
  boundary.law = law;
  boundary.line = std::move(line);
  return boundary;
}

// 1 m3/s runs down a slope of 1:100 that also leans towards the open side along it, and leaves through that
// or through the open end.
Scene leaning_slope() {
  Scene scene = test::bare_scene(2, {0, 0}, {40, 20}, 0.5);
  scene.bed.elevation = [](double x, double y) { return -0.01 * x + 0.02 * y; };
  scene.bed.spacing = 0.5;
  scene.manning = 0.03;
  scene.water.depth = [](double, double) { return 0.0; };
  scene.boundaries = {open_line("in", ImposedDischarge{}, {{0, 8}, {0, 4}}),
                      open_line("side", Transmissive{}, {{0, 0}, {40, 0}}),
                      open_line("end", Transmissive{}, {{40, 0}, {40, 20}})};
  test::impose(scene.boundaries[0], "discharge", {{0}, {1}});
  scene.walls = {Wall{{{40, 20}, {0, 20}, {0, 8}}}, Wall{{{0, 4}, {0, 0}}}};
  return scene;
}

}  // namespace

TEST_CASE("transmissive: what flows along a line at a shoreline leaves and does not come back") {
  Flow flow(leaning_slope());
  flow.run(60);
  const Totals half = flow.method->totals();
  flow.run(120);
  const Totals t = flow.method->totals();
  // The discharge brings 120 m3; a line that lets out may let the troughs of small waves in: 5 %.
  CHECK(t.inflow >= 0.99 * 120);
  CHECK(t.inflow <= 1.05 * 120);
  // Normal depth at 0.25 m2/s on 1:100 is 0.17 m, so the plane cannot hold more than 800 m2 x 0.2 m = 160 m3;
  // the water drops to the open side within 8 m: it comes nowhere near.
  CHECK(t.mass < 60);
  CHECK(std::abs(t.mass - half.mass) < 0.1 * half.mass);  // steady after a minute, four passages
  CHECK(std::abs(t.mass - t.inflow + t.outflow) <= 1e-12 * t.inflow);
}

TEST_CASE("transmissive: still water up to a shoreline stays") {
  Scene scene = test::bare_scene(2, {0, 0}, {20, 20}, 0.5);
  scene.bed.elevation = [](double, double y) { return 0.05 * y - 0.5; };
  scene.bed.spacing = 0.5;
  scene.water.depth = [](double, double y) { return 0.5 - 0.05 * y; };
  scene.boundaries = {open_line("side", Transmissive{}, {{20, 0}, {20, 20}})};
  scene.walls = {Wall{{{20, 20}, {0, 20}, {0, 0}, {20, 0}}}};
  Flow flow(scene);
  const double initial = flow.method->totals().mass;
  flow.run(60);
  // Nothing outside holds the level: what the settling lattice pushes through the line, 1 % of the water,
  // stays away.
  CHECK(std::abs(flow.method->totals().mass / initial - 1) < 0.01);
  CHECK(flow.largest_speed() < 0.02 * std::sqrt(9.81 * 0.5));  // the thesis' bound for water with a shoreline
}
