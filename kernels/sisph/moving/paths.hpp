// Paths of particles whose velocities are known at the ends of a step: places as weighted sums of velocities
// (Bankole 2016, (5.51)-(5.59), L(r) the particle's own velocity; docs/formulas/sisph.md (I36)):
//   x^{n+1} = x^n + dt (before v^{n-1} + start v^n + end v^{n+1}),   x^{n+1/2} = x^n + dt/2 (half_start v^n +
//   half_end v^{n+1})
// The middle is where the geometry of the step is taken.
#pragma once
#include <vector>

namespace freshet::sisph {

struct PathWeights {
  double before, start, end;    // of v^{n-1}, v^n, v^{n+1}; their sum is 1
  double half_start, half_end;  // their sum is 1
};

// theta: implicitness; dt: the step [s]; last: the step before [s], 0 = there was none.
struct PathStep {
  double theta, dt, last;
};

// The weights of the momentum's own step: theta = 1/2 is of second order.
inline PathWeights theta_path(const PathStep& s) { return {0, 1 - s.theta, s.theta, 0.5, 0.5}; }
inline PathWeights euler_path(const PathStep&) { return {0, 1, 0, 1, 0}; }
// Heun's method, the "optimal" one of second order (5.52)-(5.53).
inline PathWeights rk2_path(const PathStep&) { return {0, 0.5, 0.5, 0.5, 0.5}; }
// Drift, kick, drift: places at the middle of steps follow each other by whole steps of v (5.57).
inline PathWeights leap_frog_path(const PathStep&) { return {0, 0.5, 0.5, 1, 0}; }
// The "optimal" one of third order (5.54)-(5.56): 1/6, 1/6 and 2/3 of the velocities at the start, the end
// and the middle. That at the middle lies on the parabola through v^{n-1}, v^n and v^{n+1}; without a step
// before v is linear.
inline PathWeights rk3_path(const PathStep& s) {
  const double at_half = s.last > 0 ? s.dt / (s.last + s.dt) : 0, most = 2.0 / 3;
  const double before = s.last > 0 ? -0.25 * s.dt / s.last * at_half : 0;
  const double start = s.last > 0 ? 0.5 + 0.25 * s.dt / s.last : 0.5, end = 1 - before - start;
  return {most * before, 1.0 / 6 + most * start, 1.0 / 6 + most * end, 0.5, 0.5};
}

// name: a scene's word for it. The first is the default.
struct ParticlePath {
  const char* name = "theta";
  PathWeights (*weights)(const PathStep&) = theta_path;
  bool remembers = false;  // v^{n-1}
};

inline std::vector<ParticlePath> particle_paths() {
  return {
      {}, {"euler", euler_path}, {"rk2", rk2_path}, {"rk3", rk3_path, true}, {"leap-frog", leap_frog_path}};
}

}  // namespace freshet::sisph
