// From a scene to the state at t = 0: the ground and the particles.
#include "cellgrid/parallel/assign.hpp"
#include "src/methods/swe/solver.hpp"

namespace freshet::swe {

// On slopes below 1e-3 the variational acceleration differs from the classical one by 1e-6 g: the bed's
// curvature is not looked up there.
template <int D>
void ExplicitSph<D>::build_ground() {
  constexpr double flat = 1e-3;
  bed_ = bed_spline<D>(scene_, scene_.domain);
  variational_ = bed_ && scene_.sph.acceleration == Acceleration::variational && bed_->steepest() >= flat;
  if (scene_.manning) friction_ = Friction{scene_.gravity, scene_.manning->n, Base::roughness(1)};
}

template <int D>
void ExplicitSph<D>::place_particles(const std::vector<Placed>& start) {
  const auto depth = [this](double x, double y) { return initial_depth<D>(scene_, bed_, {x, y}); };
  const std::vector<Placed> placed = start.empty() ? place(scene_, depth) : start;
  particles_ = FieldSet(static_cast<int>(placed.size()));
  make_fields();
  const Particles<D> p = bind();
  const auto fill = [&](const Field<double>& field, const auto& value) {
    upload(field, placed.size(), [&](std::size_t i) { return value(placed[i]); });
  };
  fill(p.x.x, [](const Placed& q) { return q.x[0]; });
  fill(p.v.x, [](const Placed& q) { return q.velocity[0]; });
  fill(p.v_pred.x, [](const Placed& q) { return q.velocity[0]; });
  if constexpr (D == 2) {
    fill(p.x.y, [](const Placed& q) { return q.x[1]; });
    fill(p.v.y, [](const Placed& q) { return q.velocity[1]; });
    fill(p.v_pred.y, [](const Placed& q) { return q.velocity[1]; });
  }
  fill(p.m, [](const Placed& q) { return q.depth * q.area; });
  fill(p.rho, [](const Placed& q) { return q.depth; });
  fill(p.h, [](const Placed& q) { return q.h0; });
  fill(p.h0, [](const Placed& q) { return q.h0; });
  fill(p.kh, [](const Placed& q) { return q.depth * power<D>(q.h0); });
  upload(p.id, placed.size(), [](std::size_t i) { return static_cast<int>(i); });
  next_id_ = particles_.size();
}

template class ExplicitSph<1>;
template class ExplicitSph<2>;

}  // namespace freshet::swe
