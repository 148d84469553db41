// SISPH's conservative momentum: a dam break over a wet bed against Stoker's solution.
#include <catch2/catch.hpp>

#include <cmath>

#include "tests/support/run/scenes.hpp"

using namespace freshet;
using test::Flow;

namespace {

constexpr double gravity = 9.81;

// Where the water of the dam break is as deep as the mean of the states on both sides of the bore.
double bore(const Flow& flow, double level) {
  const auto x = flow.real("x"), depth = flow.real("depth");
  double place = -1e300;
  for (int i = 0; i + 1 < flow.size(); ++i)
    if (depth(i) > level && depth(i + 1) <= level)
      place = std::max(place, x(i) + (x(i + 1) - x(i)) * (depth(i) - level) / (depth(i) - depth(i + 1)));
  return place;
}

}  // namespace

TEST_CASE("sisph: a dam break 1 : 0.2 in conservative form") {
  // Stoker: middle depth from Newton, bore speed from the jump.
  const double left = 1, right = 0.2, time = 0.3;
  double h = 0.5;
  for (int n = 0; n < 200; ++n) {
    const double rarefaction = 2 * (std::sqrt(gravity * left) - std::sqrt(gravity * h));
    const double jump = (h - right) * std::sqrt(0.5 * gravity * (h + right) / (h * right));
    h += 0.05 * (rarefaction - jump);
  }
  const double exact = time * std::sqrt(0.5 * gravity * h * (h + right) / right);
  double before = 0;
  for (const int n : {400, 800, 1600}) {
    Scene scene = test::bare_scene(1, {-2, 0}, {2, 0}, 2.0 / n);  // implicit waves have tails
    scene.method = "sisph";
    scene.sph.eta = scene.sisph.smoothing;
    scene.sisph.theta = 0.6;
    scene.sisph.momentum = test::pick(sisph::momentum_forms(), "conservative");
    scene.water.depth = [](double x, double) { return x < 0 ? 1.0 : 0.2; };
    Flow flow(scene);
    const double dt = 0.5 * 2.0 / n / std::sqrt(gravity), momentum0 = flow.method->mechanics().momentum[0];
    while (flow.t < time - 1e-9) flow.step(std::min(dt, time - flow.t));
    const double error = bore(flow, 0.5 * (h + right)) - exact;
    const double gained = flow.method->mechanics().momentum[0] - momentum0,
                 pressed = 0.5 * gravity * (left * left - right * right) * flow.t;
    CAPTURE(n, exact, error, gained - pressed);
    CHECK(std::abs(error) <= 2 * 2.0 / n);
    if (n > 400) CHECK(before / std::abs(error) >= 1.5);
    CHECK(std::abs(gained / pressed - 1) <= 1e-13);
    before = std::abs(error);
  }
}
