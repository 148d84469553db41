#include "kernels/sisph/velocity/mass_flux.hpp"

#include "cellgrid/parallel/assign.hpp"
#include "cellgrid/parallel/launch.hpp"

namespace freshet::sisph {
namespace {

// F_ij = f_ij - (a_ij / dt)(eta_j - eta_i)
template <int D, class Matrix>
struct Fluxes {
  Geometry<D> g;
  SliceList active;
  Matrix a;
  Field<double> level, flux;
  double per_dt;

  KOKKOS_FUNCTION void operator()(int k) const {
    const int s = active(k);
    const Lane eta = g.pairs(s).load(level);
    a.for_each(g.pairs, s, [&](int e, PairIndex j, Lane aij) {
      const Lane drawn = (per_dt * aij) * (gather(level.data(), j) - eta);
      PairView::store(flux, e, PairView::load(flux, e) - drawn);
    });
  }
};

// H^{n+1} = H^n - (dt / omega) sum_j F_ij, the share of the outflow that there was water for, that of the
// velocity's slope that keeps the momentum convex (the water that stays, measured in what leaves), and the
// least depth. What flows in does not flow on within the step where outflow is limited, so that one sweep is
// enough: shares that count it change with those of the donors (a dozen sweeps, for the same errors). The
// margin is more than the sums' round-off.
template <int D>
struct Depths {
  Geometry<D> g;
  SliceList active;
  Field<double> before, flux, depth, share, slope_share;
  double dt;

  KOKKOS_FUNCTION void operator()(int k, double& least) const {
    constexpr double margin = 1e-14;
    const int s = active(k);
    const Lanes me = g.pairs(s);
    Lane in(0.0), out(0.0);
    g.pairs.for_each(s, [&](int e, PairIndex) {
      const Lane f = PairView::load(flux, e);
      out += larger(f, Lane(0.0));
      in += larger(-f, Lane(0.0));
    });
    const Lane volume = me.load(g.omega) * me.load(before), free = free_lanes(g, me), has = volume + dt * in;
    const Lane after = select(Lane(0.5) < free, (has - dt * out) / me.load(g.omega), me.load(depth));
    me.store(depth, after);
    me.store(share, select(Lane(0.5) < free,
                           smaller((1.0 - margin) * volume / (dt * out + 1e-300), Lane(1.0)), Lane(1.0)));
    me.store(slope_share, smaller(larger(volume - dt * out, Lane(0.0)) / (dt * out + 1e-300), Lane(1.0)));
    least = smaller(least, smallest(after));
  }
};

template <int D>
struct ScaleOutflow {
  Geometry<D> g;
  SliceList active;
  Field<double> flux, share;

  KOKKOS_FUNCTION void operator()(int k) const {
    const int s = active(k);
    const Lane mine = g.pairs(s).load(share);
    g.pairs.for_each(s, [&](int e, PairIndex j) {
      const Lane f = PairView::load(flux, e);
      PairView::store(flux, e, f * select(Lane(0.0) < f, mine, gather(share.data(), j)));
    });
  }
};

// The part of the way to the face that the donor's gradient adds: half of van Leer's mean of the difference
// to the receiver and the difference that lies upwind of it.
KOKKOS_FORCEINLINE_FUNCTION Lane to_face(Lane difference, Lane twice_along) {
  const Lane product = difference * (twice_along - difference);
  return select(Lane(0.0) < product,
                product / (twice_along + select(Lane(0.0) < twice_along, Lane(1e-300), Lane(-1e-300))),
                Lane(0.0));
}

KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 1> face_velocity(const Vec<Lane, 1>& donor,
                                                       const Vec<Lane, 1>& difference,
                                                       const Vec<Lane, 1>& way, const Vec<Lane, 1>& du,
                                                       const Vec<Lane, 1>&) {
  return {donor.x + to_face(difference.x, 2.0 * dot(du, way))};
}
KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 2> face_velocity(const Vec<Lane, 2>& donor,
                                                       const Vec<Lane, 2>& difference,
                                                       const Vec<Lane, 2>& way, const Vec<Lane, 2>& du,
                                                       const Vec<Lane, 2>& dv) {
  return {donor.x + to_face(difference.x, 2.0 * dot(du, way)),
          donor.y + to_face(difference.y, 2.0 * dot(dv, way))};
}
template <class Mask>
KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 1> either(Mask m, const Vec<Lane, 1>& a, const Vec<Lane, 1>& b) {
  return {select(m, a.x, b.x)};
}
template <class Mask>
KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 2> either(Mask m, const Vec<Lane, 2>& a, const Vec<Lane, 2>& b) {
  return {select(m, a.x, b.x), select(m, a.y, b.y)};
}

template <int D>
struct Advect {
  Geometry<D> g;
  SliceList active;
  Layer<D> water;
  VelocityGradient<D> gradient;
  Field<double> flux, depth, slope_share;
  double dt;
  VecField<double, D> advected;

