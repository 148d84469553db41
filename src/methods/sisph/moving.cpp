#include "src/methods/sisph/moving.hpp"

#include <algorithm>
#include <cmath>

#include "cellgrid/parallel/assign.hpp"
#include "cellgrid/parallel/launch.hpp"
#include "src/errors.hpp"
#include "src/text.hpp"

namespace freshet::sisph {
namespace {

constexpr double unbounded = 1e300;

}  // namespace

template <int D>
LagrangianSph<D>::LagrangianSph(const Scene& scene)
    : Base(scene), moving_(particles_.size(), kernel_, Base::mirror_walls(), options()) {
  Base::measure();  // the masses; the geometry at rest is of no more use
  require_water();
  const Swarm<D> now = swarm();
  const Vec<double, D> low = to_vec<D>(scene_.domain.low), high = to_vec<D>(scene_.domain.high);
  if (held_ > 0)
    moving_.set_followers(Followers<D>(
        particles_.size(), {order_.rows(), now.x, now.id, now.kind, low, high, scene_.water.spacing}));
  lay_friction();
  moving_.measure_jump(swarm());
  Base::measure_speeds();
}

template <int D>
MovingOptions LagrangianSph<D>::options() const {
  const Sisph& sisph = scene_.sisph;
  const double h = on_host(particles_.real("h"))(0), dx = scene_.water.spacing;
  return {scene_.gravity,
          sisph.theta,
          sisph.picard,
          dx,
          h,
          support_,
          lattice_moment<D>(kernel_, h, dx),
          sisph.exact_slopes,
          sisph.cg.tolerance,
          sisph.cg.most};
}

template <int D>
void LagrangianSph<D>::require_water() const {
  const auto depth = on_host(particles_.real("depth"));
  int dry = 0;
  for (int i = 0; i < particles_.size(); ++i) dry += depth(i) > 0 ? 0 : 1;
  if (dry > 0)
    throw SceneError(
        scene_.file + ": error: sisph.formulation = \"moving\" needs water everywhere, and " +
        std::to_string(dry) +
        " particles are dry (those beside the domain counted)\n  help: sisph.formulation = \"at-rest\"");
}

// Friction of the ground that particles move over: by place, or one for all.
template <int D>
void LagrangianSph<D>::lay_friction() {
  if (!scene_.manning) return;
  const Manning& manning = *scene_.manning;
  for (Field<double>* f : {&g_n2_, &drag_})
    *f = Field<double>("sisph.friction", static_cast<std::size_t>(particles_.size()) + lanes);
  ground_ = Base::roughness(scene_.gravity);
  if (!manning.map) assign(g_n2_, scene_.gravity * manning.n * manning.n);
}

template <int D>
void LagrangianSph<D>::find_friction(double dt) {
  if (drag_.extent(0) == 0) return;
  if (ground_.given()) {
    const NearestTable ground = ground_;
    const VecField<double, D> x = swarm().x;
    const Field<double> g_n2 = g_n2_;
    launch(
        "sisph::ground", Range(0, particles_.size()),
        KOKKOS_LAMBDA(int i) { g_n2(i) = ground.at(at(x, i)); });
  }
  find_drag<D>(particles_.size(), Base::water(), g_n2_, dt, drag_);
}

template <int D>
PathWeights LagrangianSph<D>::path(double dt) const {
  return scene_.sisph.path.weights({scene_.sisph.theta, dt, last_dt_});
}

// A step, in as many parts as it takes for each to hold: what does not settle, or moves neighbours much
// further than they should, is tried again with half the step, and steps grow again from there.
template <int D>
void LagrangianSph<D>::step(double t, double dt) {
  constexpr double growth = 1.25, rounding = 1e-9;
  for (double left = dt; left > 0;) {
    const double parts = std::max(1.0, std::ceil(left / allowed_ - rounding)), part = left / parts;
    const MovingReport r = try_to_move(part);
    if (!holds(r, part)) {
      shorten(t + dt - left, part, r);
      continue;
    }
    moving_.arrive(swarm(), Base::bed(), path(part), part);
    last_dt_ = part;
    allowed_ = std::min(growth * allowed_, unbounded);
    left = parts > 1 ? left - part : 0;
    settle_order();
  }
  report_.newton_max = 1;
  Base::measure_speeds();
}

template <int D>
MovingReport LagrangianSph<D>::try_to_move(double dt) {
  find_friction(dt);
  const MovingReport r = moving_.attempt(swarm(), Base::bed(), path(dt), dt);
  report_.passes += r.solves;
  report_.solves += r.solves;
  report_.iterations += r.iterations;
  return r;
}

// Velocities at the end bound the step as well: those at its start do not know what the surface will do.
template <int D>
bool LagrangianSph<D>::holds(const MovingReport& r, double dt) const {
  constexpr double slack = 2;
  return r.holds() && r.jump * dt <= slack * scene_.sisph.jump * scene_.water.spacing;
}

template <int D>
void LagrangianSph<D>::shorten(double t, double dt, const MovingReport& r) {
  constexpr double least = 1.0 / 4096;  // of what was asked for
  allowed_ = 0.5 * dt;
  ++shortened_;
  if (allowed_ >= least * Base::longest_step()) return;
  const std::string last = " of steps shortened to " + brief(dt, 4) + " s (" +
                           brief(Base::longest_step(), 4) + " s were asked for) ";
  const std::string when = "at t = " + brief(t, 4) + " s ";
  if (!r.solved)
    throw Diverged("the free surface did not settle: " + when + "the linear system" + last +
                   "was left with " + brief(r.residual, 4) +
                   " of its right-hand side (sisph.cg.tolerance = " + brief(scene_.sisph.cg.tolerance, 4) +
                   ")\n  help: particles have lost their order or their neighbours: sisph.formulation = "
                   "\"at-rest\", or a wider "
                   "sisph.smoothing, or sisph.cg.max above " +
                   std::to_string(scene_.sisph.cg.most));
  if (!(r.least_depth > 0))
    throw Diverged("a particle fell dry " + when + "with the last" + last +
                   "and particles that move need water everywhere\n  help: sisph.formulation = \"at-rest\"");
  throw Diverged(
      "neighbours part too fast: " + when + "with " + brief(r.jump, 4) + " m/s at the end" + last +
      "\n  help: sisph.formulation = \"at-rest\", a larger sisph.theta, or a wider sisph.smoothing");
}

// The order of the places that the particles are in now.
template <int D>
void LagrangianSph<D>::settle_order() {
  order_.sort(particles_);
  order_.measure_reach(particles_, particles_.real("h"), support_);
  if (bed_) Base::level_of_bed_ = particles_.real("bed");
}

// Velocity differences may move neighbours by sisph.jump of a spacing: more opens gaps.
template <int D>
double LagrangianSph<D>::stable_dt() const {
  const double most = scene_.sisph.jump * scene_.water.spacing;  // m
  return std::min({Base::longest_step(), allowed_, most / std::max(moving_.jump(), 1e-300)});
}

template class LagrangianSph<1>;
template class LagrangianSph<2>;

}  // namespace freshet::sisph
