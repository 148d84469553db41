#include "src/methods/sisph/at_rest.hpp"

#include <algorithm>

#include "cellgrid/parallel/assign.hpp"
#include "cellgrid/parallel/launch.hpp"
#include "src/errors.hpp"

namespace freshet::sisph {
namespace {

template <int D>
VecField<double, D> scratch(const std::string& label, int n) {
  const auto field = [&] { return Field<double>(label, static_cast<std::size_t>(n) + lanes); };
  if constexpr (D == 1) return {field()};
  else return {field(), field()};
}

SurfaceOptions surface_options(const Scene& scene) {
  const Sisph& s = scene.sisph;
  return {scene.gravity, s.theta, s.cg.tolerance, s.newton.tolerance, s.cg.most, s.newton.most};
}

}  // namespace

template <int D>
EulerianSph<D>::EulerianSph(const Scene& scene)
    : Base(scene), geometry_(Base::measure()),
      closure_(scene.sisph.closure ? close_areas(geometry_) : ClosureReport{}),
      surface_(geometry_, order_.rows(), surface_options(scene), pair_source()), active_(geometry_),
      rim_(geometry_) {
  closure_.lambda = {};
  build_momentum();
  build_friction();
  build_openings();
  Base::measure_speeds();
}

template <int D>
std::optional<PairSource<D>> EulerianSph<D>::pair_source() const {
  if (!scene_.sisph.recomputed) return {};
  const auto first = on_host(Kokkos::subview(particles_.real("h"), std::make_pair(0, 1)));
  return PairSource<D>{kernel_, first(0), closure_.lambda};
}

template <int D>
void EulerianSph<D>::build_momentum() {
  const Sisph& sisph = scene_.sisph;
  const int slots = geometry_.images.slots();
  active_.find(particles_.real("depth"), sisph.picard);
  for (VecField<double, D>* v : {&slope_, &explicit_, &carried_, &before_, &end_})
    *v = scratch<D>("sisph.velocity", slots);
  push(water().v, 0, carried_);  // for good where all of a slice is held
  conservative_ = sisph.momentum.conservative;
  const bool by_fluxes = sisph.momentum.by_fluxes(active_.drying());
  // Antisymmetric pressure on a film's mass knows no bound.
  if ((conservative_ || !by_fluxes) && active_.drying())
    throw SceneError("sisph.momentum = \"" + std::string(sisph.momentum.name) +
                     "\" needs water everywhere, and " + std::to_string(active_.dry()) +
                     " particles are dry\n  help: use \"mass-flux\"");
  if (by_fluxes) {
    fluxes_.emplace(geometry_);
    velocity_gradient_.u = scratch<D>("sisph.grad_u", slots);
    if (D == 2) velocity_gradient_.v = scratch<D>("sisph.grad_v", slots);
  } else {
    paths_.emplace(geometry_, order_.rows(), scene_.water.spacing,
                   support_ * sisph.smoothing * scene_.water.spacing);
  }
}

// Viscosity; g n^2 at each particle, and a place for dt gamma.
template <int D>
void EulerianSph<D>::build_friction() {
  const Sisph& sisph = scene_.sisph;
  if (sisph.viscosity > 0)
    viscosity_.emplace(geometry_,
                       ViscosityOptions{sisph.viscosity, sisph.slip, sisph.cg.tolerance, sisph.cg.most});
  if (!scene_.manning) return;
  const Manning& manning = *scene_.manning;
  g_n2_ = Field<double>("sisph.g_n2", static_cast<std::size_t>(particles_.size()) + lanes);
  const std::vector<Point> places = Base::places();
  upload(g_n2_, places.size(), [&](std::size_t i) {
    const double n = manning.map ? manning.map(places[i][0], places[i][1]) : manning.n;
    return scene_.gravity * n * n;
  });
  drag_ = surface_.make_drag();
}

template <int D>
void EulerianSph<D>::step(double t, double dt) {
  active_.find(water().depth, scene_.sisph.picard);
  if (paths_) carry_along_paths(t, dt);
  else carry_by_fluxes(t, dt);
  Base::measure_speeds();
}

template <int D>
void EulerianSph<D>::require_water(const std::string& who_needs) const {
  if (active_.drying())
    throw Diverged("a particle fell dry, and " + who_needs +
                   " water everywhere\n  help: sisph.momentum = \"mass-flux\"");
}

// docs/formulas/sisph.md (I18), (I19): fully wet.
template <int D>
void EulerianSph<D>::carry_along_paths(double t, double dt) {
  require_water("velocities carried along particle paths need");
  const double g = scene_.gravity, theta = scene_.sisph.theta;
  const Layer<D> now = water();
  find_slope(now.depth, false);
  surface_.start(now);
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
    find_slope(surface_.depth(), false);
    push(carried_, theta * g * dt, end_);
    slow_down(end_);
  }
  accept(dt, false);
}

