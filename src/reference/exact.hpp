// Exact shallow-water solutions that scenes start from and are compared with.
#pragma once
#include <functional>
#include <memory>
#include <string>

namespace freshet {

struct FlowState {
  double depth = 0;     // m
  double u = 0, v = 0;  // m/s; where the depth is 0 the formula goes on: no jump at a moving shoreline
};

class Exact {
 public:
  virtual ~Exact() = default;
  virtual FlowState at(double x, double y, double t) const = 0;  // m, m, s
  virtual double period() const { return 0; }                    // s; 0 = not periodic
};

// Wet dam break (Stoker 1957): depths left > right > 0 of a dam at x = dam.
std::unique_ptr<Exact> stoker(double left_depth, double right_depth, double dam, double gravity);
// The constant state between its rarefaction and its shock, and the speed of the shock.
struct StokerMiddle {
  double depth, u, shock;  // m, m/s, m/s
};
StokerMiddle stoker_middle(double left_depth, double right_depth, double gravity);

// Thacker (1981) in the bowl b = depth0 ((r/radius)^2 - 1) centred at (x0, y0).
struct Bowl {
  double depth0, radius;  // m: depth of the vertex, radius of the still shoreline
  double x0 = 0, y0 = 0;  // m
};
// Planar surface, thesis (2.61): displacement xi [m].
std::unique_ptr<Exact> thacker_planar(const Bowl& bowl, double xi, double gravity);
// The same in 1-D: the surface stays straight and sloshes, initially displaced by xi [m]; at rest then.
std::unique_ptr<Exact> thacker_sloshing(const Bowl& bowl, double xi, double gravity);
// Axisymmetric surface: amplitude A in (0, 1).
std::unique_ptr<Exact> thacker_radial(const Bowl& bowl, double amplitude, double gravity);

// Still water at `level` [m] over a bed [m]; no bed = flat at zero.
std::unique_ptr<Exact> still_water(double level, std::function<double(double, double)> bed);

}  // namespace freshet
