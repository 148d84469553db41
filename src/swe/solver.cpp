#include "src/swe/solver.hpp"

#include "kernels/swe/lattice.hpp"
#include "src/errors.hpp"

namespace freshet::swe {
namespace {

AnyStabilisation make_stabilisation(const Sph& sph) {
  switch (sph.stabilisation) {
    case Stabilisation::none: return NoStabilisation{};
    case Stabilisation::lax_friedrichs: return LaxFriedrichs{sph.strength};
    case Stabilisation::lax_friedrichs_muscl: return LaxFriedrichsMuscl{sph.strength};
  }
  return NoStabilisation{};
}

bool needs_gradient(const AnyStabilisation& stabilise) {
  return std::visit([](const auto& s) { return s.gradient; }, stabilise);
}

}  // namespace

template <int D>
Solver<D>::Solver(const Scene& scene)
    : scene_(scene), order_(D, scene.water.spacing), stabilise_(make_stabilisation(scene.sph)),
      gradient_(needs_gradient(stabilise_)), imposed_alpha_(lattice_sums<D>(scene.sph.eta).alpha) {
  build_bed();
  build_friction();
  build_boundaries();
  build_walls();
  place_particles();
  for (auto& boundary : boundaries_) boundary.fill(particles_, [this] { return bind(); }, bed(), next_id_);
  find_neighbours();
  evaluate(0, 0);
  for (auto& boundary : boundaries_) {
    boundary.observe(order_.rows(), bind(), kind(), bed());
    boundary.start(bind(), kind(), particles_.size());
  }
}

template <int D>
void Solver<D>::step(double t, double dt) {
  kick_and_drift<D>(bind(), motion(), particles_.size(), dt);
  if (walls_) walls_->reflect(clusters_, bind().x, bind().v, bind().v_pred);
  for (auto& boundary : boundaries_) boundary.exchange(particles_, [this] { return bind(); }, bed(), t + dt, dt, next_id_);
  find_neighbours();
  evaluate(0.5 * dt, 0.5);
  for (auto& boundary : boundaries_) boundary.observe(order_.rows(), bind(), kind(), bed());
}

// Density, force and acceleration at the particles' positions, then the second half kick.
template <int D>
void Solver<D>::evaluate(double kick_dt, double ahead) {
  close_density(ahead);
  internal_force<D>(clusters_, neighbours_.view(), wall_view(), bind(), stabilise_);
  crossing_time_ = accelerate_and_kick<D>(bind(), motion(), particles_.size(), kick_dt);
}

template <int D>
void Solver<D>::find_neighbours() {
  order_.sort(particles_);
  clusters_.cut(order_.rows());
  list_neighbours();
}

template <int D>
void Solver<D>::list_neighbours() {
  const Particles<D> p = bind();
  order_.measure_reach(particles_, p.h, Kernel<D>::support * (1 + list_margin));
  neighbours_.build<D>(clusters_, {p.x, p.h, order_.rows(), p.x, p.h, Kernel<D>::support, list_margin});
  if (walls_) walls_->find(clusters_, p.x, p.h, list_margin);
}

// Density; where an h outgrew the list's margin, the list is made again with the h found.
template <int D>
void Solver<D>::close_density(double ahead) {
  constexpr int most_lists = 20;  // each may grow h by the margin at most before it is made again
  const DensityOptions options{scene_.gravity, scene_.sph.newton_tolerance, list_margin,
                               {scene_.sph.h_floor, scene_.sph.h_cap}, gradient_, imposed_alpha_, ahead};
  for (int lists = 0; lists < most_lists; ++lists) {
    const DensityReport r = solve_density<D>(clusters_, neighbours_.view(), wall_view(), bind(), {kind()}, options);
    report_.newton_mean = r.newton_mean;
    report_.newton_max = r.newton_max;
    report_.capped = r.capped;
    report_.floored = r.floored;
    if (r.outgrown == 0) return;
    ++report_.rebuilds;
    list_neighbours();
  }
  throw Diverged("the density did not settle: some smoothing length still outgrows its neighbour list after " +
                 std::to_string(most_lists) + " lists; limit: growth by " + std::to_string(list_margin) +
                 " per list\n  help: a smaller time.cfl, or look at the start for particles on top of each other");
}

template <int D>
double Solver<D>::stable_dt() const {
  return scene_.cfl * crossing_time_;
}

template <int D>
MotionOptions<D> Solver<D>::motion() const {
  return {scene_.gravity, {scene_.sph.h_floor, scene_.sph.h_cap}, bed(), friction_,
          friction_ ? particles_.real("drag") : Field<double>(), {kind()}};
}

template class Solver<1>;
template class Solver<2>;

}  // namespace freshet::swe