  KOKKOS_FUNCTION void operator()(int k) const {
    using freshet::select;
    const int s = active(k);
    const Lanes me = g.pairs(s);
    const Vec<Lane, D> vi = me.load(water.v), dui = me.load(gradient.u);
    Vec<Lane, D> dvi;
    if constexpr (D == 2) dvi = me.load(gradient.v);
    const Lane mine = me.load(slope_share);
    Lane in(0.0);
    Vec<Lane, D> carried;
    g.pairs.for_each(s, [&](int e, PairIndex j) {
      const Lane f = PairView::load(flux, e);
      const auto inward = f < Lane(0.0);
      const Lane d = PairView::load(g.distance, e), towards = select(inward, -d, d);
      const Vec<Lane, D> vj = gather(water.v, j), du = either(inward, gather(gradient.u, j), dui);
      Vec<Lane, D> dv;
      if constexpr (D == 2) dv = either(inward, gather(gradient.v, j), dvi);
      const Vec<Lane, D> donor = either(inward, vj, vi), difference = either(inward, vi - vj, vj - vi);
      const Vec<Lane, D> face = face_velocity(donor, difference, towards * PairView::load(g.n, e), du, dv);
      const Lane kept = select(inward, gather(slope_share.data(), j), mine);
      in += larger(-f, Lane(0.0));
      carried += (-f) * (donor + kept * (face - donor) - vi);
    });
    // keep v + dt sum_in |F| v_f - dt sum_out F (v_f - v), less v (keep + dt sum_in |F|)
    const Lane mass = me.load(g.omega) * larger(me.load(depth), Lane(0.0)), whole = larger(mass, dt * in);
    const Lane per = select(Lane(0.0) < whole, dt / (whole + 1e-300), Lane(0.0));
    me.store(advected, vi + (free_lanes(g, me) * per) * carried);
  }
};

}  // namespace

template <int D>
MassFlux<D>::MassFlux(const Geometry<D>& g)
    : g_(g), share_("sisph.share", static_cast<size_t>(g.pairs.particles) + lanes),
      slope_share_("sisph.slope_share", static_cast<size_t>(g.pairs.particles) + lanes) {
  assign(share_, 1.0);
  assign(slope_share_, 1.0);
}

template <int D>
double MassFlux<D>::least_depth(const SliceList& active, const Layer<D>& water, const FreeSurface<D>& surface,
                                double dt) {
  double least = 0;
  Kokkos::parallel_reduce(
      "sisph::depths", Range(0, active.count),
      Depths<D>{g_, active, water.depth, surface.flux(), surface.depth(), share_, slope_share_, dt},
      Kokkos::Min<double>(least));
  return active.count > 0 ? least : 0.0;
}

template <int D>
void MassFlux<D>::scale_outflow(const SliceList& active, const FreeSurface<D>& surface) {
  launch("sisph::scale_outflow", Range(0, active.count), ScaleOutflow<D>{g_, active, surface.flux(), share_});
}

template <int D>
FluxReport MassFlux<D>::close_depths(const SliceList& active, const Layer<D>& water,
                                     const FreeSurface<D>& surface, double dt) {
  std::visit(
      [&](const auto& a) {
        const Fluxes<D, std::decay_t<decltype(a)>> pass{g_,    active, a, surface.level(), surface.flux(),
                                                        1 / dt};
        launch("sisph::fluxes", Range(0, active.count), pass);
      },
      surface.pairs());
  FluxReport report;
  report.limited = least_depth(active, water, surface, dt) < 0;
  if (report.limited) {
    scale_outflow(active, surface);
    (void)least_depth(active, water, surface, dt);
  }
  const Field<double> depth = surface.depth(), omega = g_.omega;
  const Geometry<D> g = g_;
  const SliceList list = active;
  report.clipped = sum_of_slices<1>(
      "sisph::clip", active.count, KOKKOS_LAMBDA(int k) {
        const Lanes me = g.pairs(list(k));
        const Lane left = me.load(depth);
        me.store(depth, larger(left, Lane(0.0)));
        return LaneAddends<1>{{counted(me, me.load(omega) * larger(-left, Lane(0.0)))}};
      })[0];
  return report;
}

template <int D>
void MassFlux<D>::advect(const SliceList& active, const Layer<D>& water, const FreeSurface<D>& surface,
                         const VelocityGradient<D>& gradient, double dt,
                         const VecField<double, D>& advected) {
  launch("sisph::advect", Range(0, active.count),
         Advect<D>{g_, active, water, gradient, surface.flux(), surface.depth(), slope_share_, dt, advected});
}

template class MassFlux<1>;
template class MassFlux<2>;

}  // namespace freshet::sisph
