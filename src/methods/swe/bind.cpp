// The particles' fields, and the structs that kernels see them by.
#include "src/methods/swe/solver.hpp"

namespace freshet::swe {

template <int D>
Particles<D> ExplicitSph<D>::declare(const FieldList& fields) const {
  Particles<D> p;
  p.declare(fields);
  if (gradient_) p.declare_strain(fields, scene_.split && scene_.split->linear);
  if (depth_gradient_) p.declare_depth_slope(fields);
  p.single = single_;
  return p;
}

// Every field of this scene; the optional ones only where the scene needs them.
template <int D>
void ExplicitSph<D>::make_fields() {
  FieldSet& f = particles_;
  declare(FieldList::making(f));
  if (scene_.sph.well_balanced) f.real("calibration", "1", Carry::state);
  if (bed_) f.real("bed", "m", Carry::result);
  if (friction_) f.real("drag", "1/m", Carry::result);
  if (!boundaries_.empty()) f.integer("kind", "1", Carry::state);
}

template <int D>
Particles<D> ExplicitSph<D>::bind() const {
  return declare(FieldList::binding(particles_));
}

template <int D>
void ExplicitSph<D>::make_room() {
  const int room = particles_.capacity();
  if (!scene_.sph.mixed || single_.motion.extent_int(0) == room) return;
  single_.motion = Kokkos::View<SingleRecord<4>*, Memory>(
      Kokkos::view_alloc("single_motion", Kokkos::WithoutInitializing), room);
  single_.state = Kokkos::View<SingleRecord<16>*, Memory>(
      Kokkos::view_alloc("single_state", Kokkos::WithoutInitializing), room);
}

template <int D>
Field<int> ExplicitSph<D>::kind() const {
  return particles_.integer_or_none("kind");
}

// The bed with the view of its level under each particle.
template <int D>
std::optional<BedTerm<D>> ExplicitSph<D>::bed_term() const {
  if (!bed_) return {};
  return BedTerm<D>{*bed_, variational_, particles_.real("bed")};
}

template class ExplicitSph<1>;
template class ExplicitSph<2>;

}  // namespace freshet::swe
