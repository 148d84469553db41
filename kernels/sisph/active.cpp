#include "kernels/sisph/active.hpp"

namespace freshet::sisph {

template <int D>
ActiveSlices<D>::ActiveSlices(const Geometry<D>& g)
    : g_(g), list_{Field<int>("sisph.active", static_cast<size_t>(g.pairs.slices()) + 1), 0},
      near_("sisph.near_water", static_cast<size_t>(g.pairs.slices()) + 1) {}

// Marks are ones written by whoever reaches the slice: which thread comes first does not matter.
template <int D>
void ActiveSlices<D>::find(const Field<double>& depth) {
  const PairView pairs = g_.pairs;
  const SliceList free = g_.slices, active = list_;
  const Field<int> near = near_;
  const Field<double> h = depth;
  Kokkos::parallel_reduce("sisph::dry", Range(0, pairs.slices()), KOKKOS_LAMBDA(int s, int& dry) {
        const Lanes me = pairs(s);
        int here = 0;
        for (int l = 0; l < me.count; ++l) here += h(me.particle(l)) > 0 ? 0 : 1;
        near(s) = here < me.count ? 1 : 0;
        dry += here;
      }, dry_);
  if (dry_ > 0)
    Kokkos::parallel_for("sisph::spread", Range(0, pairs.slices()), KOKKOS_LAMBDA(int s) {
          if (!(largest(pairs(s).load(h)) > 0)) return;
          pairs.for_each(s, [&](int, LaneIndex j) {
            for (int l = 0; l < lanes; ++l) near(lane_of(j, l) / lanes) = 1;
          });
        });
  Kokkos::parallel_scan("sisph::list_active", Range(0, free.count), KOKKOS_LAMBDA(int k, int& count, bool last) {
        const int s = free(k);
        if (near(s) == 0) return;
        if (last) active.list(count) = s;
        ++count;
      }, list_.count);
}

template class ActiveSlices<1>;
template class ActiveSlices<2>;

}  // namespace freshet::sisph
