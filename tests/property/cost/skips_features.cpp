// Each feature adds its own launches and fields, and no more; what a dimension, a fixed h or a stabilisation
// does not need is not done; recorders of the run loop launch only where the scene names them.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "kernels/smoothing/smoothing.hpp"
#include "src/run/driver.hpp"
#include "tests/support/watch/scratch.hpp"
#include "tests/support/watch/skips.hpp"

using namespace freshet;
using test::bare_step, test::drop, test::extra_labels, test::field_names, test::launches, test::minus,
    test::Names;
using test::Flow;
using test::Recording;

namespace {

const Names velocity_gradient{"strain_xx", "strain_xy", "strain_yy"};

// One launch more of a label, behind the first of another.
std::vector<std::string> with(std::vector<std::string> labels, const std::string& after,
                              const std::string& label) {
  labels.insert(std::find(labels.begin(), labels.end(), after) + 1, label);
  return labels;
}

// What a run of 20 steps launches and allocates, first and last output included.
struct Loop {
  Names labels, allocations;
};

Loop loop_of(Scene scene) {
  const test::Scratch scratch;
  Flow flow(scene);
  flow.many_steps(3);
  scene.end_time = 20 * flow.method->stable_dt();
  Driver driver(scene, *flow.method, {scratch.path()});
  driver.begin();
  const Recording recording;
  driver.run();
  Loop loop{{}, {recording.allocations.begin(), recording.allocations.end()}};
  for (const auto& label : recording.labels())
    if (label.rfind("Kokkos::View::initialization", 0) != 0)
      loop.labels.insert(label);  // part of an allocation
  return loop;
}

}  // namespace

TEST_CASE("skips: in 1-D the same passes run without y") {
  const Scene scene = drop(1);
  Flow flow(scene);
  CHECK(launches(scene) == bare_step(test::sorted_fields(flow.method->fields())));
  for (const auto& name : {"y", "v", "v_pred", "ay", "ty", "strain_xy", "strain_yy"})
    CHECK_FALSE(flow.method->fields().has(name));
}

TEST_CASE("skips: pairs in single precision add their two copies") {
  Scene scene = drop();
  scene.sph.mixed = true;
  CHECK(extra_labels(scene) == Names{"swe::copy_motion", "swe::copy_state"});
  CHECK(field_names(scene) == field_names(drop()));
  Flow flow(scene);
  flow.many_steps(3);
  const Recording recording;
  flow.many_steps(3);
  CHECK(recording.allocations.empty());
}

TEST_CASE("skips: a fixed h takes one density evaluation, a variable one more") {
  Scene scene = drop();
  const auto evaluations = [](const Scene& of) {
    Flow flow(of);
    flow.many_steps(10);
    return flow.method->report();
  };
  CHECK(evaluations(scene).newton_mean > 1.05);  // a drop just let go: the prediction is not yet good enough
  scene.sph.h_floor = scene.sph.h_cap = 1;
  CHECK(evaluations(scene).newton_mean == 1);
  CHECK(evaluations(scene).newton_max == 1);
  CHECK(evaluations(scene).rebuilds == 0);
  CHECK(extra_labels(scene) == Names{});
}

TEST_CASE("skips: with a fixed h the density is the plain sum over all particles") {
  Scene scene = drop();
  scene.sph.h_floor = scene.sph.h_cap = 1;
  Flow flow(scene);
  flow.many_steps(20);
  const auto x = flow.real("x"), y = flow.real("y"), m = flow.real("mass"), depth = flow.real("depth"),
             h = flow.real("h");
  double worst = 0;
  for (int i = 0; i < flow.size(); i += 13) {
    double sum = 0;
    for (int j = 0; j < flow.size(); ++j) {
      const double q = std::hypot(x(i) - x(j), y(i) - y(j)) / 0.06;  // h = 1.2 dx
      sum += m(j) * CubicSpline<2>::at(q).w / (0.06 * 0.06);
    }
    worst = std::max(worst, std::abs(sum - depth(i)) / sum);
    CHECK(h(i) == Approx(0.06).epsilon(1e-14));
  }
  CHECK(worst < 1e-11);  // rsqrt is good to 1e-12
}

TEST_CASE("skips: gradients belong to the stabilisations that reconstruct") {
  const Names bare = field_names(drop());
  for (const swe::AnyStabilisation& kind : std::initializer_list<swe::AnyStabilisation>{
           swe::NoStabilisation{}, swe::ArtificialViscosity{}, swe::LaxFriedrichs{}, swe::TwoShock{}}) {
    Scene scene = drop();
    scene.sph.stabilisation = kind;
    CHECK(minus(bare, field_names(scene)) == velocity_gradient);
    CHECK(extra_labels(scene) == Names{});
  }
  Scene scene = drop();
  scene.sph.stabilisation = swe::TwoShockMuscl{};
  CHECK(minus(field_names(scene), bare) == Names{"depth_slope_x", "depth_slope_y"});
  CHECK(extra_labels(scene) == Names{"swe::depth_gradient"});
}

TEST_CASE("skips: other kernels and the lattice correction add nothing") {
  const Names bare = field_names(drop());
  Scene scene = drop();
  scene.sph.lattice_correction = true;
  for (const KernelChoice& kernel : alternatives<KernelChoice>()) {
    scene.sph.kernel = kernel;
    CHECK(field_names(scene) == bare);
    CHECK(extra_labels(scene) == Names{});
  }
}

