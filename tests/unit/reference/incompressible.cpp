// The exact incompressible flows that FPM is compared with.
#include <catch2/catch.hpp>

#include <cmath>

#include "cellgrid/parallel/types.hpp"
#include "src/reference/incompressible/column.hpp"
#include "src/reference/incompressible/drop.hpp"

using namespace freshet;

// Independent numbers: an integration of A' = A^2 (a^2 - b^2) / (a^2 + b^2), a' = -A a, b' = A b, and a
// potential-flow computation with 160 markers, which agree to eight digits.
TEST_CASE("reference drop: the table of the ordinary differential equation") {
  const double table[][5] = {{0.2, 0.96270219, 0.82082616, 1.21828476, 0.429475},
                             {0.6, 0.77616054, 0.57880935, 1.72768459, 0.181458},
                             {1.0, 0.61021577, 0.43946077, 2.27551598, 0.069327},
                             {2.0, 0.38335826, 0.27181408, 3.67898532, 0.010799}};
  for (const auto& row : table) {
    const DropState d = drop_at({1, 1, 1}, row[0]);
    CHECK(d.strain == Approx(row[1]).margin(6e-9));  // printed digits
    CHECK(d.a == Approx(row[2]).margin(6e-9));
    CHECK(d.b == Approx(row[3]).margin(6e-9));
    CHECK(d.top == Approx(row[4]).margin(6e-7));
  }
}

TEST_CASE("reference drop: area, energy and units") {
  const Drop drop{2, 3, 1000};
  for (const double t : {0.0, 0.3, 1.0, 2.0}) {
    const DropState d = drop_at(drop, t);
    CHECK(d.a * d.b == Approx(9));
    CHECK(d.strain * d.strain * (d.a * d.a + d.b * d.b) == Approx(2 * 4 * 9));  // kinetic energy
  }
  CHECK(drop_at(drop, 0).top == Approx(0.5 * 1000 * 4 * 9));  // (5.27)
  CHECK(drop_at(drop, 0).pressure(3, 0) == Approx(0).margin(1e-9));
}

// One-sided second-order differences of the pressure, which is 0 on the free sides; e^2 / 3 x the third
// derivative is about 1e-5 g.
TEST_CASE("reference column: accelerations are those of its pressure") {
  for (const WaterColumn& c : {WaterColumn{1, 1, 9.81}, WaterColumn{0.5, 2, 1}, WaterColumn{30, 1, 9.81}}) {
    const double e = 1e-3 * c.height;
    for (const double part : {0.3, 0.6, 0.9}) {
      const double y = part * c.height, x = -part * c.length;
      const double ax = (4 * column_pressure(c, -e, y) - column_pressure(c, -2 * e, y)) / (2 * e);
      const double ay =
          (4 * column_pressure(c, x, c.height - e) - column_pressure(c, x, c.height - 2 * e)) / (2 * e) -
          c.gravity;
      CHECK(face_acceleration(c, y) == Approx(ax).margin(1e-4 * c.gravity));
      CHECK(top_acceleration(c, x) == Approx(ay).margin(1e-4 * c.gravity));
    }
  }
}

TEST_CASE("reference column: falls freely at the corner, rests far inside") {
  const WaterColumn c{40, 1, 9.81};
  CHECK(top_acceleration(c, 0) == Approx(-9.81));
  CHECK(top_acceleration(c, -20) == Approx(0).margin(1e-9));
  CHECK(face_acceleration(c, 1) == Approx(0).margin(1e-9));
  CHECK(face_acceleration(c, 0.5) == Approx(2 * 9.81 / pi * std::log(1 / std::tan(pi / 8))));
  CHECK(column_pressure(c, -20, 0.25) == Approx(9.81 * 0.75));
}
