// Incompressible flows with exact solutions: Taylor-Green vortices and the drop that becomes an ellipse,
// docs/formulas/fpm.md (F33), (F34).
#include <catch2/catch.hpp>

#include "tests/support/run/flow.hpp"

using namespace freshet;

namespace {

// Root mean square of the velocity's error per component, at 2 s.
double vortex_error(double spacing, const std::string& diffusion = "explicit") {
  test::FlowRun run("fpm_taylor_green",
                    {"water.spacing=" + std::to_string(spacing), "fpm.diffusion=" + diffusion});
  run.run_to(2);
  const double decay = std::exp(-8 * pi * pi * 1e-3 * run.clock.t);
  double sum = 0;
  const auto points = run.points();
  for (const auto& q : points) {
    const double u = -std::cos(2 * pi * q.x) * std::sin(2 * pi * q.y) * decay,
                 v = std::sin(2 * pi * q.x) * std::cos(2 * pi * q.y) * decay;
    sum += std::pow(q.u - u, 2) + std::pow(q.v - v, 2);
  }
  return std::sqrt(sum / (2.0 * static_cast<double>(points.size())));
}

struct DropErrors {
  double a = 0, b = 0, pressure = 0;  // of the semi-axes and, rms, of the pressure: relative
};

// Against the closed form, at A0 t = 2.
DropErrors drop_errors(int points_a_radius) {
  test::FlowRun run("fpm_drop", {"water.spacing=" + std::to_string(1.0 / points_a_radius)});
  run.run_to(2);
  const double a = 0.27181408, b = 3.67898532, top = 10.799;  // m; Pa in the centre
  double found_a = 0, found_b = 0, square = 0;
  const auto points = run.points();
  for (const auto& q : points) {
    found_a = std::max(found_a, std::abs(q.x)), found_b = std::max(found_b, std::abs(q.y));
    square += std::pow(q.p / top - (1 - q.x * q.x / (a * a) - q.y * q.y / (b * b)), 2);
  }
  return {std::abs(found_a / a - 1), std::abs(found_b / b - 1),
          std::sqrt(square / static_cast<double>(points.size()))};
}

}  // namespace

// Fits by quadratic polynomials and steps of second order: order 2 at least. The thesis found between 1 and 2
// (its Fig. 5.7). The sizes beside it are a prototype's 8.4e-3, 8.6e-4 and 1.0e-4 with a margin.
TEST_CASE("Taylor-Green vortices of 20 and 40 points a side decay as they should") {
  const double coarse = vortex_error(0.05), fine = vortex_error(0.025);
  CAPTURE(coarse, fine);
  CHECK(coarse <= 9.5e-3);
  CHECK(fine <= 1.0e-3);
  CHECK(std::log2(coarse / fine) >= 2);
}

TEST_CASE("Taylor-Green vortices of 80 points a side decay as they should", "[slow]") {
  const double coarse = vortex_error(0.025), fine = vortex_error(0.0125);
  CAPTURE(coarse, fine);
  CHECK(fine <= 1.3e-4);
  CHECK(std::log2(coarse / fine) >= 2);
}

TEST_CASE("Taylor-Green vortices decay as well with implicit viscosity") {
  const double coarse = vortex_error(0.05, "implicit"), fine = vortex_error(0.025, "implicit");
  CAPTURE(coarse, fine);
  CHECK(fine <= 1.0e-3);
  CHECK(std::log2(coarse / fine) >= 2);
}

TEST_CASE("A strained drop has the exact ellipse's axes and pressure") {
  const DropErrors coarse = drop_errors(15), fine = drop_errors(30);
  CAPTURE(coarse.a, coarse.b, coarse.pressure, fine.a, fine.b, fine.pressure);
  CHECK(fine.a <= 5e-4);
  CHECK(fine.b <= 2e-3);
  CHECK(fine.pressure <= 1e-3);
  // First order: places at the surface are those of its points. The short semi-axis, 4 and 8 spacings
  // long and off by a thousandth of one, falls short of it: 0.94 was found.
  CHECK(std::log2(coarse.a / fine.a) >= 0.9);
  CHECK(std::log2(coarse.b / fine.b) >= 1);
  CHECK(std::log2(coarse.pressure / fine.pressure) >= 1);
}
