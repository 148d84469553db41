// Radially (or plane) symmetric shallow water over a flat bed by finite volumes: for flows without a closed
// form, such as the circular dam break. MUSCL reconstruction, HLL flux (Harten, Lax and van Leer 1983; wave
// speeds of Toro 2001, dry states included), Heun in time: second order where the flow is smooth.
#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "src/reference/exact.hpp"

namespace freshet {

// Depth and outward velocity at one time, linear between the centres of equal rings.
struct RadialProfile {
  double ring = 0;                           // m, width; centres at (k + 1/2) ring
  std::vector<double> depth, speed;          // m, m/s; the last ring's state goes on outwards
  FlowState at(double rx, double ry) const;  // m from the centre
  double front(double least_depth) const;    // m, outermost radius that is at least so deep; 0 if none
};

// Water at rest with depth initial(r) in r < extent, `rings` of equal width, at time t. The state beyond must
// not have been reached by then. Cost: rings^2.
RadialProfile radial_flow(const std::function<double(double)>& initial, double extent, double t, int rings,
                          double gravity);
// The same between planes: depth initial(|x|) in 1-D.
RadialProfile plane_flow(const std::function<double(double)>& initial, double extent, double t, int rings,
                         double gravity);

// Depth level + amplitude exp(-r^2 / (2 sigma^2)) at t = 0, carried along by a uniform flow.
struct GaussianHump {
  double level, amplitude, sigma;  // m
  double x0 = 0, y0 = 0;           // m, centre at t = 0
  double u = 0, v = 0;             // m/s
  bool plane = false;              // 1-D
};
// The last time asked for is kept, as below.
std::unique_ptr<Exact> gaussian_hump(const GaussianHump& hump, double gravity, int rings = 3000);

struct RadialDam {
  double inner, outer, radius;  // m: depths inner > outer >= 0
  double x0 = 0, y0 = 0;        // m, centre
};
// The last time asked for is kept: at() costs an interpolation while the time stays the same. One thread at a
// time.
std::unique_ptr<Exact> radial_dam_break(const RadialDam& dam, double gravity, int rings = 4000);

// The profile that it interpolates.
RadialProfile radial_dam_profile(const RadialDam& dam, double t, double gravity, int rings = 4000);

}  // namespace freshet
