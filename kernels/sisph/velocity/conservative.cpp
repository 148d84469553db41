#include "kernels/sisph/velocity/conservative.hpp"

#include "cellgrid/parallel/launch.hpp"

namespace freshet::sisph {
namespace {

template <int D>
struct Slope {
  Geometry<D> g;
  SliceList active;
  DepthLevels depths;
  Field<double> bed;
  VecField<double, D> slope;

  static KOKKOS_FORCEINLINE_FUNCTION Lane wet(Lane a) { return larger(a, Lane(0.0)); }

  KOKKOS_FUNCTION void operator()(int k) const {
    const int s = active(k);
    const Lanes me = g.pairs(s);
    const double t = depths.theta;
    const Lane next = wet(me.load(depths.next)), hi = (1 - t) * wet(me.load(depths.now)) + t * next,
               bi = me.load(bed);
    Vec<Lane, D> sum;
    g.pairs.for_each(s, [&](int e, PairIndex j) {
      const Lane hj = (1 - t) * wet(gather(depths.now.data(), j)) + t * wet(gather(depths.next.data(), j));
      // What stands above the higher bed pushes: none from or to dry land that is higher.
      const Lane bj = gather(bed.data(), j), higher = larger(bi, bj);
      const Lane rise = larger(bj + hj, higher) - larger(bi + hi, higher);
      sum += (0.25 * PairView::load(g.area, e) * (hi + hj) * rise) * PairView::load(g.n, e);
    });
    const Lane mass = me.load(g.omega) * next;
    const Lane per = select(Lane(0.0) < next, free_lanes(g, me) / (mass + 1e-300), Lane(0.0));
    me.store(slope, per * sum);
  }
};

}  // namespace

template <int D>
void conservative_slope(const Geometry<D>& g, const SliceList& active, const DepthLevels& depths,
                        const Field<double>& bed, const VecField<double, D>& slope) {
  launch("sisph::conservative_slope", Range(0, active.count), Slope<D>{g, active, depths, bed, slope});
}

template void conservative_slope(const Geometry<1>&, const SliceList&, const DepthLevels&,
                                 const Field<double>&, const VecField<double, 1>&);
template void conservative_slope(const Geometry<2>&, const SliceList&, const DepthLevels&,
                                 const Field<double>&, const VecField<double, 2>&);

}  // namespace freshet::sisph
