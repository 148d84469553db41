// [[profile]]: points on the line, steps that end on the times, errors against measured points, restart.
#include <catch2/catch.hpp>

#include <cmath>

#include "src/io/files.hpp"
#include "src/run/driver.hpp"
#include "src/run/record/transects.hpp"
#include "tests/support/run/fake_method.hpp"
#include "tests/support/watch/scratch.hpp"

using namespace freshet;

namespace {

// Bed 0.1 x and depth 2 everywhere.
class Slope : public test::FakeMethod {
 public:
  explicit Slope(const Scene& scene) : FakeMethod(scene) {}
  std::vector<PointState> sample(const std::vector<Point>& points) const override {
    std::vector<PointState> states;
    for (const Point& p : points) states.push_back({0.1 * p[0], 2, true});
    return states;
  }
};

Scene scene_with(const Transect& transect) {
  Scene scene = test::fake_scene(2);
  scene.profiles = {transect};
  return scene;
}

Transect diagonal() {
  Transect p;
  p.name = "a";
  p.line = {{{0, 0}, {0.6, 0.8}}};
  p.spacing = 0.5;
  p.time = 0.3;
  return p;
}

}  // namespace

TEST_CASE("a transect lists the points of its line and the error at the measured ones") {
  const test::Scratch scratch;
  Transect p = diagonal();
  p.measured = Series{{-0.1, 0.25, 0.75, 1.1},
                      {9, 2.015 + 0.03, 2.045 - 0.04, 9}};  // the first and the last lie beyond the line
  const Scene scene = scene_with(p);
  const Slope method(scene);
  TransectRecorder transects(scene, scratch.path());
  CHECK(std::isnan(transects.results()[0].rmse));  // not taken yet
  transects.take(method, {0.2, 1});
  CHECK(std::isnan(transects.results()[0].rmse));
  transects.take(method, {0.3, 2});
  const TransectResult result = transects.results()[0];
  CHECK(result.points == 2);
  // Rounding only.
  CHECK(result.rmse == Approx(std::sqrt((0.03 * 0.03 + 0.04 * 0.04) / 2)).epsilon(1e-12));
  CHECK(result.max_abs_error == Approx(0.04).epsilon(1e-12));
  CHECK(result.measured_range == Approx(0.04).epsilon(1e-12));
  const std::string text = read_text(scratch / "profiles.csv");
  CHECK(std::count(text.begin(), text.end(), '\n') ==
        1 + 3 + 2);  // header, 0, 0.5 and 1 m along the line, measured
  CHECK(text.find("a,0.3,0.5,2.03,2,\n") != std::string::npos);
}

TEST_CASE("steps end on the times of transects and a restart keeps what was taken") {
  const test::Scratch scratch;
  Transect late = diagonal(), early = diagonal();
  early.name = "b";
  early.time = 0.1;
  Scene scene = scene_with(late);
  scene.profiles.push_back(early);
  const Slope method(scene);
  const test::Scratch elsewhere;
  TransectRecorder transects(scene, scratch.path()), again(scene, elsewhere.path());
  CHECK(transects.times.next() == 0.1);
  transects.take(method, {0.1, 1});
  Values values;
  transects.save(values);
  again.restore(values, {0.1, 1});
  transects.take(method, {0.3, 2});
  again.take(method, {0.3, 2});
  CHECK(read_text(scratch / "profiles.csv") == read_text(elsewhere / "profiles.csv"));
}

TEST_CASE("scenes without transects write no file of them") {
  const test::Scratch scratch;
  const Scene scene = test::fake_scene();
  test::FakeMethod method(scene);
  Driver driver(scene, method, {scratch.path()});
  driver.begin();
  CHECK(driver.run());
  CHECK_FALSE(std::filesystem::exists(scratch / "profiles.csv"));
  CHECK_FALSE(find<TransectRecorder>(driver.observers()));
}
