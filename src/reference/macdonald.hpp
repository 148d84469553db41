// Steady channel flow with Manning friction after MacDonald (1997; SWASHES, Delestre et al. 2013,
// section 3.2): the depth is prescribed, unit width, and the bed follows from dz/dx = (q^2/(g d^3) - 1) d' -
// S_f with S_f = n^2 q^2 / d^(10/3).
#pragma once
#include <functional>
#include <memory>

#include "src/reference/exact.hpp"

namespace freshet {

struct ChannelFlow {
  std::function<double(double, double)> depth;  // m, of x alone (called with y = 0); positive
  double discharge;                             // m2/s
};

// The prescribed depth d and the velocity q/d at all times.
std::unique_ptr<Exact> macdonald(const ChannelFlow& flow);

// m, the bed under that flow, 0 at x = length [m], for Manning's n [s/m^(1/3)]: the integrated form z + d +
// q^2/(2 g d^2) = head, where only the friction lowers the head. Beyond 0 and length the friction slope stays
// what it is there.
std::function<double(double, double)> macdonald_bed(const ChannelFlow& flow, double manning, double length,
                                                    double gravity);

}  // namespace freshet
