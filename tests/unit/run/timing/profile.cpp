// Launch times and the profile of a run, with a method whose launches are known.
#include <catch2/catch.hpp>

#include <chrono>
#include <thread>

#include "src/run/timing/launch_times.hpp"
#include "src/run/timing/profile.hpp"
#include "tests/support/run/fake_method.hpp"
#include "tests/support/run/scenes.hpp"
#include "tests/support/watch/scratch.hpp"

using namespace freshet;

namespace {

void wait(double milliseconds) {
  std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(milliseconds));
}

void launch(const char* label, double milliseconds) {
  Kokkos::parallel_for(
      label, Range(0, 1), KOKKOS_LAMBDA(int) { wait(milliseconds); });
}

const PassProfile& pass(const RunProfile& profile, const std::string& label) {
  for (const PassProfile& p : profile.passes)
    if (p.label == label) return p;
  FAIL("no launch " << label);
  return profile.passes.front();
}

// A box of still water on a slope, with walls and friction.
Scene box() {
  Scene scene = test::bare_scene(2, {0, 0}, {1, 1}, 0.05);
  scene.water.depth = [](double x, double) { return 0.5 - 0.1 * x; };
  scene.bed.elevation = [](double x, double) { return 0.1 * x; };
  scene.manning = 0.01;
  test::close_box(scene);
  return scene;
}

}  // namespace

TEST_CASE("launches and regions are timed by label") {
  LaunchTimes times;
  launch("before", 1);
  times.clear();
  {
    const TimedRegion outer("outer");
    launch("a", 3);
    wait(2);
    const TimedRegion inner("inner");
    launch("a", 3);
    launch("b", 1);
  }
  launch("b", 1);
  const auto& launches = times.launches();
  REQUIRE(launches.size() == 2);
  CHECK(launches.at("a").calls == 2);
  CHECK(launches.at("b").calls == 2);
  CHECK(times.regions().at("outer").calls == 1);
  // Sleeps last at least as long as they say.
  CHECK(launches.at("a").seconds >= 6e-3);
  CHECK(launches.at("b").seconds >= 2e-3);
  CHECK(times.in("inner") >= 4e-3);
  CHECK(times.in("outer") >= times.in("inner") + 5e-3);
  CHECK(times.launched_in("outer") <= times.in("outer") - 2e-3);
  CHECK(times.launched_in("outer") + 1e-3 <= times.launched());
  CHECK(times.in("nowhere") == 0);
}

TEST_CASE("launches are timed by one at a time, and no longer than it lives") {
  {
    const LaunchTimes times;
    CHECK_THROWS_AS(LaunchTimes(), std::logic_error);
  }
  launch("unheard", 0);
  const LaunchTimes times;
  CHECK(times.launches().empty());
}

TEST_CASE("work: bytes and operations of a pass add up") {
  const Cost cost{10, 5, 3};
  const Work o_n = work_of(cost, 100), walk = work_of(cost, 100, 2000, 4000, 8);
  CHECK(o_n.flops == 500);
  CHECK(o_n.bytes == 2400);
  CHECK(o_n.pairs == 0);
  CHECK(walk.flops == 500 + 40000);
  CHECK(walk.bytes == 2400 + 4 * 500);
}

TEST_CASE("pairs within the support are counted, not what is listed beyond") {
  const test::Flow flow([] {
    Scene scene = test::bare_scene(2, {0, 0}, {1, 1}, 0.1);
    scene.water.depth = [](double, double) { return 0.5; };
    return scene;
  }());
  const auto work = flow.method->work();
  const Field<double> x = flow.real("x"), y = flow.real("y"), h = flow.real("h");
  double pairs = 0;
  for (int i = 0; i < flow.size(); ++i)
    for (int j = 0; j < flow.size(); ++j) {
      const double reach = 2 * std::max(h(i), h(j));
      pairs += std::pow(x(i) - x(j), 2) + std::pow(y(i) - y(j), 2) < reach * reach;
    }
  CHECK(work.at("swe::force").pairs == pairs);
  CHECK(work.at("swe::force").listed >= pairs);
  CHECK(work.at("swe::force").particles == 100);
}

TEST_CASE("a profile counts every launch of the steps asked for, and no other") {
  const test::Scratch scratch;
  Scene scene = box();
  scene.end_time = 100;
  const auto method = make_method(scene);
  const RunProfile p = profile_run(scene, *method, scratch.path(), 7);
  CHECK(p.first_step == 20);
  CHECK(p.steps == 7);
  CHECK(p.particle_steps == 7 * 400);
  for (const char* label : {"swe::density", "swe::force", "swe::accelerate", "cellgrid::list"}) {
    CAPTURE(label);
    CHECK(pass(p, label).calls == 7);
    CHECK(pass(p, label).work.particles == 7 * 400);
    CHECK(pass(p, label).work.flops > 0);
    CHECK(pass(p, label).work.bytes > 0);
  }
  CHECK(p.newton_mean >= 1);
  CHECK(p.newton_max >= p.newton_mean);
  CHECK(p.simulated > 0);
  // Parts of a whole, in the order of their nesting.
  CHECK(p.launched <= p.wall);
  CHECK(p.launched_in_step <= p.step);
  CHECK(p.sort <= p.step);
  CHECK(p.step + p.observe + p.check + p.output <= p.wall);
  CHECK(p.per_output > 0);
  double sum = 0;
  for (const PassProfile& one : p.passes) sum += one.seconds;
  CHECK(sum == Approx(p.launched));
  CHECK(pass(p, "walls::list").calls == 7);
}

