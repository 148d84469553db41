#include "src/reference/incompressible/column.hpp"

#include <cmath>

#include "cellgrid/parallel/types.hpp"

namespace freshet {
namespace {

// cosh(k (x + L)) / cosh(k L) without overflow, x <= 0.
double ratio(double k, double x, double length) {
  return (std::exp(k * x) + std::exp(-k * (x + 2 * length))) / (1 + std::exp(-2 * k * length));
}

// Sums term(m, k_m) over m = 0, 1, ... with k_m = (m + 1/2) pi / height until `fade` per term leaves nothing.
template <class Term>
double sum_modes(double height, double fade, const Term& term) {
  double sum = 0;
  for (int m = 0; m < 100000; ++m) {
    const double k = (m + 0.5) * pi / height;
    sum += term(m, k);
    if (k * fade > 40) break;
  }
  return sum;
}

}  // namespace

// The infinite column's closed form and what the far wall changes, which fades like exp(-2 k L).
double face_acceleration(const WaterColumn& c, double y) {
  const double infinite = 2 * c.gravity / pi * std::log(1 / std::tan(pi * y / (4 * c.height)));
  return infinite + sum_modes(c.height, 2 * c.length, [&](int, double k) {
           return 2 * c.gravity / (k * c.height) * std::cos(k * y) * (std::tanh(k * c.length) - 1);
         });
}

double top_acceleration(const WaterColumn& c, double x) {
  const double infinite = -4 * c.gravity / pi * std::atan(std::exp(pi * x / (2 * c.height)));
  return infinite - sum_modes(c.height, c.length, [&](int m, double k) {
           return 2 * c.gravity * (m % 2 == 0 ? 1 : -1) / (k * c.height) *
                  (ratio(k, x, c.length) - std::exp(k * x));
         });
}

double column_pressure(const WaterColumn& c, double x, double y) {
  return c.gravity * (c.height - y) - sum_modes(c.height, -x, [&](int, double k) {
           return 2 * c.gravity / (k * k * c.height) * std::cos(k * y) * ratio(k, x, c.length);
         });
}

}  // namespace freshet
