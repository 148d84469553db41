// Collapse of a column of water: the accelerations at the first instant against their series (FPM-FORMULAS 9 a; Pohle, Stoker).
#include <catch2/catch.hpp>

#include "tests/support/flow.hpp"

using namespace freshet;

namespace {

constexpr double pi = 3.14159265358979323846, g = 9.81, height = 1, length = 1.5;

double wave_number(int m) { return (m + 0.5) * pi / height; }

// Horizontal acceleration of the free face, x = 0.
double face(double y) {
  double sum = 0;
  for (int m = 0; m < 4000; ++m) sum += 2 * g / ((m + 0.5) * pi) * std::cos(wave_number(m) * y) * std::tanh(wave_number(m) * length);
  return sum;
}

// Vertical acceleration of the top, y = height, at -length < x < 0.
double top(double x) {
  double sum = 0;
  for (int m = 0; m < 400; ++m) {
    const double k = wave_number(m);
    sum -= (m % 2 ? -1 : 1) * 2 * g / ((m + 0.5) * pi) * (std::exp(k * x) + std::exp(-k * (x + 2 * length))) / (1 + std::exp(-2 * k * length));
  }
  return sum;
}

struct Deviations {
  double face, top;  // rms, x g
};

Deviations first_instant(int points) {
  const std::string dx = std::to_string(height / points);
  test::FlowRun run("fpm_dam_break", {"domain.box=[-1.5, 0, 1.5, 2]", "body.0.box=[-1.5, 0, 0, 1]", "water.spacing=" + dx, "fluid.viscosity=0",
                                      "wall.0.line=[[-1.5, 2], [-1.5, 0], [1.5, 0], [1.5, 2]]", "time.end=1", "output.every=1"});
  const double dt = 1e-6;
  run.solver.step(0, dt);
  double face2 = 0, top2 = 0;
  int faces = 0, tops = 0;
  for (const auto& q : run.points()) {
    if (std::abs(q.x) < 1e-4 && q.y > 0.25 && q.y < 0.95) face2 += std::pow((q.u / dt - face(q.y)) / g, 2), ++faces;
    if (std::abs(q.y - height) < 1e-4 && q.x > -0.95 * length && q.x < -0.05) top2 += std::pow((q.v / dt - top(q.x)) / g, 2), ++tops;
  }
  REQUIRE(faces > 5);
  REQUIRE(tops > 5);
  return {std::sqrt(face2 / faces), std::sqrt(top2 / tops)};
}

}  // namespace

TEST_CASE("The first instant of a dam break has the exact accelerations, with order 2") {
  const Deviations coarse = first_instant(10), fine = first_instant(40);
  CAPTURE(coarse.face, coarse.top, fine.face, fine.top);
  CHECK(fine.face <= 3.5e-4);  // issue 6
  CHECK(fine.top <= 3.5e-4);
  CHECK(std::log(coarse.face / fine.face) / std::log(4.0) >= 1.9);
  CHECK(std::log(coarse.top / fine.top) / std::log(4.0) >= 1.9);
}
