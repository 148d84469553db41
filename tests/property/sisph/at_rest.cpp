// SISPH: still water over a rough bed with dry islands, conservation, what a step launches and allocates.
#include <catch2/catch.hpp>

#include "tests/support/run/scenes.hpp"
#include "tests/support/watch/recording.hpp"

using namespace freshet;
using test::Flow;

namespace {

Scene sisph_scene(int dimension, const freshet::Point& low, const freshet::Point& high, double spacing) {
  Scene scene = test::bare_scene(dimension, low, high, spacing);
  scene.method = "sisph";
  scene.sph.eta = scene.sisph.smoothing;
  return scene;
}

// Hills and hollows of a few cells; some hills are dry.
double rough(double x, double y) {
  return -0.5 + 0.6 * std::sin(11 * x) * std::cos(9 * y) + 0.2 * std::sin(29 * x + 17 * y);
}

Scene islands(double disorder) {
  Scene scene = sisph_scene(2, {0, 0}, {1.2, 1.2}, 0.04);
  scene.bed.elevation = rough;
  scene.water.surface = [](double, double) { return 0.0; };
  scene.water.depth = [](double x, double y) { return -rough(x, y); };
  scene.water.disorder = disorder;
  return scene;
}

// A hump in the middle of still water, away from the sides.
Scene hump(double disorder) {
  Scene scene = sisph_scene(2, {-1, -1}, {1, 1}, 0.05);
  scene.water.depth = [](double x, double y) { return 1 + 0.1 * std::exp(-50 * (x * x + y * y)); };
  scene.water.disorder = disorder;
  return scene;
}

int dry_particles(const Flow& flow) {
  int count = 0;
  for (int i = 0; i < flow.size(); ++i) count += flow.real("depth")(i) > 0 ? 0 : 1;
  return count;
}

}  // namespace

TEST_CASE("sisph: still water over a rough bed with dry islands stays still for 1000 steps") {
  Flow flow(islands(GENERATE(0.0, 0.2)));
  REQUIRE(dry_particles(flow) > 20);
  const double mass = flow.method->totals().mass;
  for (int n = 0; n < 1000; ++n) flow.step(0.02);  // celerity Courant number 1.5
  CHECK(flow.largest_speed() < 1e-12);
  CHECK(std::abs(flow.method->totals().mass / mass - 1) < 1e-13);
}

TEST_CASE("sisph: the mass is kept to round-off whatever the tolerance of the solver") {
  Scene scene = hump(0.2);
  scene.sisph.cg.tolerance = GENERATE(1e-2, 1e-8);
  Flow flow(scene);
  const double mass = flow.method->totals().mass;
  for (int n = 0; n < 10; ++n) flow.step(0.015);
  CHECK(flow.largest_speed() > 0.01);
  const Totals totals = flow.method->totals();
  CHECK(std::abs(totals.mass - totals.inflow + totals.outflow - mass) < 1e-13 * mass);
}

TEST_CASE("sisph: depths never fall below zero where water runs down a dry slope") {
  Scene scene = sisph_scene(1, {0, 0}, {10, 0}, 0.05);
  scene.bed.elevation = [](double x, double) { return 0.2 * std::abs(x - 5); };
  scene.water.depth = [](double x, double) { return x > 2 && x < 4 ? 0.3 : 0.0; };
  Flow flow(scene);
  const double mass = flow.method->totals().mass;
  double least = 0;
  flow.run(6, [&] {
    for (int i = 0; i < flow.size(); ++i) least = std::min(least, flow.real("depth")(i));
  });
  CHECK(least == 0);
  const Totals totals = flow.method->totals();
  CAPTURE(mass, totals.mass, totals.inflow, totals.outflow);
  CHECK(std::abs((totals.mass - totals.inflow + totals.outflow) / mass - 1) < 1e-12);
  // No faster than Ritter's front, 2 sqrt(g d), that has run down to the foot, 0.6 m lower.
  CHECK(flow.largest("u") < std::sqrt(4 * 9.81 * 0.3 + 2 * 9.81 * 0.6));
}

