#include "src/sisph/solver.hpp"

#include <algorithm>
#include <cmath>

#include "src/errors.hpp"

namespace freshet::sisph {

template <int D>
Solver<D>::Solver(const Scene& scene)
    : scene_(scene), kernel_(make_kernel<D>(scene.sisph.kernel, scene.sisph.smoothing, false)),
      support_(std::visit([](const auto& k) { return k.support; }, kernel_)), order_(D, scene.water.spacing) {
  place_particles();
  build_geometry();
  build_momentum();
  measure_speeds();
}

template <int D>
void Solver<D>::step(double, double dt) {
  active_->find(water().depth, scene_.sisph.picard);
  if (paths_)
    carry_along_paths(dt);
  else
    carry_by_fluxes(dt);
  measure_speeds();
}

// Section 3 of the formulas: fully wet.
template <int D>
void Solver<D>::carry_along_paths(double dt) {
  if (active_->drying())
    throw Diverged("a particle fell dry, and velocities carried along particle paths need water everywhere\n"
                   "  help: sisph.momentum = \"mass-flux\"");
  const double g = scene_.gravity, theta = scene_.sisph.theta;
  const Water<D> now = water();
  surface_gradient(geometry_, active_->list(), now.depth, now.bed, slope_, false);
  push(now.v, (1 - theta) * g * dt, explicit_);
  paths_->fit(now.v, explicit_);
  surface_->start(now);
  push(now.v, 0, end_);
  for (int pass = 0; pass < scene_.sisph.picard; ++pass) {
    paths_->trace(now.v, explicit_, end_, dt, carried_);
    blend();
    solve_surface(dt, false);
    surface_gradient(geometry_, active_->list(), surface_->depth(), now.bed, slope_, false);
    push(carried_, theta * g * dt, end_);
  }
  accept(dt, false);
}

// Wet and dry alike. The explicit pressure acts on what the fluxes carried in.
template <int D>
void Solver<D>::carry_by_fluxes(double dt) {
  const double g = scene_.gravity, theta = scene_.sisph.theta;
  const bool drying = active_->drying();
  const Water<D> now = water();
  surface_gradient(geometry_, active_->list(), now.depth, now.bed, slope_, drying);
  velocity_gradient(geometry_, active_->list(), now, velocity_gradient_);
  surface_->start(now);
  push(now.v, 0, carried_);
  for (int pass = 0; pass < scene_.sisph.picard; ++pass) {
    push(carried_, (1 - theta) * g * dt, carried_);
    blend();
    solve_surface(dt, drying);
    fluxes_->close_depths(active_->list(), now, *surface_, dt);
    fluxes_->advect(active_->list(), now, *surface_, velocity_gradient_, dt, carried_);
  }
  push(carried_, (1 - theta) * g * dt, carried_);
  surface_gradient(geometry_, active_->list(), surface_->depth(), now.bed, slope_, drying);
  push(carried_, theta * g * dt, end_);
  accept(dt, true);
}

// to = from - impulse grad eta; held particles keep what they have, since their slope is zero.
template <int D>
void Solver<D>::push(const VecField<double, D>& from, double impulse, const VecField<double, D>& to) {
  const VecField<double, D> a = from, slope = slope_, b = to;
  Kokkos::parallel_for("sisph::push", Range(0, particles_.size()),
                       KOKKOS_LAMBDA(int i) { put(b, i, at(a, i) - impulse * at(slope, i)); });
}

// The velocity of the fluxes before the pressure at n+1: theta of what was carried, the rest of what there was.
template <int D>
void Solver<D>::blend() {
  const double theta = scene_.sisph.theta;
  const VecField<double, D> carried = carried_, v = water().v, before = before_;
  Kokkos::parallel_for("sisph::blend", Range(0, particles_.size()), KOKKOS_LAMBDA(int i) {
        put(before, i, theta * at(carried, i) + (1 - theta) * at(v, i));
      });
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

// The state at n+1: velocities stop where no water is left.
template <int D>
void Solver<D>::accept(double dt, bool closed) {
  const RimFlow rim = rim_->flow(*surface_, dt, closed);
  passed_.inflow += rim.in;
  passed_.outflow += rim.out;
  const Water<D> now = water();
  const VecField<double, D> v = now.v, end = end_;
  const Field<double> depth = now.depth, found = surface_->depth(), mass = particles_.real("mass"), omega = geometry_.omega;
  Kokkos::parallel_for("sisph::accept", Range(0, particles_.size()), KOKKOS_LAMBDA(int i) {
        depth(i) = found(i);
        mass(i) = omega(i) * found(i);
        put(v, i, (found(i) > 0 ? 1.0 : 0.0) * at(end, i));
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