// Wet and dry alike. The explicit pressure acts on what the fluxes carried in.
template <int D>
void EulerianSph<D>::carry_by_fluxes(double t, double dt) {
  const double g = scene_.gravity, theta = scene_.sisph.theta;
  const bool drying = active_.drying();
  if (conservative_) require_water("antisymmetric pressure needs");
  const Layer<D> now = water();
  velocity_gradient(geometry_, active_.list(), now, velocity_gradient_);
  surface_.start(now);
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
    fluxes_->close_depths(active_.list(), now, surface_, dt);
    fluxes_->advect(active_.list(), now, surface_, velocity_gradient_, dt, carried_);
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
void EulerianSph<D>::find_slope(const Field<double>& depth, bool drying) {
  surface_gradient(geometry_, active_.list(), depth, level_of_bed_, slope_, drying);
  extend_slope(depth);
}

// What pushes the water that the fluxes carry: the surface's gradient at n (theta = 0) or n+1 (1), or the
// conservative pressure of the level theta per mass of n+1.
template <int D>
void EulerianSph<D>::find_push(double theta, bool drying) {
  const Field<double> now = water().depth, next = surface_.depth();
  if (!conservative_) return find_slope(theta > 0 ? next : now, drying);
  conservative_slope(geometry_, active_.list(), {now, next, theta}, level_of_bed_, slope_);
  extend_slope(theta > 0 ? next : now);
}

// to = from - impulse grad eta; held particles keep what they have, since their slope is zero.
template <int D>
void EulerianSph<D>::push(const VecField<double, D>& from, double impulse, const VecField<double, D>& to) {
  const VecField<double, D> a = from, slope = slope_, b = to;
  launch(
      "sisph::push", Range(0, particles_.size()),
      KOKKOS_LAMBDA(int i) { put(b, i, at(a, i) - impulse * at(slope, i)); });
}

// The velocity of the fluxes before the pressure at n+1: theta of what was carried, the rest of what there
// was; what fell wet within the step had no velocity of its own.
template <int D>
void EulerianSph<D>::blend(double dt) {
  const double theta = scene_.sisph.theta;
  const VecField<double, D> carried = carried_, v = water().v, before = before_;
  const Field<double> drag = drag_, depth = water().depth, last = surface_.depth();
  const bool dragged = drag.extent(0) > 0;
  launch(
      "sisph::blend", Range(0, particles_.size()), KOKKOS_LAMBDA(int i) {
        const double share = dragged ? theta / (1 + drag(i)) : theta,
                     own = wetness(depth(i), larger(last(i), 0.0));
        const Vec<double, D> arrived = at(carried, i);
        put(before, i, share * arrived + (1 - theta) * (arrived + own * (at(v, i) - arrived)));
      });
  if (open_) open_->set_before({v, slope_, theta, theta * scene_.gravity * dt, drag_}, before_);
}

// Friction, implicit.
template <int D>
void EulerianSph<D>::slow_down(const VecField<double, D>& v) {
  const Field<double> drag = drag_;
  const VecField<double, D> slowed = v;
  if (drag.extent(0) == 0) return;
  launch(
      "sisph::slow_down", Range(0, particles_.size()),
      KOKKOS_LAMBDA(int i) { put(slowed, i, (1 / (1 + drag(i))) * at(slowed, i)); });
}

// What viscosity changes the velocities by: from where the pressure and the friction of the step's start
// alone would take them.
template <int D>
void EulerianSph<D>::find_viscous(double dt) {
  if (!viscosity_) return;
  push(water().v, scene_.gravity * dt, end_);
  slow_down(end_);
  report_.iterations += viscosity_->find(water(), drag_, end_, dt);
}

template <int D>
void EulerianSph<D>::add_viscous(const VecField<double, D>& v) {
  if (viscosity_) viscosity_->add(drag_, v);
}

template <int D>
void EulerianSph<D>::solve_surface(double dt, bool drying) {
  const SurfaceReport r = surface_.solve(active_.list(), water(), before_, dt, drying);
  ++report_.passes;
  report_.newton_max = std::max(report_.newton_max, r.newton);
  report_.solves += r.newton;
  report_.iterations += r.iterations;
  report_.unsettled += r.converged ? 0 : 1;
}

// The state at n+1: velocities stop where no water is left. Films run off without end: what no sum over the
// water could tell is none.
template <int D>
void EulerianSph<D>::accept(double dt, bool closed) {
  constexpr double rounding = 1e-18;  // of the deepest
  if (open_) open_->set_end(end_), open_->account(dt);
  const RimFlow rim = rim_.flow(surface_, dt, closed);
  passed_.inflow += rim.in;
  passed_.outflow += rim.out;
  const Layer<D> now = water();
  const VecField<double, D> v = now.v, end = end_;
  const Field<double> depth = now.depth, found = surface_.depth(), omega = geometry_.omega;
  const Field<double> mass = particles_.real("mass");
  const double dust = rounding * celerity_ * celerity_ / scene_.gravity;
  launch(
      "sisph::accept", Range(0, particles_.size()), KOKKOS_LAMBDA(int i) {
        const bool wet = found(i) > dust;
        depth(i) = wet ? found(i) : 0.0;
        mass(i) = omega(i) * depth(i);
        put(v, i, (wet ? 1.0 : 0.0) * at(end, i));
      });
}

template <int D>
double EulerianSph<D>::stable_dt() const {
  constexpr double mass_flux_limit = 0.7;  // |v| dt / dx
  const double wanted = scene_.sisph.advection, limit = wanted > 0 ? wanted
                                                        : fluxes_  ? mass_flux_limit
                                                                   : 1e300;
  return std::min(Base::longest_step(), limit * scene_.water.spacing / std::max(speed_, 1e-300));
}

template class EulerianSph<1>;
template class EulerianSph<2>;

}  // namespace freshet::sisph
