#include "kernels/sisph/velocity/viscosity.hpp"

#include "cellgrid/parallel/launch.hpp"
#include "kernels/sisph/pairs/parts.hpp"

namespace freshet::sisph {
namespace {

template <class V>
KOKKOS_FORCEINLINE_FUNCTION Vec<V, 1> same(V a, Vec<V, 1>) {
  return {a};
}
template <class V>
KOKKOS_FORCEINLINE_FUNCTION Vec<V, 2> same(V a, Vec<V, 2>) {
  return {a, a};
}

// dt c_ij, the mass and the inverse diagonal, and the right side.
template <int D>
struct Pulls {
  Geometry<D> g;
  Field<double> depth, drag;
  VecField<double, D> u;
  double viscosity_dt;
  Field<double> pull, mass;
  VecField<double, D> right, inverse;

  KOKKOS_FUNCTION void operator()(int k) const {
    const int s = g.slices(k);
    const Lanes me = g.pairs(s);
    const Lane hi = me.load(depth), free = free_lanes(g, me);
    const Vec<Lane, D> ui = me.load(u);
    Lane sum(0.0);
    Vec<Lane, D> pulled;
    g.pairs.for_each(s, [&](int e, PairIndex j) {
      const Lane hj = gather(depth.data(), j),
                 both = 0.5 * (hi + hj) * wetness(smaller(hi, hj), larger(hi, hj));
      const Lane c = viscosity_dt * PairView::load(g.area, e) * both / PairView::load(g.distance, e);
      PairView::store(pull, e, c);
      sum += c;
      pulled += c * (gather(u, j) - ui);
    });
    Lane m = me.load(g.omega) * hi;
    if (drag.extent(0) > 0) m = m * (1.0 + me.load(drag));
    const Lane diagonal = m + sum;
    me.store(mass, m);
    me.store(right, free * pulled);
    me.store(inverse,
             same(select(Lane(0.0) < diagonal, free / (diagonal + 1e-300), Lane(0.0)), Vec<Lane, D>{}));
  }
};

// y = (M + dt C) x; returns the slice's part of x . y.
template <int D>
struct Product {
  Geometry<D> g;
  Field<double> pull, mass;
  VecField<double, D> x, y;

  KOKKOS_FUNCTION LaneAddends<1> operator()(int k) const {
    const int s = g.slices(k);
    const Lanes me = g.pairs(s);
    const Vec<Lane, D> xi = me.load(x);
    Vec<Lane, D> row = me.load(mass) * xi;
    g.pairs.for_each(s, [&](int e, PairIndex j) { row += PairView::load(pull, e) * (xi - gather(x, j)); });
    row = free_lanes(g, me) * row;
    me.store(y, row);
    return {{counted(me, dot(xi, row))}};
  }
};

template <int D>
void fill_images(const Images<D>& images, const VecField<double, D>& v, bool slip) {
  if (slip) images.fill(v);
  else images.fill_opposed(v);
}

}  // namespace

template <int D>
Viscosity<D>::Viscosity(const Geometry<D>& g, const ViscosityOptions& options)
    : g_(g), options_(options), stride_(g.images.slots() + lanes),
      pull_("sisph.viscous_pull", g.pairs.j.extent(0)),
      mass_("sisph.viscous_mass", static_cast<size_t>(g.pairs.particles) + lanes) {
  for (Field<double>* f : {&right_, &inverse_, &change_})
    *f = Field<double>("sisph.viscous", static_cast<size_t>(D * stride_) + lanes);
  cg_.resize(D * stride_);
}

template <int D>
int Viscosity<D>::find(const Layer<D>& water, const Field<double>& drag, const VecField<double, D>& predicted,
                       double dt) {
  const TimedRegion region("sisph::viscosity");
  const Vec<double, D> like;
  fill_images(g_.images, predicted, options_.slip);
  launch("sisph::viscous_pulls", Range(0, g_.slices.count),
         Pulls<D>{g_, water.depth, drag, predicted, options_.viscosity * dt, pull_, mass_,
                  parts(right_, stride_, like), parts(inverse_, stride_, like)});
  const auto product = [&](const Field<double>& x, const Field<double>& y) {
    fill_images(g_.images, parts(x, stride_, like), options_.slip);
    return sum_of_slices<1>(
        "sisph::viscous_product", g_.slices.count,
        Product<D>{g_, pull_, mass_, parts(x, stride_, like), parts(y, stride_, like)})[0];
  };
  linear::CgOptions cg;
  cg.tolerance = options_.tolerance;
  cg.max_iterations = options_.most;
  return cg_.solve(product, linear::Jacobi{inverse_}, right_, change_, cg).iterations;
}

template <int D>
void Viscosity<D>::add(const Field<double>& drag, const VecField<double, D>& to) const {
  const VecField<double, D> change = parts(change_, stride_, Vec<double, D>{}), v = to;
  const Field<double> gamma = drag;
  const bool dragged = gamma.extent(0) > 0;
  launch(
      "sisph::add_viscous", Range(0, g_.pairs.particles),
      KOKKOS_LAMBDA(int i) { put(v, i, at(v, i) + (dragged ? 1 + gamma(i) : 1.0) * at(change, i)); });
}

template class Viscosity<1>;
template class Viscosity<2>;

}  // namespace freshet::sisph
