// The particles' fields, and the structs that kernels see them by.
#include "src/methods/sisph/moving.hpp"

namespace freshet::sisph {

template <int D>
WaterFields<D> SemiImplicitSph<D>::declare(const FieldList& fields) const {
  WaterFields<D> f;
  f.declare(fields);
  if (bed_) f.declare_bed(fields);
  if (scene_.sisph.path.remembers) f.declare_before(fields);
  return f;
}

template <int D>
WaterFields<D> SemiImplicitSph<D>::bind() const {
  return declare(FieldList::binding(particles_));
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
  const WaterFields<D> f = bind();
  return {f.depth, level_of_bed_, f.v};
}

template <int D>
Swarm<D> LagrangianSph<D>::swarm() const {
  return {Base::bind(), order_.rows(), drag_};
}

template class SemiImplicitSph<1>;
template class SemiImplicitSph<2>;
template class LagrangianSph<1>;
template class LagrangianSph<2>;

}  // namespace freshet::sisph
