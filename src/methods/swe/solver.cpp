#include "src/methods/swe/solver.hpp"

#include <algorithm>

#include "kernels/swe/density/depth_gradient.hpp"
#include "kernels/swe/density/lattice.hpp"
#include "kernels/swe/force/well_balanced.hpp"
#include "kernels/swe/single_precision.hpp"
#include "src/errors.hpp"

namespace freshet::swe {
namespace {

// Those whose pair body needs the scene's gravity hold it.
template <class S>
auto set_gravity(S& stabilise, double gravity, int) -> decltype(void(stabilise.gravity = gravity)) {
  stabilise.gravity = gravity;
}
template <class S>
void set_gravity(S&, double, long) {}

AnyStabilisation under(double gravity, AnyStabilisation stabilise) {
  std::visit([&](auto& s) { set_gravity(s, gravity, 0); }, stabilise);
  return stabilise;
}

bool needs_velocity_gradient(const AnyStabilisation& stabilise) {
  return std::visit([](const auto& s) { return s.velocity_gradient; }, stabilise);
}
bool needs_depth_gradient(const AnyStabilisation& stabilise) {
  return std::visit([](const auto& s) { return s.depth_gradient; }, stabilise);
}

// Where h is held at h0 lists need no margin; particles at open boundaries have an h of their own.
double margin_of(const Scene& scene) {
  const bool fixed_h = scene.sph.h_floor == scene.sph.h_cap && scene.boundaries.empty();
  return fixed_h ? 0.0 : 0.05;
}

}  // namespace

template <int D>
ExplicitSph<D>::ExplicitSph(const Scene& scene, const std::vector<Placed>& start)
    : Base(scene, make_kernel<D>(scene.sph.kernel, scene.sph.eta, scene.sph.lattice_correction)),
      margin_(margin_of(scene)), stabilise_(under(scene.gravity, scene.sph.stabilisation)),
      gradient_(needs_velocity_gradient(stabilise_)), depth_gradient_(needs_depth_gradient(stabilise_)),
      imposed_alpha_(lattice_sums<D>(scene.sph.eta, kernel_).alpha) {
  build_ground();
  build_boundaries();
  build_walls();
  build_refinement();
  place_particles(start);
  fill_boundaries();
  find_neighbours();
  if (scene_.sph.well_balanced)
    calibrate_density<D>(kernel_, clusters_, neighbours_.view(), wall_view(), bind(),
                         particles_.real("calibration"));
  evaluate(0, 0);
  for (auto& boundary : boundaries_) {
    boundary.observe(order_.rows(), bind(), kind(), bed_term());
    boundary.start(bind(), kind(), particles_.size());
  }
}

template <int D>
void ExplicitSph<D>::step(double t, double dt) {
  kick_and_drift<D>(bind(), motion(), particles_.size(), dt);
  if (walls_) walls_->reflect(clusters_, bind().x, bind().v, bind().v_pred);
  for (auto& boundary : boundaries_)
    boundary.exchange(
        particles_, [this] { return bind(); }, bed_term(), t + dt, dt, next_id_);
  if (refinement_) refine();
  find_neighbours();
  if (refinement_) refinement_->relax(clusters_, neighbours_.view(), bind(), kind(), dt);
  evaluate(0.5 * dt, 0.5);
  for (auto& boundary : boundaries_) boundary.observe(order_.rows(), bind(), kind(), bed_term());
}

// Density, force and acceleration at the particles' positions, then the second half kick.
template <int D>
void ExplicitSph<D>::evaluate(double kick_dt, double ahead) {
  make_room();
  if (scene_.sph.mixed) copy_motion<D>(bind(), particles_.size());
  close_density(ahead);
  if (depth_gradient_) find_depth_gradient<D>(kernel_, clusters_, neighbours_.view(), bind());
  if (scene_.sph.mixed) copy_state<D>(bind(), particles_.size());
  internal_force<D>(kernel_, clusters_, neighbours_.view(), wall_view(), bind(), stabilise_);
  if (scene_.sph.well_balanced && bed_)
    add_balanced_bed<D>(kernel_, clusters_, neighbours_.view(), wall_view(), bind(), *bed_term(),
                        scene_.gravity);
  crossing_time_ = accelerate_and_kick<D>(bind(), motion(), particles_.size(), kick_dt);
}

template <int D>
void ExplicitSph<D>::find_neighbours() {
  order_.sort(particles_);
  clusters_.cut(order_.rows());
  list_neighbours();
}

template <int D>
void ExplicitSph<D>::list_neighbours() {
  const Particles<D> p = bind();
  order_.measure_reach(particles_, p.h, support_ * (1 + margin_));
  const ListRequest<D> water{p.x, p.h, order_.rows(), p.x, p.h, support_, margin_};
  neighbours_.build<D>(clusters_, water);
  if (walls_) walls_->find(clusters_, water, neighbours_.view());
}

// Density; where an h outgrew the list's margin, the list is made again with the h found.
template <int D>
void ExplicitSph<D>::close_density(double ahead) {
  constexpr int most_lists = 20;  // each may grow h by the margin at most before it is made again
  DensityOptions options{
      scene_.gravity, scene_.sph.newton_tolerance,
      margin_,        {scene_.sph.h_floor, scene_.sph.h_cap},
      gradient_,      imposed_alpha_,
      ahead,          scene_.sph.well_balanced ? particles_.real("calibration") : Field<double>()};
  for (int lists = 0; lists < most_lists; ++lists) {
    const DensityReport r =
        solve_density<D>(kernel_, clusters_, neighbours_.view(), wall_view(), bind(), {kind()}, options);
    report_.newton_mean = r.newton_mean;
    report_.newton_max = r.newton_max;
    report_.capped = r.capped;
    report_.floored = r.floored;
    if (r.outgrown == 0) return;
    ++report_.rebuilds;
    options.ahead = 0;  // the rate of the step before is overwritten, perhaps by that of a particle without
                        // its neighbours
    list_neighbours();
  }
  throw Diverged(
      "the density did not settle: some smoothing length still outgrows its neighbour list after " +
      std::to_string(most_lists) + " lists; limit: growth by " + std::to_string(margin_) +
      " per list\n  help: a smaller time.cfl, or look at the start for particles on top of each other");
}

template <int D>
double ExplicitSph<D>::stable_dt() const {
  double crossing = crossing_time_;
  for (const auto& boundary : boundaries_) crossing = std::min(crossing, boundary.crossing_time());
  return scene_.cfl * crossing;
}

template <int D>
MotionOptions<D> ExplicitSph<D>::motion() const {
  // In a well-balanced run t holds the bed's part already.
  return {scene_.gravity,
          {scene_.sph.h_floor, scene_.sph.h_cap},
          scene_.sph.well_balanced ? std::nullopt : bed_term(),
          friction_,
          friction_ ? particles_.real("drag") : Field<double>(),
          {kind()},
          walls_.has_value()};
}

template class ExplicitSph<1>;
template class ExplicitSph<2>;

}  // namespace freshet::swe
