// Still water over a submerged hump (Vacondio 2010, (1.13)): what moves is error.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "tests/support/run_case.hpp"

using namespace freshet;

namespace {

double largest_speed(const Method& method) {
  const auto u = on_host(method.fields().real("u"));
  double speed = 0;
  for (int i = 0; i < method.fields().size(); ++i) speed = std::max(speed, std::abs(u(i)));
  return speed;
}

}  // namespace

TEST_CASE("a lake over a hump stays at rest") {
  const double dx = GENERATE(0.04, 0.02);  // m
  CAPTURE(dx);
  const Scene scene = test::read_case("lake_at_rest", {"water.spacing=" + std::to_string(dx)});
  const auto method = make_method(scene);
  const double celerity = std::sqrt(9.81 * 0.5);  // m/s, of the deepest water
  double fastest = 0;
  for (double t = 0; t < 10;) {
    const double dt = method->stable_dt();
    method->step(t, dt);
    t += dt;
    fastest = std::max(fastest, largest_speed(*method));
  }
  // The scheme is not well balanced on an arbitrary start: particles move until the summed density fits the bed. A prototype
  // with the exact bed reached 2.0e-3 and 2.5e-3; the thesis states < 0.01.
  CHECK(fastest / celerity <= 4e-3);
}
