// Between outputs a step reads no field on the host: what crosses are single numbers and short tables, and
// what the host waits for is counted.
#include <catch2/catch.hpp>

#include <atomic>

#include "tests/support/run/run_case.hpp"
#include "tests/support/watch/host_traffic.hpp"
#include "tests/support/watch/skips.hpp"

using namespace freshet;
using test::StepTraffic, test::Waits, test::sums;

namespace {

constexpr std::size_t most_bytes = 1024;
// The traffic of the steps from `first` to `last`, as the program takes them.
std::vector<StepTraffic> traffic_of(const Scene& scene, long first, long last) {
  const test::Scratch scratch;
  const auto method = make_method(scene);
  const auto particles = static_cast<std::size_t>(method->fields().size());
  REQUIRE(sizeof(double) * particles > most_bytes);  // else a field would pass for a table
  std::atomic<bool> stop{false};
  test::TrafficRecording recording;
  RunOptions options{scratch.path()};
  options.stop = &stop;
  long iterations = 0;
  options.each_step = [&](const Clock& clock) {
    recording.end_step();
    const StepReport report = method->report();
    recording.steps.back().iterations = report.iterations - iterations + report.pressure_iterations;
    iterations = report.iterations;
    stop = clock.step >= last;
  };
  Driver driver(scene, *method, options);
  driver.begin();
  driver.run();
  return {recording.steps.begin() + first - 1, recording.steps.end()};
}

std::vector<StepTraffic> traffic_of(const Scene& scene) { return traffic_of(scene, 6, 12); }

void check_copies(const std::vector<StepTraffic>& steps) {
  for (const StepTraffic& step : steps)
    for (const auto& [label, bytes] : step.copies) {
      CAPTURE(label);
      CHECK(bytes <= most_bytes);
    }
}

// Each step copies little and waits for exactly this.
void check_steps(const Scene& scene, const Waits& expected) {
  const auto steps = traffic_of(scene);
  check_copies(steps);
  for (const StepTraffic& step : steps) CHECK(step.waits == expected);
}

// The same of an implicit method, but that its sums are so many in each iteration of its solvers and so many
// beside; at_most: fewer where an iteration ends at its half.
void check_implicit_steps(const Scene& scene, const Waits& expected, int in_each, int beside,
                          bool at_most = false) {
  auto steps = traffic_of(scene);
  check_copies(steps);
  for (StepTraffic& step : steps) {
    REQUIRE(step.iterations > 0);
    const long most = in_each * step.iterations + beside;
    CHECK(step.waits[sums] <= most);
    if (!at_most) CHECK(step.waits[sums] == most);
    step.waits.erase(sums);
    CHECK(step.waits == expected);
  }
}

Waits with(Waits waits, const Waits& more) {
  for (const auto& [what, times] : more) waits[what] += times;
  return waits;
}

// A bare scene: extents and counts of the sort and the lists, the largest h, the density's report, the time
// step, the monitor.
const Waits bare{{"cellgrid::extent", 1},    {"copy cellgrid.block", 1},
                 {"copy cellgrid.start", 1}, {"copy cellgrid.row_start", 1},
                 {"cellgrid::largest_h", 1}, {"cellgrid::list", 1},
                 {"swe::density", 1},        {"swe::accelerate", 1},
                 {"run::monitor", 1}};

// Sloping ground with friction between walls; everything is looked at that the program can look at.
Scene observed_shore() {
  Scene scene = test::drop();
  scene.bed.elevation = [](double x, double) { return 0.1 * x; };
  scene.manning = 0.02;
  test::close_box(scene);
  Gauge gauge;
  gauge.name = "g", gauge.at = {0.1, 0};
  scene.gauges = {gauge};
  scene.run_ups = {{"r", {0.3, 0}, 0.1, 0.002, {}}};
  scene.rasters = Rasters{};
  scene.rasters->spacing = 0.1;
  scene.rasters->maxima = true;
  scene.rasters->what = {Rasters::Quantity::depth};
  scene.compare.steady = true;
  return scene;
}

// Discharge in on the left, level on the right: a line longer than its rows' states are allowed to be.
Scene open_channel(double length, double width) {
  Scene scene = test::bare_scene(2, {0, 0}, {length, width}, 0.05);
  scene.water.depth = [](double, double) { return 0.3; };
  test::open_both(scene, ImposedDischarge{}, ImposedLevel{});
  test::impose(scene.boundaries[0], "discharge", {{0, 1e3}, {0.025 * width, 0.03 * width}});
  test::impose(scene.boundaries[1], "level", {{0, 1e3}, {0.3, 0.31}});
  return scene;
}

}  // namespace

