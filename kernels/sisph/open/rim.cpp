#include "kernels/sisph/open/rim.hpp"

namespace freshet::sisph {
namespace {

template <int D, class Matrix>
struct Crossing {
  Geometry<D> g;
  SliceList rim;
  Matrix a;
  Field<double> flux, level;
  double drawn_per_dt;  // 1/dt, or 0 where the flux holds it already

  KOKKOS_FUNCTION LaneAddends<2> operator()(int k) const {
    const int s = rim(k);
    const Lanes me = g.pairs(s);
    const Lane free = free_lanes(g, me), eta = me.load(level);
    Lane in(0.0), out(0.0);
    a.for_each(g.pairs, s, [&](int e, PairIndex j, Lane aij) {
      const Lane drawn = (drawn_per_dt * aij) * (gather(level.data(), j) - eta);
      const Lane f = (free * (1.0 - gather(g.free.data(), j))) * (PairView::load(flux, e) - drawn);
      in += larger(-f, Lane(0.0));
      out += larger(f, Lane(0.0));
    });
    return LaneAddends<2>{{counted(me, in), counted(me, out)}};
  }
};

template <int D>
SliceList slices_with_held_neighbours(const Geometry<D>& geometry) {
  SliceList rim{Field<int>("sisph.rim", static_cast<size_t>(geometry.slices.count) + 1), 0};
  const Field<int> list = rim.list;
  Kokkos::parallel_scan(
      "sisph::list_rim", Range(0, geometry.slices.count),
      KOKKOS_LAMBDA(int k, int& count, bool last) {
        const int s = geometry.slices(k);
        Lane held(0.0);
        geometry.pairs.for_each(
            s, [&](int, PairIndex j) { held = larger(held, 1.0 - gather(geometry.free.data(), j)); });
        if (largest(held) < 0.5) return;
        if (last) list(count) = s;
        ++count;
      },
      rim.count);
  return rim;
}

}  // namespace

template <int D>
Rim<D>::Rim(const Geometry<D>& g) : g_(g), list_(slices_with_held_neighbours(g)) {}

template <int D>
RimFlow Rim<D>::flow(const FreeSurface<D>& surface, double dt, bool closed) {
  if (list_.count == 0) return {};
  const auto sum = std::visit(
      [&](const auto& a) {
        const Crossing<D, std::decay_t<decltype(a)>> pass{
            g_, list_, a, surface.flux(), surface.level(), closed ? 0.0 : 1 / dt};
        return sum_of_slices<2>("sisph::rim_flow", list_.count, pass);
      },
      surface.pairs());
  return {dt * sum[0], dt * sum[1]};
}

template class Rim<1>;
template class Rim<2>;

}  // namespace freshet::sisph
