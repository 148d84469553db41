// SISPH with lateral viscosity between walls that slip or hold the water, against exact profiles and rates.
#include <catch2/catch.hpp>

#include <cmath>

#include "tests/support/run/scenes.hpp"
#include "tests/support/watch/recording.hpp"

using namespace freshet;
using test::Flow;

namespace {

constexpr double gravity = 9.81, viscosity = 0.05, width = 1, fastest = 0.05;  // m/s2, m2/s, m, m/s

Scene viscous_scene(const freshet::Point& low, const freshet::Point& high, double spacing, bool slip) {
  Scene scene = test::bare_scene(2, low, high, spacing);
  scene.method = "sisph";
  scene.sph.eta = scene.sisph.smoothing;
  scene.sisph.viscosity = viscosity;
  scene.sisph.slip = slip;
  scene.sisph.cg.tolerance = 1e-9;
  scene.water.depth = [](double, double) { return 1.0; };
  return scene;
}

double parabola(double y) { return fastest * 4 * y * (width - y) / (width * width); }

// A channel along x, its ends held at the state of t = 0.
Scene channel(double spacing, bool slip, const Function& along) {
  Scene scene = viscous_scene({0, 0}, {width, width}, spacing, slip);
  scene.walls = {Wall{{{0, 0}, {width, 0}}}, Wall{{{width, width}, {0, width}}}};
  scene.water.velocity = {along, [](double, double) { return 0.0; }};
  return scene;
}

// Largest error of the velocity over the fastest, steady under gravity down a slope against the drag of both
// walls: the water between the ends starts at rest.
double profile_error(double spacing, const std::string& momentum, double disorder) {
  const auto along = [](double x, double y) { return x > 0 && x < width ? 0.0 : parabola(y); };
  Scene scene = channel(spacing, false, along);
  const double slope = 8 * viscosity * fastest / (gravity * width * width);
  scene.bed.elevation = [slope](double x, double) { return -slope * x; };
  scene.sisph.momentum = test::pick(sisph::momentum_forms(), momentum);
  scene.sisph.courant = 5;
  scene.water.disorder = disorder;
  Flow flow(scene);
  flow.run(30);  // the slowest part has died down by exp(-pi^2 nu t) = 4e-7
  const auto kind = std::as_const(*flow.method).fields().integer("kind");
  double worst = 0;
  for (int i = 0; i < flow.size(); ++i)
    if (kind(i) == 0)
      worst = std::max(
          worst, std::hypot(flow.real("u")(i) - parabola(flow.real("y")(i)), flow.real("v")(i)) / fastest);
  return worst;
}

// Water that turns in a circular tank, J1(k r) with k R the first zero: its kinetic energy decays with exp(-2
// nu k^2 t).
double decay_error(double spacing, double disorder) {
  constexpr double radius = 0.5, k = 3.8317059702075123 / radius;
  Scene scene = viscous_scene({-0.6, -0.6}, {0.6, 0.6}, spacing, false);
  Wall wall;
  for (int n = 0; n <= 400; ++n)
    wall.line.push_back(
        {radius * std::cos(2 * pi * (n % 400) / 400), radius * std::sin(2 * pi * (n % 400) / 400)});
  scene.walls = {wall};
  scene.water.disorder = disorder;
  const auto swirl = [](double x, double y) {
    return fastest * std::cyl_bessel_j(1.0, k * std::hypot(x, y)) / (std::hypot(x, y) + 1e-12);
  };
  scene.water.velocity = {[swirl](double x, double y) { return -y * swirl(x, y); },
                          [swirl](double x, double y) { return x * swirl(x, y); }};
  scene.sisph.momentum = test::pick(sisph::momentum_forms(), "semi-lagrangian");
  // viscosity is of first order in time: nu k^2 dt / 2 = 0.6 % at the finer spacing
  scene.sisph.courant = 0.5;
  Flow flow(scene);
  flow.run(0.05);  // waves of the start leave the swirl alone
  const double start = flow.method->mechanics().kinetic, time = flow.t;
  flow.run(0.35);
  return std::log(flow.method->mechanics().kinetic / start) / (-2 * viscosity * k * k * (flow.t - time)) - 1;
}

}  // namespace

TEST_CASE("sisph viscosity: water on a slope between walls that hold it takes the parabolic profile",
          "[slow]") {
  const std::string momentum = GENERATE("semi-lagrangian", "mass-flux");
  const double coarse = profile_error(0.1, momentum, 0), fine = profile_error(0.05, momentum, 0);
  CAPTURE(momentum, coarse, fine);
  CHECK(fine < 0.01);
  CHECK(coarse / fine > 3);  // second order
}

TEST_CASE("sisph viscosity: the profile on particles moved by 0.2 dx") {
  const double error = profile_error(0.05, "semi-lagrangian", 0.2);
  CAPTURE(error);
  CHECK(error < 0.05);
}

TEST_CASE(
    "sisph viscosity: a uniform current slides along walls that slip and is held by those that do not") {
  const auto speed = [](bool slip) {
    Flow flow(channel(0.1, slip, [](double, double) { return fastest; }));
    flow.run(2);
    double least = 1e300;
    for (int i = 0; i < flow.size(); ++i) least = std::min(least, flow.real("u")(i));
    return least / fastest;
  };
  CHECK(std::abs(speed(true) - 1) < 1e-12);
  CHECK(speed(false) < 0.8);
}

TEST_CASE("sisph viscosity: a swirl in a round tank that holds it decays at Bessel's rate") {
  const double coarse = decay_error(0.05, 0), fine = decay_error(0.025, 0),
               disordered = decay_error(0.025, 0.2);
  CAPTURE(coarse, fine, disordered);
  CHECK(std::abs(fine) < 0.02);
  CHECK(std::abs(disordered) < 0.02);
}

TEST_CASE("sisph viscosity: nothing is allocated within a step") {
  Flow flow(channel(0.1, false, [](double, double y) { return parabola(y); }));
  for (int n = 0; n < 3; ++n) flow.step(0.02);
  const test::Recording recording;
  for (int n = 0; n < 3; ++n) flow.step(0.02);
  CHECK(recording.allocations == std::vector<std::string>{});
  CHECK(recording.labels().count("sisph::viscous_product") == 1);
}
