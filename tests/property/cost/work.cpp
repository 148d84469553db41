// What methods tell of the work of their launches is of launches that there are, and of as many pairs.
#include <catch2/catch.hpp>

#include "src/scene/read.hpp"
#include "tests/support/run/sisph_cases.hpp"
#include "tests/support/watch/recording.hpp"

using namespace freshet;

namespace {

// Water that is not level, so that solvers have work, between walls.
Scene sloping(int dimension) {
  Scene scene = test::bare_scene(dimension, {0, 0}, {2, dimension == 2 ? 1.0 : 0.0}, 0.05);
  scene.method = "sisph";
  scene.sisph.smoothing = 1.2;  // pairs within 2.4 dx: two on each side
  scene.water.depth = [](double x, double) { return 1 + 0.1 * x; };
  test::close_box(scene);
  return scene;
}

void check_labels(Method& method) {
  const test::Recording recording;
  for (double t = 0, k = 0; k < 3; ++k) {
    const double dt = method.stable_dt();
    method.step(t, dt);
    t += dt;
  }
  const std::set<std::string> launched = recording.labels();
  const auto all = method.work();
  CHECK(all.size() >= 4);
  for (const auto& [label, work] : all) {
    CAPTURE(label, work.particles, method.fields().size());
    CHECK(launched.count(label) == 1);
    CHECK(work.particles == method.fields().size());
    CHECK((work.bytes > 0) == (work.flops > 0));
  }
}

}  // namespace

TEST_CASE("work: the launches that SISPH tells of are there, at rest and moving") {
  Scene scene = sloping(2);
  scene.sisph.moving = GENERATE(false, true);
  CAPTURE(scene.sisph.moving);
  check_labels(*make_method(scene));
}

TEST_CASE("work: the launches that FPM tells of are there") {
  check_labels(*make_method(read_scene("cases/fpm_drop.toml", {"water.spacing=0.1"})));
}

TEST_CASE("work: a product of SISPH has the pairs of a line between two walls, images among them") {
  const auto method = make_method(sloping(1));
  method->step(0, method->stable_dt());
  CHECK(method->work().at("sisph::product").pairs == 4 * method->fields().size());
}
