#include "src/sisph/solver.hpp"

#include <algorithm>
#include <cmath>

#include "cellgrid/launch.hpp"
#include "src/errors.hpp"
#include "src/scene/place.hpp"

namespace freshet::sisph {

template <int D>
Solver<D>::Solver(const Scene& scene)
    : scene_(scene), kernel_(make_kernel<D>(scene.sisph.kernel, scene.sisph.smoothing, false)),
      support_(std::visit([](const auto& k) { return k.support; }, kernel_)),
      order_(D, scene.water.spacing, sorted_box(scene)) {
  place_particles();
  build_geometry();
  if (scene_.sisph.moving) {
    start_moving();
  } else {
    build_momentum();
    build_friction();
    build_openings();
  }
  measure_speeds();
}

template <int D>
Solver<D>::~Solver() = default;

template <int D>
void Solver<D>::step(double t, double dt) {
  if (moving_) return move_with_water(t, dt);
  active_->find(water().depth, scene_.sisph.picard);
  if (paths_)
    carry_along_paths(t, dt);
  else
    carry_by_fluxes(t, dt);
  measure_speeds();
}

template <int D>
void Solver<D>::require_water(const std::string& who_needs) const {
  if (active_->drying())
    throw Diverged("a particle fell dry, and " + who_needs + " water everywhere\n  help: sisph.momentum = \"mass-flux\"");
}

// docs/formulas/sisph.md (I18), (I19): fully wet.
template <int D>
void Solver<D>::carry_along_paths(double t, double dt) {
  require_water("velocities carried along particle paths need");
  const double g = scene_.gravity, theta = scene_.sisph.theta;
  const Water<D> now = water();
  find_slope(now.depth, false);
  surface_->start(now);
  meet_boundaries(t, dt);
  find_viscous(dt);
  push(now.v, (1 - theta) * g * dt, explicit_);
  add_viscous(explicit_);
  paths_->fit(now.v, explicit_, scene_.sisph.slip);
  push(now.v, 0, end_);
  for (int pass = 0; pass < scene_.sisph.picard; ++pass) {
    paths_->trace(now.v, explicit_, end_, dt, carried_);
    blend(dt);
    solve_surface(dt, false);
    find_slope(surface_->depth(), false);
    push(carried_, theta * g * dt, end_);
    slow_down(end_);
  }
  accept(dt, false);
}

// Wet and dry alike. The explicit pressure acts on what the fluxes carried in.
template <int D>
void Solver<D>::carry_by_fluxes(double t, double dt) {
  const double g = scene_.gravity, theta = scene_.sisph.theta;
  const bool drying = active_->drying();
  if (conservative_) require_water("antisymmetric pressure needs");
  const Water<D> now = water();
  velocity_gradient(geometry_, active_->list(), now, velocity_gradient_);
  surface_->start(now);
  find_push(0, drying);
  meet_boundaries(t, dt);
  find_viscous(dt);
  push(now.v, 0, carried_);
  for (int pass = 0; pass < scene_.sisph.picard; ++pass) {
    if (conservative_ && pass > 0) find_push(0, drying);  // per mass of the pass before
    push(carried_, (1 - theta) * g * dt, carried_);
    add_viscous(carried_);
    blend(dt);
    solve_surface(dt, drying);
    fluxes_->close_depths(active_->list(), now, *surface_, dt);
    fluxes_->advect(active_->list(), now, *surface_, velocity_gradient_, dt, carried_);
  }
  if (!conservative_) push(carried_, (1 - theta) * g * dt, carried_);
  add_viscous(carried_);
  find_push(conservative_ ? theta : 1, drying);
  push(carried_, (conservative_ ? 1 : theta) * g * dt, end_);
  slow_down(end_);
  accept(dt, true);
}

// grad eta of free particles; and of those behind open boundaries; else zero.
template <int D>
void Solver<D>::find_slope(const Field<double>& depth, bool drying) {
  surface_gradient(geometry_, active_->list(), depth, level_of_bed_, slope_, drying);
  extend_slope(depth);
}

template <int D>
void Solver<D>::extend_slope(const Field<double>& depth) {
  if (!open_) return;
  TracedWater<D> traced_now = traced();
  traced_now.water.depth = depth;
  open_->extend(traced_now, slope_);
}

// What pushes the water that the fluxes carry: the surface's gradient at n (theta = 0) or n+1 (1), or the conservative pressure of the
// level theta per mass of n+1.
template <int D>
void Solver<D>::find_push(double theta, bool drying) {
  const Field<double> now = water().depth, next = surface_->depth();
  if (!conservative_) return find_slope(theta > 0 ? next : now, drying);
  conservative_slope(geometry_, active_->list(), {now, next, theta}, level_of_bed_, slope_);
  extend_slope(theta > 0 ? next : now);
}

// to = from - impulse grad eta; held particles keep what they have, since their slope is zero.
template <int D>
void Solver<D>::push(const VecField<double, D>& from, double impulse, const VecField<double, D>& to) {
  const VecField<double, D> a = from, slope = slope_, b = to;
  launch("sisph::push", Range(0, particles_.size()),
         KOKKOS_LAMBDA(int i) { put(b, i, at(a, i) - impulse * at(slope, i)); });
}

// The velocity of the fluxes before the pressure at n+1: theta of what was carried, the rest of what there was; what fell wet within the
// step had no velocity of its own.
template <int D>
void Solver<D>::blend(double dt) {
  const double theta = scene_.sisph.theta;
  const VecField<double, D> carried = carried_, v = water().v, before = before_;
  const Field<double> drag = drag_, depth = water().depth, last = surface_->depth();
  const bool dragged = drag.extent(0) > 0;
  launch("sisph::blend", Range(0, particles_.size()), KOKKOS_LAMBDA(int i) {
        const double share = dragged ? theta / (1 + drag(i)) : theta, own = wetness(depth(i), larger(last(i), 0.0));
        const Vec<double, D> arrived = at(carried, i);
        put(before, i, share * arrived + (1 - theta) * (arrived + own * (at(v, i) - arrived)));
      });
  if (open_) open_->set_before({v, slope_, theta, theta * scene_.gravity * dt, drag_}, before_);
}

// Friction, implicit.
template <int D>
void Solver<D>::slow_down(const VecField<double, D>& v) {
  const Field<double> drag = drag_;
  const VecField<double, D> slowed = v;
  if (drag.extent(0) == 0) return;
  launch("sisph::slow_down", Range(0, particles_.size()),
         KOKKOS_LAMBDA(int i) { put(slowed, i, (1 / (1 + drag(i))) * at(slowed, i)); });
}

// What viscosity changes the velocities by: from where the pressure and the friction of the step's start alone would take them.
template <int D>
void Solver<D>::find_viscous(double dt) {
  if (!viscosity_) return;
  push(water().v, scene_.gravity * dt, end_);
  slow_down(end_);
  report_.iterations += viscosity_->find(water(), drag_, end_, dt);
}

template <int D>
void Solver<D>::add_viscous(const VecField<double, D>& v) {
  if (viscosity_) viscosity_->add(drag_, v);
}

// The friction of the water at t, and the rim's state at t + dt.
template <int D>
void Solver<D>::meet_boundaries(double t, double dt) {
  const Water<D> now = water();
  if (drag_.extent(0) > 0) find_drag<D>(particles_.size(), now, g_n2_, dt, drag_);
  if (!open_) return;
  open_->find(traced(), t, dt);
  open_->impose(now.bed, surface_->level(), surface_->depth());
}

template <int D>
void Solver<D>::solve_surface(double dt, bool drying) {
  const SurfaceReport r = surface_->solve(active_->list(), water(), before_, dt, drying);
  ++report_.passes;
  report_.newton_max = std::max(report_.newton_max, r.newton);
  report_.solves += r.newton;
  report_.iterations += r.iterations;
  report_.unsettled += r.converged ? 0 : 1;
}

// The state at n+1: velocities stop where no water is left. Films run off without end: what no sum over the water could tell is none.
template <int D>
void Solver<D>::accept(double dt, bool closed) {
  constexpr double rounding = 1e-18;  // of the deepest
  if (open_) open_->set_end(end_);
  const RimFlow rim = rim_->flow(*surface_, dt, closed);
  passed_.inflow += rim.in;
  passed_.outflow += rim.out;
  const Water<D> now = water();
  const VecField<double, D> v = now.v, end = end_;
  const Field<double> depth = now.depth, found = surface_->depth(), mass = particles_.real("mass"), omega = geometry_.omega;
  const double dust = rounding * celerity_ * celerity_ / scene_.gravity;
  launch("sisph::accept", Range(0, particles_.size()), KOKKOS_LAMBDA(int i) {
        const bool wet = found(i) > dust;
        depth(i) = wet ? found(i) : 0.0;
        mass(i) = omega(i) * depth(i);
        put(v, i, (wet ? 1.0 : 0.0) * at(end, i));
      });
}

// What bounds the next step; thin films may run fast without harm.
template <int D>
void Solver<D>::measure_speeds() {
  constexpr double thin = 0.01;  // of the deepest
  const Water<D> now = water();
  double deepest = 0, fastest2 = 0;
  Kokkos::parallel_reduce("sisph::deepest", Range(0, particles_.size()),
      KOKKOS_LAMBDA(int i, double& m) { m = larger(m, now.depth(i)); }, Kokkos::Max<double>(deepest));
  const double least = thin * deepest;
  Kokkos::parallel_reduce("sisph::fastest", Range(0, particles_.size()), KOKKOS_LAMBDA(int i, double& m) {
        const Vec<double, D> v = at(now.v, i);
        if (now.depth(i) > least) m = larger(m, dot(v, v));
      }, Kokkos::Max<double>(fastest2));
  celerity_ = std::sqrt(scene_.gravity * deepest);
  speed_ = std::sqrt(fastest2);
}

template <int D>
double Solver<D>::stable_dt() const {
  if (moving_) return moving_dt();
  constexpr double mass_flux_limit = 0.7;  // |v| dt / dx
  const Sisph& sisph = scene_.sisph;
  const double dx = scene_.water.spacing, limit = sisph.advection > 0 ? sisph.advection : fluxes_ ? mass_flux_limit : 1e300;
  constexpr double rounding = 1 + 1e-9;  // a whole number of steps must not become one more
  const double wanted = scene_.time_step > 0 ? rounding * scene_.time_step : sisph.courant * dx / std::max(celerity_, 1e-300);
  return std::min(wanted, limit * dx / std::max(speed_, 1e-300));
}

template class Solver<1>;
template class Solver<2>;

}  // namespace freshet::sisph
