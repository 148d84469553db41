// Uniform flow in a sloping rectangular channel (Vacondio 2010, section 4.4) against Manning's formula.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "tests/support/run/run_case.hpp"

using namespace freshet;

TEST_CASE("flow in a sloping channel from rest becomes uniform", "[long]") {
  const Scene scene = test::read_case("sloping_channel");
  const auto method = make_method(scene);
  for (double t = 0; t < scene.end_time;) {
    const double dt = std::min(method->stable_dt(), scene.end_time - t);
    method->step(t, dt);
    t += dt;
  }
  const double depth = 5, speed = std::pow(depth, 2.0 / 3) * std::sqrt(0.001) / scene.manning->n,
               celerity = std::sqrt(9.81 * depth);
  const auto u = on_host(method->fields().real("u")), v = on_host(method->fields().real("v"));
  const auto d = on_host(method->fields().real("depth"));
  const auto kind = on_host(method->fields().integer("kind"));
  double along = 0, across = 0, deep = 0;
  for (int i = 0; i < method->fields().size(); ++i) {
    if (kind(i) != 0) continue;
    along = std::max(along, std::abs(u(i) - speed) / celerity);
    across = std::max(across, std::abs(v(i)) / celerity);
    deep = std::max(deep, std::abs(d(i) - depth) / depth);
  }
  CAPTURE(along, across, deep);
  // The thesis' own results.
  CHECK(along <= 0.0026);
  CHECK(across <= 0.0066);
  CHECK(deep <= 0.0109);
}
