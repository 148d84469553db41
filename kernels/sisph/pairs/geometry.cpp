#include "kernels/sisph/pairs/geometry.hpp"

#include <cmath>

#include "cellgrid/parallel/launch.hpp"

namespace freshet::sisph {
namespace {

template <int D>
SymField<double, D> sym_field(const std::string& name, size_t n);
template <>
SymField<double, 1> sym_field<1>(const std::string& name, size_t n) {
  return {Field<double>(name, n)};
}
template <>
SymField<double, 2> sym_field<2>(const std::string& name, size_t n) {
  return {Field<double>(name + "_xx", n), Field<double>(name + "_xy", n), Field<double>(name + "_yy", n)};
}

KOKKOS_FORCEINLINE_FUNCTION Sym<Lane, 1> isotropic(Lane a, const Sym<Lane, 1>&) { return {a}; }
KOKKOS_FORCEINLINE_FUNCTION Sym<Lane, 2> isotropic(Lane a, const Sym<Lane, 2>&) { return {a, Lane(0.0), a}; }

// n, d, G (in weight) of every pair, and (sized) omega before it is scaled.
template <int D, class Kernel, bool sized>
struct Measure {
  Geometry<D> g;
  Field<double> h;
  Kernel kernel;

  KOKKOS_FUNCTION void operator()(int s) const {
    const Lanes me = g.pairs(s);
    const Vec<Lane, D> xi = me.load(g.x);
    const Lane hi = me.load(h);
    Lane sum = kernel.at(Lane(0.0)).w / power<D>(hi);
    g.pairs.for_each(s, [&](int e, PairIndex j) {
      const PairShape<D> shape = pair_shape<D>(kernel, gather(g.x, j) - xi, 2.0 / (hi + gather(h.data(), j)));
      PairView::store(g.n, e, shape.n);
      PairView::store(g.distance, e, shape.distance);
      PairView::store(g.weight, e, shape.slope);
      sum += shape.w;
    });
    if constexpr (sized) me.store(g.omega, 1.0 / sum);
  }
};

template <int D>
struct KernelMoments {
  Geometry<D> g;
  double regular;
  bool linear;

  KOKKOS_FUNCTION void operator()(int s) const {
    const Lanes me = g.pairs(s);
    Sym<Lane, D> sum;
    g.pairs.for_each(s, [&](int e, PairIndex j) {
      const Lane w = PairView::load(g.weight, e) * gather(g.omega.data(), j) * PairView::load(g.distance, e);
      sum += outer(PairView::load(g.n, e), w);
    });
    const Lane free = free_lanes(g, me), mean = (1.0 / D) * trace(sum);
    me.store(g.moment, select(Lane(0.5) < free, mean, Lane(regular)) +
                           least_moment);  // a particle without neighbours has no pairs, not NaN
    me.store(g.inverse, inverted(linear ? sum : isotropic(mean, sum)));
  }
};

template <int D>
void measure_pairs(const Geometry<D>& g, const Shapes<D>& shapes, bool sized) {
  const Range all(0, g.pairs.slices());
  std::visit(
      [&](const auto& k) {
        using Kernel = std::decay_t<decltype(k)>;
        if (sized) launch("sisph::measure", all, Measure<D, Kernel, true>{g, shapes.h, k});
        else launch("sisph::measure", all, Measure<D, Kernel, false>{g, shapes.h, k});
      },
      shapes.kernel);
}

template <int D>
struct Areas {
  Geometry<D> g;

