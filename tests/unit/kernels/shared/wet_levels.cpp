// The highest water on a slope: beds rise from particle to particle, the waterline is that of the water.
#include <catch2/catch.hpp>

#include "src/run/record/run_ups.hpp"
#include "tests/support/run/scenes.hpp"

using namespace freshet;

namespace {

constexpr double slope = 0.25, spacing = 0.02, least = 1e-3;  // m, m

WetLevels highest(Scene scene, const RunUp& at) {
  scene.run_ups = {at};
  RunUpRecorder recorder(scene);
  recorder.begin(*make_method(scene));
  return recorder.highest()[0];
}

WetLevels of_lake(const std::string& method, double surface) {
  Scene scene = test::bare_scene(1, {0, 0}, {2, 0}, spacing);
  scene.method = method;
  if (method == "sisph") scene.sph.eta = scene.sisph.smoothing;
  scene.bed.elevation = [](double x, double) { return slope * (x - 1); };
  scene.water.surface = [surface](double, double) { return surface; };
  test::close_box(scene);
  return highest(scene, {"", {1, 0}, 0.5, least, {}});
}

}  // namespace

// The bed rises by 5 mm between neighbours; water thinner than `least` counts as none.
TEST_CASE("run-up: the waterline of still water on a slope is its surface wherever particles stand") {
  for (const double surface : {0.0, 0.0011, 0.0024, 0.0035, 0.0049}) {
    CAPTURE(surface);
    const WetLevels found = of_lake("sisph", surface);
    CHECK(found.line <= surface + 1e-12);
    CHECK(found.line >= surface - least - 1e-12);
    CHECK(found.bed <= surface - least + 1e-12);
    CHECK(found.bed >= surface - least - slope * spacing - 1e-12);
  }
}

// Sums over neighbours round the water's edge off.
TEST_CASE("run-up: the explicit method reads the same waterline to half a rise of the bed") {
  for (const double surface : {0.0, 0.0011, 0.0024, 0.0035, 0.0049}) {
    CAPTURE(surface);
    CHECK(of_lake("sph-swe", surface).line == Approx(surface).margin(0.5 * slope * spacing));
  }
}

TEST_CASE("run-up: none where the place is dry") {
  Scene scene = test::bare_scene(1, {0, 0}, {2, 0}, spacing);
  scene.water.depth = [](double x, double) { return x < 1 ? 1.0 : 0.0; };
  CHECK(highest(scene, {"", {1.5, 0}, 0.2, least, {}}).bed == -1e300);
}
