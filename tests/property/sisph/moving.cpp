// SISPH with particles that move: still water, mass to the bit, the same in every uniform motion, what a step
// launches.
#include <catch2/catch.hpp>

#include "tests/support/run/sisph_cases.hpp"
#include "tests/support/watch/recording.hpp"

using namespace freshet;
using test::Flow;
using test::moving_scene;

namespace {

// A hump in the middle of water that all moves with (u, v), away from the sides.
Scene hump(double u = 0, double v = 0) {
  Scene scene = moving_scene(2, {-1, -1}, {1, 1}, 0.05);
  scene.water.depth = [](double x, double y) { return 1 + 0.1 * std::exp(-50 * (x * x + y * y)); };
  scene.water.velocity = {[u](double, double) { return u; }, [v](double, double) { return v; }};
  scene.water.disorder = 0.2;
  return scene;
}

Scene walled_pool() {
  Scene scene = moving_scene(2, {0, 0}, {1, 1}, 0.05);
  test::close_box(scene);
  scene.water.disorder = 0.2;
  scene.water.depth = [](double x, double y) { return 1 + 0.1 * std::cos(pi * x) * std::cos(pi * y); };
  return scene;
}

}  // namespace

TEST_CASE("sisph moving: still water over a rough bed stays still") {
  Scene scene = moving_scene(2, {0, 0}, {1.2, 1.2}, 0.04);
  test::close_box(scene);
  scene.bed.elevation = [](double x, double y) {
    return -0.9 + 0.3 * std::sin(11 * x) * std::cos(9 * y) + 0.2 * std::sin(29 * x + 17 * y);
  };
  scene.water.surface = [](double, double) { return 0.0; };
  scene.water.disorder = 0.2;
  Flow flow(scene);
  const std::vector<double> x = flow.by_id("x");
  for (int n = 0; n < 200; ++n) flow.step(0.02);
  CHECK(flow.largest_speed() <
        1e-12);  // the gradient of a level surface is round-off over dx; it does not grow
  CHECK(test::largest_difference(flow.by_id("x"), x) < 1e-12);
}

TEST_CASE("sisph moving: masses do not change by a bit, and all the water stays between walls") {
  Flow flow(walled_pool());
  const std::vector<double> mass = flow.by_id("mass");
  const double total = flow.method->totals().mass;
  flow.many_steps(100);
  CHECK(flow.largest_speed() > 0.05);
  CHECK(flow.by_id("mass") == mass);
  CHECK(std::abs(flow.method->totals().mass / total - 1) < 1e-14);  // the order of the sum changes
  const auto x = flow.real("x"), y = flow.real("y");
  for (int i = 0; i < flow.size(); ++i) REQUIRE((x(i) > 0 && x(i) < 1 && y(i) > 0 && y(i) < 1));
}

TEST_CASE("sisph moving: in water that all moves the same happens, further on") {
  const sisph::ParticlePath path = GENERATE(from_range(sisph::particle_paths()));
  constexpr double u = 2, v = -1, dt = 0.01;
  constexpr int steps = 12;
  Scene still_scene = hump(), carried_scene = hump(u, v);
  still_scene.sisph.path = carried_scene.sisph.path = path;
  still_scene.sisph.cg.tolerance = carried_scene.sisph.cg.tolerance = 1e-12;
  Flow still(still_scene), carried(carried_scene);
  for (int n = 0; n < steps; ++n) still.step(dt), carried.step(dt);
  CHECK(still.largest_speed() > 0.05);
  // Round-off: of places 1e-16, over dx 0.05, in a dozen steps.
  CHECK(test::largest_difference(still.by_id("depth"), carried.by_id("depth")) < 1e-12);
  std::vector<double> x = carried.by_id("x"), y = carried.by_id("y");
  for (double& a : x) a -= u * steps * dt;
  for (double& a : y) a -= v * steps * dt;
  CHECK(test::largest_difference(still.by_id("x"), x) < 1e-12);
  CHECK(test::largest_difference(still.by_id("y"), y) < 1e-12);
}

TEST_CASE("sisph moving: a step launches its own passes and allocates nothing") {
  Flow flow(hump(1, 0.5));
  flow.many_steps(3);
  const test::Recording recording;
  flow.many_steps(3);
  CHECK(recording.allocations == std::vector<std::string>{});
  const auto labels = recording.labels();
  for (const auto& label : labels) {
    CAPTURE(label);
    CHECK((label.substr(0, 7) == "sisph::" || label.substr(0, 4) == "cg::" ||
           label.substr(0, 8) == "linear::" || label.substr(0, 10) == "cellgrid::"));
  }
  CHECK(labels.count("sisph::place_midway") == 1);
  for (const char* foreign :
       {"sisph::coefficients", "sisph::advect", "sisph::trace", "sisph::rise_of_bed", "sisph::reflect"})
    CHECK(labels.count(foreign) == 0);
}

TEST_CASE("sisph moving: between walls a step allocates nothing either") {
  Flow flow(walled_pool());
  flow.many_steps(5);  // the room for pairs and images is found
  const test::Recording recording;
  flow.many_steps(20);
  CHECK(recording.allocations == std::vector<std::string>{});
  CHECK(recording.labels().count("sisph::reflect") == 1);
}

TEST_CASE("sisph moving: particles at rest launch nothing of it") {
  Scene scene = hump();
  scene.sisph.moving = false;
  Flow flow(scene);
  const test::Recording recording;
  flow.many_steps(2);
  const auto labels = recording.labels();
  for (const char* foreign : {"sisph::place_midway", "sisph::increment", "sisph::jump", "cellgrid::place"})
    CHECK(labels.count(foreign) == 0);
  CHECK_FALSE(flow.method->fields().has("u_before"));
}

TEST_CASE("sisph moving: what needs the step to be short keeps it short") {
  Scene scene = hump();
  scene.water.velocity = {[](double x, double) { return x > 0 ? 0.5 : -0.5; },
                          [](double, double) { return 0.0; }};
  scene.water.disorder = 0;
  scene.sisph.courant = 100;
  Flow flow(scene);
  CHECK(flow.method->stable_dt() == Approx(scene.sisph.jump * 0.05 / 1.0));  // neighbours part with 1 m/s
}

TEST_CASE("sisph moving: large steps have the particle mesh, and resuming goes on with it") {
  Scene scene = hump();
  scene.sisph.courant = 50;
  scene.water.depth = [](double x, double y) {
    return 1 + 0.01 * std::exp(-50 * (x * x + y * y));
  };  // so low that nothing else bounds the step
  Flow flow(scene), resumed(scene);
  flow.many_steps(3);
  REQUIRE(flow.method->scalars().at("moving")[2] == 1);
  for (const auto& f : std::as_const(*flow.method).fields().reals())
    Kokkos::deep_copy(resumed.real(f.name.c_str()), f.data);
  for (const auto& f : std::as_const(*flow.method).fields().integers())
    Kokkos::deep_copy(std::as_const(*resumed.method).fields().integer(f.name), f.data);
  resumed.method->restore(flow.method->scalars());
  flow.many_steps(1);
  resumed.many_steps(1);
  CHECK(resumed.by_id("depth") == flow.by_id("depth"));
}

TEST_CASE("sisph moving: dry land is refused") {
  Scene scene = moving_scene(1, {0, 0}, {1, 0}, 0.1);
  scene.water.depth = [](double x, double) { return x - 0.5; };
  CHECK_THROWS_WITH(make_method(scene),
                    Catch::Contains("needs water everywhere") && Catch::Contains("at-rest"));
}