TEST_CASE("skips: every kind of wall adds the list of its points and the reflection") {
  Scene scene = drop();
  test::close_box(scene);
  const auto walled =
      with(with(bare_step(13), "swe::kick_and_drift", "walls::reflect"), "cellgrid::list", "walls::list");
  const auto kind = GENERATE(WallKind::automatic, WallKind::none, WallKind::vbp, WallKind::mvbp,
                             WallKind::image_rows, WallKind::images);
  scene.sph.walls = kind;
  const std::string name = kind.name;
  const bool mirrors = name == "automatic" || name == "mirror";  // which ask how far neighbours' images reach
  CHECK(launches(scene) == (mirrors ? with(walled, "cellgrid::list", "walls::felt_h") : walled));
  CHECK(field_names(scene) == field_names(drop()));
}

TEST_CASE("skips: the well-balanced bed adds its calibration and, over a bed, two passes") {
  Scene scene = drop();
  const Names bare = field_names(scene);
  scene.sph.well_balanced = true;
  CHECK(minus(field_names(scene), bare) == Names{"calibration"});
  CHECK(extra_labels(scene) == Names{});
  scene.bed.elevation = [](double x, double) { return 0.01 * x; };
  CHECK(minus(field_names(scene), bare) == Names{"bed", "calibration"});
  CHECK(extra_labels(scene) == Names{"swe::balanced_bed", "swe::bed_level"});
}

TEST_CASE("skips: every kind of open boundary adds the field of kinds and launches of its own") {
  Scene scene = test::bare_scene(2, {0, 0}, {1.2, 0.4}, 0.05);
  scene.water.depth = [](double, double) { return 0.3; };
  const Names bare = field_names(scene);
  const OpenLaw law = GENERATE(from_range(alternatives<OpenLaw>()));
  test::open_left(scene, law, {{0}, {0.3}});
  for (const char* what : {"velocity", "discharge"})
    test::impose_if_known(scene.boundaries[0], what, {{0}, {0.01}});
  scene.walls.clear();
  CHECK(minus(field_names(scene), bare) == Names{"kind"});
  for (const auto& label : extra_labels(scene)) {
    CAPTURE(label);
    CHECK(label.substr(0, 6) == "open::");
  }
}

TEST_CASE("skips: dry land around changes neither launches nor results") {
  Scene small = drop(), large = drop();
  large.domain = {2, {-40, -40}, {40, 40}};
  // To round-off: at the default tolerance a rounding may decide whether a cluster evaluates its density once
  // more.
  small.sph.newton_tolerance = large.sph.newton_tolerance = 1e-22;
  Flow a(small), b(large);
  a.many_steps(40), b.many_steps(40);
  CHECK(launches(large) == launches(small));
  CHECK(a.t == Approx(b.t).epsilon(1e-12));
  // Cells count from the domain's corner: 40 m away a position is rounded by 7e-15 m, and 40 steps may
  // amplify that.
  for (const char* name : {"x", "y", "u", "v", "depth", "h"}) {
    CAPTURE(name);
    CHECK(test::largest_difference(a.by_id(name), b.by_id(name)) < 1e-11);
  }
}

TEST_CASE(
    "skips: the run loop looks at every particle once, recorders that the scene names add their own launch") {
  const auto observers = [](const Scene& of) { return make_observers(of, "").size(); };
  CHECK(observers(drop()) == 4);  // the monitor, those of stability and energy, and the particles' output
  const Loop bare = loop_of(drop());
  const auto step = bare_step(1);
  Names expected{step.begin(), step.end()};
  expected.insert(
      {"run::monitor", "run::monitor_all", "swe::mass"});  // the last two at outputs and every hundredth step
  CHECK(bare.labels == expected);

  Scene scene = drop();
  Gauge gauge;
  gauge.name = "g", gauge.at = {0.1, 0};
  scene.gauges = {gauge};
  scene.run_ups = {{"r", {0.3, 0}, 0.1, 0.002, {}}};
  Transect line;
  line.name = "line", line.line = {{{-0.5, 0}, {0.5, 0}}}, line.time = 1e6, line.spacing = 0.1;
  scene.profiles = {line};
  CHECK(observers(scene) == 4 + 3);
  expected.insert({"sampling::depth", "sampling::run_up"});
  CHECK(loop_of(scene).labels == expected);

  scene = drop();
  scene.compare.steady = true;
  CHECK(observers(scene) == 4 + 1);
  CHECK(minus(loop_of(scene).labels, bare.labels) == Names{"run::largest_speed"});

  scene = drop();
  scene.rasters = Rasters{};
  scene.rasters->spacing = 0.1;
  scene.rasters->what = {Rasters::Quantity::depth};
  CHECK(minus(loop_of(scene).labels, bare.labels) == Names{"raster::cover"});
  scene.rasters->maxima = true;
  CHECK(minus(loop_of(scene).labels, bare.labels) == Names{"raster::cover", "raster::maxima"});
}

TEST_CASE("skips: looking at maxima in every step allocates nothing") {
  Scene scene = drop();
  scene.rasters = Rasters{};
  scene.rasters->spacing = 0.1;
  scene.rasters->maxima = true;
  CHECK(loop_of(scene).allocations == loop_of(drop()).allocations);
}
