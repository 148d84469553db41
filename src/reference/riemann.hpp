// Exact solution of the Riemann problem of the shallow water equations over a flat bed (Toro 2001, ch. 5 and
// 6): two constant states with velocities, each of which may leave a dry middle.
#pragma once
#include <memory>

#include "src/reference/exact.hpp"

namespace freshet {

struct RiemannState {
  double depth, u;  // m > 0, m/s
};
struct RiemannMiddle {
  double depth, u;  // m, m/s; depth 0: the two rarefactions leave a dry bed between them
};
RiemannMiddle riemann_middle(const RiemannState& left, const RiemannState& right, double gravity);

// The states meet at x = at when t = 0.
std::unique_ptr<Exact> riemann(const RiemannState& left, const RiemannState& right, double at,
                               double gravity);

}  // namespace freshet
