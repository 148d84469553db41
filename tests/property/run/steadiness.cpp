// What is said of a steady flow: the largest speed over time and the rate at which depths change.
#include <catch2/catch.hpp>

#include "src/run/observers.hpp"
#include "src/run/watch/steadiness.hpp"
#include "tests/support/run/scenes.hpp"

using namespace freshet;

namespace {

// A basin 20 m long with a slanting surface: it sloshes.
Scene slosh() {
  Scene scene = test::bare_scene(1, {0, 0}, {20, 0}, 0.2);
  scene.water.depth = [](double x, double) { return 1 + 0.01 * (x - 10); };
  scene.compare.steady = true;
  test::close_box(scene);
  return scene;
}

}  // namespace

TEST_CASE("the rate of change is that of the particles' own depths") {
  test::Flow flow(slosh());
  flow.many_steps(40);
  SteadinessWatch watch(slosh());
  watch.begin(*flow.method);
  const double dt = 1e-4;  // s: the rates themselves change within 5 s
  flow.step(dt);
  const auto before = flow.by_id("depth");
  flow.step(dt);
  const auto after = flow.by_id("depth");
  double sum = 0;
  for (std::size_t k = 0; k < before.size(); ++k) sum += std::pow(1 - before[k] / after[k], 2);
  const Steadiness steady = watch.result(*flow.method, {0, 0, dt});
  // Newton's tolerance of 1e-5 on depths that change by 1e-6 in the step would hide the difference were it
  // not for the extrapolation, which starts each solution within a hundredth of that.
  CHECK(steady.thesis_ls == Approx(std::sqrt(sum)).epsilon(0.02));
  CHECK(steady.rate == Approx(std::sqrt(sum / 100) / dt).epsilon(0.02));  // 100 particles
}

TEST_CASE("the largest speed is that over all steps, relative to the first depth, and survives a restart") {
  const Scene scene = slosh();
  test::Flow flow(scene);
  SteadinessWatch watch(scene);
  watch.begin(*flow.method);
  double fastest = 0;
  flow.run(6, [&] {  // nearly half a period: the fastest moment, after a quarter, is over
    watch.after_step(*flow.method, {});
    fastest = std::max(fastest, flow.largest_speed());
  });
  REQUIRE(fastest > 1.2 * flow.largest_speed());
  Values values;
  watch.save(values);
  SteadinessWatch restored(scene);
  restored.restore(values, {});
  const Steadiness steady = restored.result(*flow.method, {0, 0, 1});
  CHECK(steady.end_speed_rel * fastest ==
        Approx(steady.max_speed_rel * flow.largest_speed()));  // the same celerity
  const double deepest = 1.1;  // m, at the wall less half a spacing; the lattice sum at eta = 1 is exact to
                               // the slope's curvature
  CHECK(steady.max_speed_rel == Approx(fastest / std::sqrt(9.81 * deepest)).epsilon(5e-3));
}

TEST_CASE("nothing is recorded unless the scene wants it") {
  Scene scene = slosh();
  CHECK(find<SteadinessWatch>(make_observers(scene, "")));
  scene.compare.steady = false;
  CHECK_FALSE(find<SteadinessWatch>(make_observers(scene, "")));
}
