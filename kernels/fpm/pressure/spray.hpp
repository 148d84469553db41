// Water too thin for its pressure to be known (docs/formulas/fpm.md (F24)): points with fewer than two inner
// points (a row of the pressure equation without a wall or surface) within 0.75 of their support, as in films
// of two rows, threads and shreds. A step may turn their velocities, but not make them faster than they and
// the points around were before it, in flight or not (by Bernoulli a free surface keeps its speed): else
// ragged shreds throw single points at several times their speed.
#pragma once
#include "kernels/fpm/pressure/projection.hpp"

namespace freshet::fpm {

// Limits v_star, the velocities after the pressure's part, by the speeds of v and v + tau force. Returns how
// many points it changed.
int limit_spray(const Neighbourhood<2>& around, const Flow& flow, const Vec<double, 2>& force, double tau);

}  // namespace freshet::fpm
