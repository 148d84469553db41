// A circular drop of an ideal fluid that starts with the velocity (-A0 x, A0 y), without any force: it stays
// an ellipse with the velocity (-A x, A y) (docs/formulas/fpm.md (F34)). In closed form, with R the radius at
// the start:
//   a = R e^-s, b = R e^s, A = A0 / sqrt(cosh 2s), A0 t = int_0^s sqrt(cosh 2q) dq,
//   p = rho A^2 a^2 b^2 / (a^2 + b^2) (1 - x^2/a^2 - y^2/b^2)
#pragma once

namespace freshet {

struct Drop {
  double strain = 1;      // 1/s, A0
  double radius = 1;      // m, R
  double density = 1000;  // kg/m3
};

struct DropState {
  double strain;  // 1/s, A
  double a, b;    // m, semi-axes along x and y
  double top;     // Pa, pressure in the centre
  double pressure(double x, double y) const { return top * (1 - x * x / (a * a) - y * y / (b * b)); }
};

// t >= 0 [s].
DropState drop_at(const Drop& drop, double t);

}  // namespace freshet
