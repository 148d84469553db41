// SISPH: what a shore does must not hang on rounding. Thacker's planar bowl with cells of 100 m, twice, the
// second with a bed that differs by 1e-12 of itself. With depths between particles that jump where one falls
// dry, films of 0.06 m differed after one step.
#include <catch2/catch.hpp>

#include "tests/support/run/scenes.hpp"

using namespace freshet;
using test::Flow;

namespace {

constexpr double depth = 10, radius = 3000, aside = 1500, gravity = 9.81;  // m, m, m, m/s2

Scene bowl(double disorder, double changed) {
  Scene scene = test::bare_scene(2, {-5000, -5000}, {5000, 5000}, 100);
  scene.method = "sisph";
  scene.sph.eta = scene.sisph.smoothing;
  const auto bed = [changed](double x, double y) {
    return depth * ((x * x + y * y) / (radius * radius) - 1) * (1 + changed * std::sin(0.0123 * x * y));
  };
  scene.bed.elevation = bed;
  scene.water.surface = [](double x, double) { return depth * aside / (radius * radius) * (2 * x - aside); };
  scene.water.depth = [bed](double x, double y) {
    return depth * aside / (radius * radius) * (2 * x - aside) - bed(x, y);
  };
  scene.water.velocity = {[](double, double) { return 0.0; },
                          [](double, double) { return aside / radius * std::sqrt(2 * gravity * depth); }};
  scene.water.disorder = disorder;
  return scene;
}

}  // namespace

TEST_CASE("sisph: a shoreline does not follow rounding") {
  const double disorder = GENERATE(0.0, 0.2);
  Flow flow(bowl(disorder, 0)), other(bowl(disorder, 1e-12));
  double largest = 0, squares = 0;
  const double end = 336;  // a quarter of a period
  while (flow.t < end) {
    const double dt = flow.method->stable_dt();
    flow.step(dt);
    other.step(dt);
    largest = std::max(largest, test::largest_difference(flow.by_id("depth"), other.by_id("depth")));
  }
  const auto a = flow.by_id("depth"), b = other.by_id("depth");
  for (std::size_t i = 0; i < a.size(); ++i) squares += (a[i] - b[i]) * (a[i] - b[i]);
  const double rms = std::sqrt(squares / static_cast<double>(a.size()));
  CAPTURE(disorder, largest, rms);
  // Measured 1.2e-6 and 9e-9 m: where the tolerance of the solver (1e-6) takes an iteration more.
  CHECK(largest < 1e-4 * depth);
  CHECK(rms < 1e-6 * depth);
}