TEST_CASE("host traffic: a bare step waits for nine numbers") { check_steps(test::drop(), bare); }

TEST_CASE("host traffic: every hundredth step looks at every field where the fields are") {
  Scene scene = test::drop();
  scene.water.depth = [](double, double) { return 0.5; };  // still: no list is made again
  test::close_box(scene);
  const auto steps = traffic_of(scene, 99, 101);
  check_copies(steps);
  const Waits usual = with(bare, {{"walls::list", 1}});
  CHECK(steps[0].waits == usual);
  CHECK(steps[1].waits ==
        with(usual, {{"run::monitor", 1}, {"run::monitor_all", 1}, {sums, 2}}));  // mass, energy
  CHECK(steps[2].waits == usual);
}

TEST_CASE(
    "host traffic: ground and run-ups cost no wait, walls, maxima, the largest speed and gauges that are due "
    "one") {
  Scene scene = observed_shore();
  const Waits expected = with(bare, {{"walls::list", 1}, {"raster::maxima", 1}, {"run::largest_speed", 1}});
  check_steps(scene, expected);
  scene.output.gauges_every = 1e-4, scene.end_time = 1;  // due in each step, which ends where the next begins
  check_steps(scene, with(expected, {{"copy sampling.found", 1}}));
}

TEST_CASE("host traffic: a piece of open boundary costs what it adds and what crossed it") {
  check_steps(open_channel(1.2, 1.2), with(bare, {{"walls::list", 1}, {"copy open.room", 2}, {sums, 2}}));
}

TEST_CASE("host traffic: splitting costs the number of parents, merging that of pairs") {
  Scene scene = test::drop();
  scene.split = Split{};
  scene.split->alpha = 0.92, scene.split->eps = 0.36;
  scene.split->area.elsewhere = 1e3;
  check_steps(scene, with(bare, {{"split::choose", 1}}));
  scene.merge = Merge{};
  scene.merge->area.elsewhere = 1e-3;
  check_steps(scene, with(bare, {{"split::choose", 1}, {"merge::join", 1}}));
  scene.split->area.elsewhere = 1.2;  // now some split; storage that grows is copied on the device
  check_copies(traffic_of(scene));
}

TEST_CASE("host traffic: semi-implicit, at rest") {
  const Waits rest{{"run::monitor", 1},
                   {"sisph::deepest", 1},
                   {"sisph::fastest", 1},
                   {"sisph::dry", 1},
                   {"sisph::list_active", 1}};
  check_implicit_steps(test::read_case("sisph_lake"), with(rest, {{"sisph::depths", 2}}), 2, 9);
  const Scene channel = test::read_case("sisph_channel", {"water.spacing=0.5"});
  check_implicit_steps(channel, with(rest, {{"box_multigrid::scale", 2}}), 3, 7);
  Scene open = open_channel(1, 4);
  open.method = "sisph";
  open.sph.eta = open.sisph.smoothing;
  check_implicit_steps(open, rest, 2, 7);
}

TEST_CASE("host traffic: semi-implicit, moving with the water") {
  const Waits step{{"run::monitor", 1},
                   {"sisph::deepest", 1},
                   {"sisph::fastest", 1},
                   {"sisph::jump", 2},
                   {"sisph::shallowest", 2},
                   {"cellgrid::extent", 1},
                   {"cellgrid::largest_h", 1},
                   {"copy cellgrid.block", 1},
                   {"copy cellgrid.start", 1},
                   {"copy cellgrid.row_start", 1},
                   {"copy cellgrid.pair_start", 1}};
  check_implicit_steps(test::read_case("sisph_hump", {"sisph.formulation=moving"}), step, 2, 4);
}

TEST_CASE("host traffic: incompressible, pressure gauges not due and due") {
  const Waits step{{"run::monitor", 1},
                   {"cellgrid::extent", 1},
                   {"copy cellgrid.block", 1},
                   {"copy cellgrid.start", 1},
                   {"copy cellgrid.row_start", 1},
                   {"fpm::hold", 1},
                   {"fpm::voronoi", 1},
                   {"fpm::decide", 1},
                   {"fpm::new_places", 1},
                   {"fpm::list", 1},
                   {"fpm::stencils", 1},
                   {"fpm::unknowns", 1},
                   {"fpm::limit_spray", 1},
                   {"fpm::fastest", 1},
                   {"box_multigrid::scale", 1}};
  const auto scene = [](const char* gauges) {
    return test::read_case("fpm_lobovsky", {"water.spacing=0.03", gauges});
  };
  check_implicit_steps(scene("output.gauges_every=0.9"), step, 5, 4, true);
  check_copies(traffic_of(scene("output.gauges_every=1e-4")));
}