  KOKKOS_FUNCTION void operator()(int s) const {
    const Lanes me = g.pairs(s);
    const Lane omega = me.load(g.omega), per = 1.0 / me.load(g.moment);
    g.pairs.for_each(s, [&](int e, PairIndex j) {
      const Lane slope = PairView::load(g.weight, e), other = gather(g.omega.data(), j);
      PairView::store(g.area, e, pair_area(omega, other, slope, per, 1.0 / gather(g.moment.data(), j)));
      PairView::store(g.weight, e, other * slope);
    });
  }
};

template <int D>
void measure_areas(const Geometry<D>& g, const Shapes<D>& shapes) {
  const Range all(0, g.pairs.slices());
  launch("sisph::moments", all, KernelMoments<D>{g, shapes.held_moment, shapes.linear});
  launch("sisph::areas", all, Areas<D>{g});
}

// omega of free particles scaled to `cell` on average; held ones have just that.
template <int D>
void scale_areas(const Geometry<D>& g, double cell) {
  const int n = g.pairs.particles;
  const Field<double> omega = g.omega, free = g.free;
  const auto sum = sum_of_particles<2>(
      "sisph::covered", n, KOKKOS_LAMBDA(int i) {
        return Addends<2>{{free(i) * omega(i), free(i)}};
      });
  const double factor = sum[0] > 0 ? cell * sum[1] / sum[0] : 1;
  launch(
      "sisph::scale_areas", Range(0, n),
      KOKKOS_LAMBDA(int i) { omega(i) = free(i) > 0.5 ? factor * omega(i) : cell; });
}

template <int D>
void list_free_slices(Geometry<D>& g, const Field<int>& held) {
  const PairView pairs = g.pairs;
  const Field<double> free = g.free;
  launch(
      "sisph::mark_free", Range(0, pairs.particles),
      KOKKOS_LAMBDA(int i) { free(i) = held(i) > 0 ? 0.0 : 1.0; });
  g.slices.list = Field<int>("sisph.slices", static_cast<size_t>(pairs.slices()));
  const Field<int> list = g.slices.list;
  Kokkos::parallel_scan(
      "sisph::list_free", Range(0, pairs.slices()),
      KOKKOS_LAMBDA(int s, int& count, bool last) {
        const Lanes me = pairs(s);
        if (largest(me.load(free)) < 0.5) return;
        if (last) list(count) = s;
        ++count;
      },
      g.slices.count);
}

template <int D>
double support_of(const AnyKernel<D>& kernel) {
  return std::visit([](const auto& k) { return k.support; }, kernel);
}

}  // namespace

template <int D>
double lattice_moment(const AnyKernel<D>& kernel, double h, double spacing) {
  const int reach = static_cast<int>(support_of<D>(kernel) * h / spacing) + 1, across = D == 2 ? reach : 0;
  double sum = 0;
  for (int j = -across; j <= across; ++j)
    for (int i = -reach; i <= reach; ++i) {
      const double r = spacing * std::sqrt(static_cast<double>(i * i + j * j));
      sum -= r / (power<D>(h) * h) * std::visit([&](const auto& k) { return k.at(r / h).dw; }, kernel);
    }
  return sum * power<D>(spacing) / D;
}

template <int D>
Geometry<D> measure_geometry(int particles, const AnyKernel<D>& kernel, const GeometryRequest<D>& request) {
  Pairs pairs;
  const PairRequest<D> paired{request.rows, request.x, request.h, support_of<D>(kernel)};
  ImageLists<D> lists;
  list_wall_pairs<D>(particles, paired, request.walls, pairs, lists);
  const auto field = [&](const std::string& label) {
    return Field<double>(label, static_cast<size_t>(particles) + lanes);
  };
  Geometry<D> g{pairs.view(),
                pairs.template vector_coefficient<D>("sisph.n"),
                pairs.coefficient("sisph.distance"),
                pairs.coefficient("sisph.weight"),
                pairs.coefficient("sisph.area"),
                lists.images,
                place_images<D>(particles, paired, request.walls, lists),
                field("sisph.omega"),
                field("sisph.moment"),
                field("sisph.free"),
                sym_field<D>("sisph.inverse", static_cast<size_t>(particles) + lanes),
                {}};
  list_free_slices(g, request.held);
  const double h = request.h.extent(0) > 0 ? on_host(Kokkos::subview(request.h, std::make_pair(0, 1)))(0)
                                           : request.spacing;
  const Shapes<D> shapes{kernel, request.h, lattice_moment<D>(kernel, h, request.spacing), request.linear};
  measure_pairs(g, shapes, true);
  scale_areas(g, request.cell);
  measure_areas(g, shapes);
  return g;
}

template <int D>
void measure_again(const Geometry<D>& g, const Shapes<D>& shapes) {
  measure_pairs(g, shapes, false);
  measure_areas(g, shapes);
}

template void measure_again(const Geometry<1>&, const Shapes<1>&);
template void measure_again(const Geometry<2>&, const Shapes<2>&);
template Geometry<1> measure_geometry(int, const AnyKernel<1>&, const GeometryRequest<1>&);
template Geometry<2> measure_geometry(int, const AnyKernel<2>&, const GeometryRequest<2>&);
template double lattice_moment<1>(const AnyKernel<1>&, double, double);
template double lattice_moment<2>(const AnyKernel<2>&, double, double);

}  // namespace freshet::sisph