TEST_CASE("sisph: a dam break over dry land between walls keeps its water") {
  const double turned = GENERATE(0.0, 0.5);  // rad
  Scene scene = sisph_scene(2, {-1.1, -0.1}, {2.3, 2.3}, 0.05);
  const double c = std::cos(turned), s = std::sin(turned);
  Wall wall;
  for (const freshet::Point& p : std::vector<freshet::Point>{{0, 0}, {2, 0}, {2, 1}, {0, 1}, {0, 0}})
    wall.line.push_back({c * p[0] - s * p[1], s * p[0] + c * p[1]});
  scene.walls = {wall};
  scene.water.disorder = 0.2;
  scene.water.depth = [c, s](double x, double y) { return c * x + s * y < 0.6 ? 0.4 : 0.0; };
  Flow flow(scene);
  const double mass = flow.method->totals().mass;
  flow.run(2);
  const Totals totals = flow.method->totals();
  CHECK(totals.inflow == 0);
  CHECK(totals.outflow == 0);
  CHECK(std::abs(totals.mass / mass - 1) < 1e-12);
  CHECK(flow.largest("depth") < 0.45);
  CHECK(dry_particles(flow) == 0);  // it has come back from the far wall
}

TEST_CASE("sisph: a large step is stable") {
  for (const double courant : {5.0, 20.0, 50.0}) {
    Scene scene = hump(0.2);
    scene.sisph.courant = courant;
    Flow flow(scene);
    flow.many_steps(20);
    CAPTURE(courant);
    // No higher than at the start, and no faster than a wave of that height.
    CHECK(flow.largest("depth") < 1.1);
    CHECK(flow.largest_speed() < 0.1 * std::sqrt(9.81));
  }
}

TEST_CASE("sisph: a step launches its own passes and allocates nothing") {
  const bool dry = GENERATE(false, true);
  Flow flow(dry ? islands(0) : hump(0));
  for (int n = 0; n < 3; ++n) flow.step(0.01);
  const test::Recording recording;
  for (int n = 0; n < 3; ++n) flow.step(0.01);
  CHECK(recording.allocations == std::vector<std::string>{});
  const auto labels = recording.labels();
  for (const auto& label : labels) {
    CAPTURE(label);
    CHECK((label.substr(0, 7) == "sisph::" || label.substr(0, 4) == "cg::" ||
           label.substr(0, 8) == "linear::"));
  }
  CHECK(labels.count("sisph::advect") == (dry ? 1 : 0));
  CHECK(labels.count("sisph::trace") == (dry ? 0 : 1));
}

TEST_CASE("sisph: large steps have the particle mesh, and resuming goes on with it") {
  Scene scene = hump(0.2);
  scene.sisph.courant = 50;
  Flow flow(scene), resumed(scene);
  flow.many_steps(3);
  REQUIRE(flow.method->scalars().at("mesh")[0] == 1);
  for (const auto& f : std::as_const(*flow.method).fields().reals())
    Kokkos::deep_copy(resumed.real(f.name.c_str()), f.data);
  resumed.method->restore(flow.method->scalars());
  flow.step(0.5);
  resumed.step(0.5);
  CHECK(resumed.by_id("depth") == flow.by_id("depth"));
}

TEST_CASE("sisph: friction holds a dam break over dry land back and keeps its water") {
  const auto front = [](double n) {
    Scene scene = sisph_scene(1, {0, 0}, {6, 0}, 0.05);
    test::close_box(scene);
    scene.manning = Manning(n);
    scene.water.depth = [](double x, double) { return x < 2 ? 0.4 : 0.0; };
    Flow flow(scene);
    const double mass = flow.method->totals().mass;
    flow.run(0.6);
    CHECK(std::abs(flow.method->totals().mass / mass - 1) < 1e-12);
    double furthest = 0;
    for (int i = 0; i < flow.size(); ++i)
      if (flow.real("depth")(i) > 0.01) furthest = std::max(furthest, flow.real("x")(i));
    return furthest - 2;
  };
  const double smooth = front(0), rough = front(0.1);
  CAPTURE(smooth, rough);
  CHECK(rough > 0.2);
  CHECK(rough < 0.9 * smooth);
}

TEST_CASE("sisph: an open boundary inside the domain is refused") {
  Scene scene = hump(0);
  scene.boundaries = {test::open_end(scene, true, Transmissive{})};
  for (freshet::Point& p : scene.boundaries[0].line) p[0] += 0.3;
  CHECK_THROWS_WITH(Flow(scene), Catch::Contains("on the sides of the domain alone"));
}
