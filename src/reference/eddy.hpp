// A steady eddy on flat still water: v(r) = speed (r / radius) exp((1 - (r/radius)^2) / 2), fastest at the
// radius; the surface sinks by speed^2 / (2 g) exp(1 - (r/radius)^2), whose slope turns the water (v^2 / r =
// g d eta / d r). Exact for any Froude number.
#pragma once
#include "src/reference/exact.hpp"

namespace freshet {

struct Eddy {
  double level = 1, speed = 0, radius = 1;  // m, m/s (positive: anticlockwise), m
  double x0 = 0, y0 = 0;                    // m
};

std::unique_ptr<Exact> eddy(const Eddy& eddy, double gravity);

}  // namespace freshet
