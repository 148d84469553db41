#include "src/reference/incompressible/drop.hpp"

#include <cmath>

namespace freshet {
namespace {

double rate(double q) { return std::sqrt(std::cosh(2 * q)); }

// int_0^s sqrt(cosh 2q) dq by Simpson's rule; 400 intervals: 1e-13 up to s = 3.
double time_of(double s) {
  const int n = 400;
  double sum = rate(0) + rate(s);
  for (int k = 1; k < n; ++k) sum += (k % 2 == 1 ? 4 : 2) * rate(s * k / n);
  return sum * s / (3 * n);
}

}  // namespace

DropState drop_at(const Drop& drop, double t) {
  const double target = drop.strain * t;
  double s = std::asinh(target);  // Newton's method from the right: time_of is convex
  for (int k = 0; k < 50; ++k) {
    const double step = (time_of(s) - target) / rate(s);
    s -= step;
    if (std::abs(step) < 1e-14 * (1 + s)) break;
  }
  DropState d{drop.strain / rate(s), drop.radius * std::exp(-s), drop.radius * std::exp(s), 0};
  const double a2 = d.a * d.a, b2 = d.b * d.b;
  d.top = drop.density * d.strain * d.strain * a2 * b2 / (a2 + b2);
  return d;
}

}  // namespace freshet
