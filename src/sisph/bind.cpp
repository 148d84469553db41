// The particles' fields, and the structs that kernels see them by.
#include "src/sisph/moving.hpp"

namespace freshet::sisph {

template <int D>
void SemiImplicitSph<D>::make_fields() {
  FieldSet& f = particles_;
  for (const char* name : {"x", "y"})
    if (D == 2 || name == std::string("x")) f.real(name, "m", Carry::state);
  for (const char* name : {"u", "v"})
    if (D == 2 || name == std::string("u")) f.real(name, "m/s", Carry::state);
  f.real("depth", "m", Carry::state);
  f.real("h", "m", Carry::state);
  f.real("mass", D == 1 ? "m2" : "m3", Carry::state);
  if (bed_) f.real("bed", "m", Carry::state);
  if (scene_.sisph.paths == Sisph::Paths::rk3)
    for (const char* name : {"u_before", "v_before"})
      if (D == 2 || name == std::string("u_before")) f.real(name, "m/s", Carry::state);
  f.integer("id", "1", Carry::state);
  f.integer("kind", "1", Carry::state);
}

template <int D>
std::vector<Point> SemiImplicitSph<D>::places() const {
  const auto x = on_host(particles_.real("x")), y = on_host(particles_.real(D == 2 ? "y" : "x"));
  std::vector<Point> all;
  for (int i = 0; i < particles_.size(); ++i) all.push_back({x(i), D == 2 ? y(i) : 0.0});
  return all;
}

template <int D>
Layer<D> SemiImplicitSph<D>::water() const {
  const FieldSet& f = particles_;
  return {f.real("depth"), level_of_bed_, f.vector<D>("u", "v")};
}

template <int D>
Swarm<D> LagrangianSph<D>::swarm() const {
  const FieldSet& f = particles_;
  return {order_.rows(), f.vector<D>("x", "y"), f.vector<D>("u", "v"),
          f.has("u_before") ? f.vector<D>("u_before", "v_before") : VecField<double, D>{}, f.real("depth"), f.real("mass"),
          f.real_or_none("bed"), f.real("h"), f.integer("id"), f.integer("kind"), drag_};
}

template class SemiImplicitSph<1>;
template class SemiImplicitSph<2>;
template class LagrangianSph<1>;
template class LagrangianSph<2>;

}  // namespace freshet::sisph