TEST_CASE("a profile of a scene that ends early counts the steps that there were") {
  const test::Scratch scratch;
  const Scene scene = test::fake_scene();
  test::FakeMethod method(scene);
  const RunProfile p = profile_run(scene, method, scratch.path(), 100000);
  CHECK(p.steps > 0);
  CHECK(p.steps < 100000);
  CHECK(p.first_step + p.steps == method.scalars().at("steps").at(0));
}

TEST_CASE("a profile as a table and as JSON") {
  RunProfile p;
  p.scene = "pond", p.method = "sph-swe", p.backend = "Serial", p.registers = "AVX2", p.threads = 1;
  p.first_step = 20, p.steps = 10, p.particle_steps = 1e4, p.wall = 2e-3, p.simulated = 0.1,
  p.newton_mean = 1.25, p.newton_max = 3;
  p.step = 1.5e-3, p.launched_in_step = 1.4e-3, p.launched = 1.4e-3, p.output_every = 0.5,
  p.per_output = 1e-3;
  p.peaks = {1e11, 1e10};
  p.passes = {{"swe::force", 10, 1e-3, {1e4, 2e5, 4e5, 4e7, 1e6}}, {"nobody's", 2, 1e-4, {}}};
  const std::string lines = table(p), text = json(p);
  using Catch::Contains;
  CHECK_THAT(lines, Contains("pond, sph-swe: steps 21 to 30, 1000 particles, 1 thread (Serial, AVX2)"));
  CHECK_THAT(text, Contains("\"registers\": \"AVX2\""));
  CHECK(lines.find("built for") == std::string::npos);  // nothing better to be had
  p.better = "this machine has AVX-512: a build uses it";
  CHECK_THAT(table(p), Contains("built for AVX2, while this machine has AVX-512: a build uses it\n"));
  // 1e-3 s of 2e-3 s; 1e4 particles, 2e5 pairs and 4e7 operations in 1e-3 s; 40 of 100 GFLOP/s is nearer to
  // its roof than 1 of 10 GB/s
  CHECK_THAT(lines, Contains("swe::force                      10    0.001  50.0     100.0   100.00      10   "
                             "  200       40      1     40"));
  CHECK_THAT(lines, Contains("nobody's                         2    0.000   5.0      50.0    10.00       -   "
                             "    -        -      -      -"));
  CHECK_THAT(lines, Contains("5.000 million particle-steps/s"));
  // 0.02 s of work for a simulated second: 0.01 s from output to output, which takes 0.001 s
  CHECK(p.output_share() == Approx(1.0 / 11));
  CHECK_THAT(text, Contains("\"of_roof\": 0.4"));
  CHECK_THAT(text, Contains("\"seconds_per_simulated_second\": 0.02"));
}

TEST_CASE("a profile tells what the solver of its method went through") {
  using Catch::Contains;
  RunProfile p;
  p.steps = 10, p.newton_max = 2;  // of sisph: the most solves in a pass
  p.surface_passes = 20, p.solves = 25, p.iterations = 150;
  CHECK_THAT(table(p), Contains("surface: 2.00 passes, 2.50 linear solves and 15.0 iterations a step\n"));
  CHECK_THAT(table(p), !Contains("density:"));
  CHECK_THAT(json(p), Contains("\"iterations\": 150") && !Contains("newton_max"));
  p.newton_max = 0, p.surface_passes = p.solves = 0;
  CHECK_THAT(table(p), Contains("pressure: 15.0 iterations a step\n"));
  p.newton_mean = 1.25, p.newton_max = 3, p.iterations = 0;
  CHECK_THAT(table(p),
             Contains("density: 1.25 evaluations per cluster, at most 3; lists made again 0 times\n"));
  CHECK_THAT(json(p), Contains("\"newton_max\": 3") && !Contains("\"solver\""));
}

TEST_CASE("peaks are those of a processor") {
  const Peaks peaks = measure_peaks();
  CHECK(peaks.flops > 1e8);
  CHECK(peaks.flops < 1e15);
  CHECK(peaks.bytes > 1e8);
  CHECK(peaks.bytes < 1e15);
  CHECK(roof_fraction(0.5 * peaks.flops, 0.1 * peaks.bytes, peaks) == Approx(0.5));
}
