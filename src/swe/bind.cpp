// The particles' fields, and the structs that kernels see them by.
#include "src/swe/solver.hpp"

namespace freshet::swe {
namespace {

SymField<double, 1> strain_field(const FieldSet& f, Vec<double, 1>) { return {f.real("strain_xx")}; }
SymField<double, 2> strain_field(const FieldSet& f, Vec<double, 2>) {
  return {f.real("strain_xx"), f.real("strain_xy"), f.real("strain_yy")};
}

}  // namespace

// Every field of this scene; the optional ones only where the scene needs them.
template <int D>
void ExplicitSph<D>::make_fields() {
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
Particles<D> ExplicitSph<D>::bind() const {
  const FieldSet& f = particles_;
  Particles<D> p;
  p.x = f.vector<D>("x", "y");
  p.v = f.vector<D>("u", "v");
  p.v_pred = f.vector<D>("u_pred", "v_pred");
  p.a = f.vector<D>("ax", "ay");
  p.t = f.vector<D>("tx", "ty");
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
  if (gradient_) p.strain = strain_field(f, Vec<double, D>{});
  if (depth_gradient_) p.depth_slope = f.vector<D>("depth_slope_x", "depth_slope_y");
  p.single = single_;
  return p;
}

template <int D>
void ExplicitSph<D>::make_room() {
  const int room = particles_.capacity();
  if (!scene_.sph.mixed || single_.motion.extent_int(0) == room) return;
  single_.motion = Kokkos::View<SingleRecord<4>*, Memory>(Kokkos::view_alloc("single_motion", Kokkos::WithoutInitializing), room);
  single_.state = Kokkos::View<SingleRecord<16>*, Memory>(Kokkos::view_alloc("single_state", Kokkos::WithoutInitializing), room);
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
