// Gauges between the steps, dry gauges, run-ups.
#include <catch2/catch.hpp>

#include <cmath>

#include "src/io/files.hpp"
#include "src/run/observers.hpp"
#include "src/run/record/gauges.hpp"
#include "src/run/record/run_ups.hpp"
#include "tests/support/run/fake_method.hpp"
#include "tests/support/watch/scratch.hpp"

using namespace freshet;

namespace {

// A level that rises linearly in time, so that linear interpolation must be exact.
class Rising : public test::FakeMethod {
 public:
  explicit Rising(const Scene& scene) : FakeMethod(scene) {}
  double t = 0, depth_at_start = 1, rate = 0.5;  // s, m, m/s
  bool reached = true;
  mutable int samples = 0;
  std::vector<PointState> sample(const std::vector<Point>& points) const override {
    ++samples;
    PointState state;
    state.bed = -2;
    state.reached = reached;
    state.depth = depth_at_start + rate * t;
    return std::vector<PointState>(points.size(), state);
  }
};

void run(Rising& method, GaugeRecorder& gauges, const std::vector<double>& until) {
  gauges.begin(method);
  for (const double t : until) {
    gauges.before_step(method, {method.t, 0}, {t - method.t, t});
    method.t = t;
    gauges.after_step(method, {t, 0});
  }
}

Scene gauge_scene() {
  Scene scene = test::fake_scene(1);
  scene.end_time = 1;
  scene.output.gauges_every = 0.1;
  return scene;
}

}  // namespace

TEST_CASE("gauge values lie on the line between the steps around their time") {
  const test::Scratch scratch;
  const Scene scene = gauge_scene();
  Rising method(scene);
  GaugeRecorder gauges(scene, scratch.path());
  run(method, gauges,
      {0.03, 0.07, 0.1, 0.37, 0.99, 1.0});  // steps shorter and longer than the interval of 0.1 s
  REQUIRE(gauges.rows().size() == 11);
  for (const auto& row : gauges.rows()) {
    // Exact but for rounding of numbers of the order of 1: a few 2^-53.
    CHECK(row.value[0] == Approx(-2 + 1 + 0.5 * row.t).margin(1e-15));
    CHECK_FALSE(row.dry[0]);
  }
  CHECK(gauges.rows().back().t == 1.0);
}

TEST_CASE("gauges are sampled only around their times") {
  const test::Scratch scratch;
  const Scene scene = gauge_scene();
  Rising method(scene);
  GaugeRecorder gauges(scene, scratch.path());
  run(method, gauges, {0.01, 0.02, 0.03, 0.04, 0.05, 0.06});
  CHECK(method.samples == 1);  // the row at t = 0
}

TEST_CASE("a dry gauge shows the bed and is marked") {
  const test::Scratch scratch;
  const Scene scene = gauge_scene();
  Rising method(scene);
  const bool thin = GENERATE(true, false);
  method.reached = thin;  // else no particle is near, whatever depth is reported
  method.depth_at_start = thin ? 0.9 * dry_depth : 1;
  method.rate = 0;
  GaugeRecorder gauges(scene, scratch.path());
  run(method, gauges, {0.5, 1.0});
  for (const auto& row : gauges.rows()) {
    CHECK(row.value[0] == -2.0);
    CHECK(row.dry[0]);
  }
}

TEST_CASE("scenes without gauges have no recorder of them, and write no gauge file") {
  const test::Scratch scratch;
  Scene scene = gauge_scene();
  CHECK(find<GaugeRecorder>(make_observers(scene, scratch.path())));
  scene.gauges.clear();
  CHECK_FALSE(find<GaugeRecorder>(make_observers(scene, scratch.path())));
  CHECK_FALSE(std::filesystem::exists(scratch / "gauges.csv"));
}

TEST_CASE("run-ups keep the highest bed that was wet") {
  const Scene scene = test::fake_scene(1);
  test::FakeMethod method(scene);
  RunUpRecorder run_ups(scene);
  CHECK(run_ups.highest()[0].bed == -1e300);
  run_ups.after_step(method, {});
  // Bed 0.1 x; of the particles at 0.025 + 0.05 k the highest within 0.1 m of x = 0.9 is at 0.975, all are
  // deep enough.
  CHECK(run_ups.highest()[0].bed == Approx(0.0975).epsilon(1e-14));
  const double before = run_ups.highest()[0].bed;
  const auto depth = method.fields().real("depth");
  Kokkos::deep_copy(depth, 1e-3);  // thinner than min_depth
  run_ups.after_step(method, {});
  CHECK(run_ups.highest()[0].bed == before);
  Values values;
  run_ups.save(values);
  RunUpRecorder again(scene);
  again.restore(values, {});
  CHECK(again.highest()[0].bed == before);
  CHECK(again.highest()[0].line == run_ups.highest()[0].line);
}
