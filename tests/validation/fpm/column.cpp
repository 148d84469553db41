// The first instant of a dam break: accelerations against the exact series.
#include <catch2/catch.hpp>

#include "src/reference/incompressible/column.hpp"
#include "tests/support/run/flow.hpp"

using namespace freshet;

namespace {

struct Errors {
  double face = 0, top = 0;  // rms, of g
};

// The first step from rest makes v = dt a, whatever dt is.
Errors errors_at(double spacing) {
  test::FlowRun run("fpm_column", {"water.spacing=" + std::to_string(spacing)});
  const WaterColumn column{2.5, 1, 9.81};
  const double dt = 1e-4;
  run.solver.step(0, dt);
  Errors e;
  int faces = 0, tops = 0;
  for (const auto& q : run.points()) {
    if (std::abs(q.x) < 1e-3 * spacing && q.y > 0.25 && q.y < 0.95)
      e.face += std::pow(q.u / dt - face_acceleration(column, q.y), 2), ++faces;
    if (std::abs(q.y - 1) < 1e-3 * spacing)
      e.top += std::pow(q.v / dt - top_acceleration(column, q.x), 2), ++tops;
  }
  return {std::sqrt(e.face / faces) / column.gravity, std::sqrt(e.top / tops) / column.gravity};
}

}  // namespace

TEST_CASE("fpm column: the accelerations of the first instant are exact to second order") {
  const Errors coarse = errors_at(0.1), middle = errors_at(0.05), fine = errors_at(0.025);
  CAPTURE(coarse.face, middle.face, fine.face, coarse.top, middle.top, fine.top);
  // H / dx = 40.
  CHECK(fine.face <= 3.5e-4);
  CHECK(fine.top <= 3.5e-4);
  // Order 2: a factor of 4 per halving, 3.4 with what irregular leading terms leave.
  CHECK(middle.face / fine.face > 3.4);
  CHECK(middle.top / fine.top > 3.4);
}
