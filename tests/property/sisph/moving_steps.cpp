// SISPH with particles that move: how long steps may be, what happens where they do not hold, friction.
#include <catch2/catch.hpp>

#include "src/errors.hpp"
#include "tests/support/run/sisph_cases.hpp"
#include "tests/support/watch/recording.hpp"

using namespace freshet;
using test::Flow;
using test::moving_scene;

namespace {

// A hump in still water, open all around.
Scene hump(double amplitude) {
  Scene scene = moving_scene(2, {-1, -1}, {1, 1}, 0.05);
  scene.water.depth = [amplitude](double x, double y) {
    return 1 + amplitude * std::exp(-50 * (x * x + y * y));
  };
  return scene;
}

double highest(const Flow& flow) {
  double most = 0;
  for (int i = 0; i < flow.size(); ++i) most = std::max(most, std::abs(flow.real("depth")(i) - 1));
  return most;
}

}  // namespace

TEST_CASE("sisph moving: large steps are stable, on a lattice and in disorder", "[slow]") {
  constexpr double amplitude = 0.01;
  const double disorder = GENERATE(0.0, 0.2), theta = GENERATE(0.5, 0.55, 1.0),
               courant = GENERATE(5.0, 10.0, 20.0, 50.0);
  Scene scene = hump(amplitude);
  scene.water.disorder = disorder;
  scene.sisph.theta = theta;
  scene.time_step = courant * scene.water.spacing / std::sqrt(9.81);
  Flow flow(scene);
  double fastest = 0;
  for (int n = 0; n < 30; ++n) {
    flow.step(scene.time_step);
    fastest = std::max(fastest, flow.largest_speed());
    CAPTURE(disorder, theta, courant, n, highest(flow), fastest);
    REQUIRE(highest(flow) <= amplitude);  // spreading waves are lower than the hump
  }
  CHECK(fastest < amplitude * std::sqrt(9.81));  // of a wave as high as the hump
  CHECK(highest(flow) < 0.5 * amplitude);
}

TEST_CASE("sisph moving: velocities that do not part, pair or turn particles stay as they are") {
  // Any linear field is neither smoothed nor seen as a wave: the third differences of it are round-off.
  Scene scene = moving_scene(2, {-1, -1}, {1, 1}, 0.1);
  scene.gravity = 1e-12;
  scene.water.disorder = 0.2;
  scene.water.depth = [](double, double) { return 1.0; };
  scene.water.velocity = {[](double x, double y) { return 0.3 * x - 0.2 * y; },
                          [](double x, double y) { return 0.1 * x + 0.4 * y; }};
  Flow flow(scene);
  const std::vector<double> x = flow.by_id("x"), u = flow.by_id("u"), y = flow.by_id("y");
  flow.step(0.01);
  const std::vector<double> later = flow.by_id("u");
  for (std::size_t i = 0; i < x.size(); ++i)
    if (std::abs(x[i]) < 0.5 && std::abs(y[i]) < 0.5) REQUIRE(std::abs(later[i] - u[i]) < 1e-9);
}

TEST_CASE("sisph moving: a step that moves neighbours too far is taken in parts") {
  // The velocities at the start are zero: nothing but the step itself tells that it is too long.
  Scene scene = hump(0.5);
  scene.time_step = 0.3;
  Flow flow(scene);
  CHECK(flow.method->stable_dt() > 0.29);
  flow.step(0.3);
  REQUIRE(flow.method->notes().size() == 1);
  CHECK(flow.method->notes()[0].find("tried again") != std::string::npos);
  CHECK(flow.method->stable_dt() < 0.15);  // what did not hold is not tried again
  CHECK(highest(flow) < 0.5);
}

TEST_CASE("sisph moving: a surface that does not settle ends the run") {
  Scene scene = hump(0.1);
  scene.sisph.cg.most = 1;
  scene.sisph.courant = 1000;  // a 4096th of it still is a step that one iteration does not solve
  Flow flow(scene);
  const std::vector<double> x = flow.by_id("x"), depth = flow.by_id("depth");
  try {
    flow.step(flow.method->stable_dt());
    FAIL("nothing was thrown");
  } catch (const Diverged& why) {
    CHECK(why.exit() == Exit::diverged);
    for (const char* part : {"did not settle", "at t = 0 s", "right-hand side", "sisph.cg.max", "at-rest"})
      CHECK_THAT(why.what(), Catch::Contains(part));
  }
  CHECK(flow.by_id("x") == x);  // the state is the last that held
  CHECK(flow.by_id("depth") == depth);
}

TEST_CASE("sisph moving: friction slows water down as dv/dt = -g n^2 |v| v / H^(4/3)") {
  // 1/v grows linearly in time, and the implicit step has it exactly so: v' (1 + dt k |v|) = v.
  for (const int dimension : {1, 2}) {
    Scene scene = moving_scene(dimension, {-1, -1}, {1, 1}, 0.1);
    scene.water.depth = [](double, double) { return 0.5; };
    scene.water.velocity = {[](double, double) { return 1.2; },
                            [dimension](double, double) { return dimension == 2 ? -0.5 : 0.0; }};
    scene.manning = Manning(0.1);
    Flow flow(scene);
    const double speed = dimension == 2 ? 1.3 : 1.2, k = 9.81 * 0.01 / std::pow(0.5, 4.0 / 3);
    for (int n = 0; n < 20; ++n) flow.step(0.2);
    CHECK(flow.largest_speed() == Approx(speed / (1 + k * 4 * speed)).epsilon(1e-9));
    CHECK(flow.largest("depth") == Approx(0.5).epsilon(1e-9));
  }
}

TEST_CASE("sisph moving: rough ground by place holds those that are over it") {
  Scene scene = moving_scene(1, {-4, 0}, {4, 0}, 0.1);
  scene.water.depth = [](double, double) { return 1.0; };
  scene.water.velocity = {[](double, double) { return 0.1; }, [](double, double) { return 0.0; }};
  scene.manning = Manning();
  scene.manning->map = [](double x, double) { return x > 0 ? 0.1 : 0.0; };
  scene.manning->node = {0.05, 0};
  scene.manning->step = {0.1, 1};
  scene.sisph.cg.tolerance = 1e-10;
  Flow flow(scene);
  flow.step(0.005);  // before waves have come far: dv = -dt g n^2 v^2
  double fast = 0, slow = 1;
  for (int i = 0; i < flow.size(); ++i) {
    const double x = flow.real("x")(i);
    if (x < -2 && x > -3) fast = std::max(fast, std::abs(flow.real("u")(i) - 0.1));
    if (x > 2 && x < 3) slow = std::min(slow, flow.real("u")(i));
  }
  CHECK(fast < 1e-12);
  CHECK(slow == Approx(0.1 / (1 + 0.005 * 9.81 * 0.01 * 0.1)).epsilon(1e-12));
}

TEST_CASE("sisph moving: without friction none is launched or allocated") {
  test::Recording recording;
  Flow flow(hump(0.1));
  flow.many_steps(2);
  const auto labels = recording.labels();
  for (const char* foreign : {"sisph::drag", "sisph::ground"}) CHECK(labels.count(foreign) == 0);
  for (const std::string& label : recording.allocations) CHECK(label != "sisph.friction");
}
