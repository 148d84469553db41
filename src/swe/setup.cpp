// From a scene to the solver's state: bed, walls, boundaries, particles, reference density.
#include <cmath>

#include "cellgrid/assign.hpp"
#include "cellgrid/launch.hpp"
#include "src/errors.hpp"
#include "src/scene/place.hpp"
#include "src/swe/relax.hpp"
#include "src/swe/solver.hpp"

namespace freshet::swe {
namespace {

VecField<double, 1> vector_field(const FieldSet& f, const char* x, const char*, Vec<double, 1>) { return {f.real(x)}; }
VecField<double, 2> vector_field(const FieldSet& f, const char* x, const char* y, Vec<double, 2>) {
  return {f.real(x), f.real(y)};
}
SymField<double, 1> strain_field(const FieldSet& f, Vec<double, 1>) { return {f.real("strain_xx")}; }
SymField<double, 2> strain_field(const FieldSet& f, Vec<double, 2>) {
  return {f.real("strain_xx"), f.real("strain_xy"), f.real("strain_yy")};
}

template <class F>
void set_field(const Field<double>& field, const std::vector<Placed>& particles, const F& value) {
  auto host = Kokkos::create_mirror_view(field);
  for (size_t i = 0; i < particles.size(); ++i) host(i) = value(particles[i]);
  assign(field, host);
}

}  // namespace

// On slopes below 1e-3 the variational acceleration differs from the classical one by 1e-6 g: the bed's curvature is not
// looked up there.
template <int D>
void Solver<D>::build_bed() {
  constexpr double flat = 1e-3;
  if (!scene_.bed.elevation) return;
  const double spacing = scene_.bed.spacing > 0 ? scene_.bed.spacing : scene_.water.spacing;
  bed_ = Bed<D>{BedSpline<D>(scene_.bed.elevation, {scene_.domain.low, scene_.domain.high, spacing, scene_.bed.filter}), false, {}};
  bed_->variational = scene_.sph.acceleration == Acceleration::variational && bed_->spline.steepest() >= flat;
}

template <int D>
void Solver<D>::build_friction() {
  if (!scene_.manning) return;
  const Manning& manning = *scene_.manning;
  friction_ = Friction{scene_.gravity, manning.n};
  if (!manning.map) return;
  const auto squared = [&](double x, double y) { const double n = manning.map(x, y); return n * n; };
  friction_->roughness2 = NearestTable(squared, {scene_.domain.low, scene_.domain.high, manning.node, manning.step});
}

// Depth at t = 0 over the bed as the particles feel it: filtered and tabulated.
template <int D>
Function Solver<D>::initial_depth() const {
  if (!scene_.water.surface) return scene_.water.depth;
  return [this](double x, double y) {
    Vec<double, D> at;
    at.x = x;
    if constexpr (D == 2) at.y = y;
    return scene_.water.surface(x, y) - (bed_ ? bed_->spline.at(at).b : 0.0);
  };
}

template <int D>
void Solver<D>::place_particles() {
  const bool relaxed = scene_.water.start == Water::Start::relaxed;
  const std::vector<Placed> placed = relaxed ? relaxed_lattice<D>(scene_, initial_depth()) : place(scene_, initial_depth());
  particles_ = FieldSet(static_cast<int>(placed.size()));
  make_fields();
  const Particles<D> p = bind();
  const auto fill = [&](const Field<double>& field, const auto& value) { set_field(field, placed, value); };
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
  const Field<int> id = p.id;
  launch("swe::number", Range(0, particles_.size()), KOKKOS_LAMBDA(int i) { id(i) = i; });
  next_id_ = particles_.size();
}

// Every field of this scene; the optional ones only where the scene needs them.
template <int D>
void Solver<D>::make_fields() {
  FieldSet& f = particles_;
  const auto vector = [&](const char* x, const char* y, const char* unit, Carry carry) {
    f.real(x, unit, carry);
    if (D == 2) f.real(y, unit, carry);
  };
  const char* volume = D == 1 ? "m2" : "m3";
  vector("x", "y", "m", Carry::state);
  vector("u", "v", "m/s", Carry::state);
  vector("u_pred", "v_pred", "m/s", Carry::sort);
  vector("ax", "ay", "m/s2", Carry::result);
  vector("tx", "ty", "m/s2", Carry::no);
  for (const char* name : {"mass", "kh"}) f.real(name, volume, Carry::state);
  for (const char* name : {"h0", "depth", "h"}) f.real(name, "m", Carry::state);
  f.real("depth_rate", "m/s", Carry::state);
  f.real("depth_growth", "m/s", Carry::result);
  f.real("inv_h", "1/m", Carry::no);
  f.real("pressure", "m/s2", Carry::no);
  for (const char* name : {"celerity", "signal"}) f.real(name, "m/s", Carry::no);
  f.real("weight", "1", Carry::no);
  f.integer("id", "1", Carry::state);
  if (gradient_)
    for (const char* name : {"strain_xx", "strain_xy", "strain_yy"})
      if (D == 2 || name == std::string("strain_xx"))
        f.real(name, "1/s", scene_.split && scene_.split->linear ? Carry::result : Carry::no);
  if (depth_gradient_) vector("depth_slope_x", "depth_slope_y", "1", Carry::no);
  if (scene_.sph.well_balanced) f.real("calibration", "1", Carry::state);
  if (bed_) f.real("bed", "m", Carry::result);
  if (friction_) f.real("drag", "1/m", Carry::result);
  if (!boundaries_.empty()) f.integer("kind", "1", Carry::state);
}

template <int D>
Particles<D> Solver<D>::bind() const {
  const FieldSet& f = particles_;
  const Vec<double, D> dimension;
  Particles<D> p;
  p.x = vector_field(f, "x", "y", dimension);
  p.v = vector_field(f, "u", "v", dimension);
  p.v_pred = vector_field(f, "u_pred", "v_pred", dimension);
  p.a = vector_field(f, "ax", "ay", dimension);
  p.t = vector_field(f, "tx", "ty", dimension);
  p.m = f.real("mass");
  p.h0 = f.real("h0");
  p.kh = f.real("kh");
  p.rho = f.real("depth");
  p.h = f.real("h");
  p.rate = f.real("depth_rate");
  p.growth = f.real("depth_growth");
  p.inv_h = f.real("inv_h");
  p.pressure = f.real("pressure");
  p.celerity = f.real("celerity");
  p.weight = f.real("weight");
  p.signal = f.real("signal");
  p.id = f.integer("id");
  if (gradient_) p.strain = strain_field(f, dimension);
  if (depth_gradient_) p.depth_slope = vector_field(f, "depth_slope_x", "depth_slope_y", dimension);
  p.single = single_;
  return p;
}

template <int D>
void Solver<D>::make_room() {
  const int room = particles_.capacity();
  if (!scene_.sph.mixed || single_.motion.extent_int(0) == room) return;
  single_.motion = Kokkos::View<SingleRecord<4>*, Memory>(Kokkos::view_alloc("single_motion", Kokkos::WithoutInitializing), room);
  single_.state = Kokkos::View<SingleRecord<16>*, Memory>(Kokkos::view_alloc("single_state", Kokkos::WithoutInitializing), room);
}

template <int D>
Field<int> Solver<D>::kind() const {
  return boundaries_.empty() ? Field<int>() : particles_.integer("kind");
}

// The bed with the view of its level under each particle.
template <int D>
std::optional<Bed<D>> Solver<D>::bed() const {
  std::optional<Bed<D>> bed = bed_;
  if (bed) bed->level = particles_.real("bed");
  return bed;
}

template class Solver<1>;
template class Solver<2>;

}  // namespace freshet::swe
