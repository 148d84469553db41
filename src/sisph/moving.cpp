// Formulation L: a step of particles that move with the water, and how long it may be.
#include <algorithm>
#include <cmath>

#include "src/errors.hpp"
#include "src/sisph/solver.hpp"

namespace freshet::sisph {

// Formulation L: the masses are there; the geometry at rest is of no more use.
template <int D>
void Solver<D>::start_moving() {
  const auto depth = on_host(particles_.real("depth"));
  int dry = 0;
  for (int i = 0; i < particles_.size(); ++i) dry += depth(i) > 0 ? 0 : 1;
  if (dry > 0)
    throw SceneError(scene_.file + ": error: sisph.formulation = \"moving\" needs water everywhere, and " + std::to_string(dry) +
                     " particles are dry (those beside the domain counted)\n  help: sisph.formulation = \"at-rest\"");
  const Sisph& sisph = scene_.sisph;
  const double h = on_host(particles_.real("h"))(0);
  moving_.emplace(particles_.size(), kernel_, mirror_walls(),
                  MovingOptions{scene_.gravity, sisph.theta, sisph.picard, scene_.water.spacing, h, support_,
                                lattice_moment<D>(kernel_, h, scene_.water.spacing),
                                sisph.correction == Sisph::Correction::krongauz_belytschko, sisph.cg.tolerance, sisph.cg.most});
  geometry_ = Geometry<D>{};
  if (sisph.paths == Sisph::Paths::rk3)
    for (const char* name : {"u_before", "v_before"})
      if (D == 2 || name[0] == 'u') particles_.real(name, "m/s", Carry::state);
  moving_->measure_jump(swarm());
}

template <int D>
PathWeights Solver<D>::path(double dt) const {
  switch (scene_.sisph.paths) {
    case Sisph::Paths::euler: return euler_path();
    case Sisph::Paths::rk2: return rk2_path();
    case Sisph::Paths::rk3: return rk3_path(dt, last_dt_);
    case Sisph::Paths::leap_frog: return leap_frog_path();
    case Sisph::Paths::theta: break;
  }
  return theta_path(scene_.sisph.theta);
}

template <int D>
void Solver<D>::move_with_water(double dt) {
  const MovingReport r = moving_->step(swarm(), bed_ ? &*bed_ : nullptr, path(dt), dt);
  last_dt_ = dt;
  report_.passes += scene_.sisph.picard;
  report_.solves += r.solves;
  report_.iterations += r.iterations;
  report_.unsettled += r.unsettled;
  report_.newton_max = 1;
  if (!(r.least_depth > 0))
    throw Diverged("a particle fell dry, and particles that move need water everywhere\n"
                   "  help: sisph.formulation = \"at-rest\", or a shorter step (sisph.jump, time.dt)");
  settle_order();
  measure_speeds();
}

// The order of the places that the particles are in now.
template <int D>
void Solver<D>::settle_order() {
  order_.sort(particles_);
  order_.measure_reach(particles_, particles_.real("h"), support_);
  if (bed_) level_of_bed_ = particles_.real("bed");
}

// Velocity differences may move neighbours by sisph.jump of a spacing: more opens gaps.
template <int D>
double Solver<D>::moving_dt() const {
  constexpr double rounding = 1 + 1e-9;  // a whole number of steps must not become one more
  const double dx = scene_.water.spacing;
  const double wanted = scene_.time_step > 0 ? rounding * scene_.time_step : scene_.sisph.courant * dx / std::max(celerity_, 1e-300);
  return std::min(wanted, scene_.sisph.jump * dx / std::max(moving_->jump(), 1e-300));
}

template class Solver<1>;
template class Solver<2>;

}  // namespace freshet::sisph
