#include "kernels/sisph/pairs/active.hpp"

#include "cellgrid/parallel/launch.hpp"

namespace freshet::sisph {

template <int D>
ActiveSlices<D>::ActiveSlices(const Geometry<D>& g)
    : g_(g), list_{Field<int>("sisph.active", static_cast<size_t>(g.pairs.slices()) + 1), 0},
      near_("sisph.near_water", static_cast<size_t>(g.pairs.slices()) + 1),
      slice_("sisph.slice_of", static_cast<size_t>(g.pairs.particles)) {
  number_slices();
}

template <int D>
void ActiveSlices<D>::number_slices() {
  const PairView pairs = g_.pairs;
  const Field<int> slice = slice_;
  launch(
      "sisph::number_slices", Range(0, pairs.slices()), KOKKOS_LAMBDA(int s) {
        const Lanes me = pairs(s);
        for (int l = 0; l < me.count; ++l) slice(me.particle(l)) = s;
      });
}

// near: 1 with water, then the support in which it is reached. Whoever reaches a slice writes the same: which
// thread is first does not matter.
template <int D>
void ActiveSlices<D>::find(const Field<double>& depth, int supports) {
  const PairView pairs = g_.pairs;
  const SliceList free = g_.slices, active = list_;
  const Field<int> near = near_, slice = slice_;
  const Field<double> h = depth;
  Kokkos::parallel_reduce(
      "sisph::dry", Range(0, pairs.slices()),
      KOKKOS_LAMBDA(int s, int& dry) {
        const Lanes me = pairs(s);
        int here = 0;
        for (int l = 0; l < me.count; ++l) here += h(me.particle(l)) > 0 ? 0 : 1;
        near(s) = here < me.count ? 1 : 0;
        dry += here;
      },
      dry_);
  for (int ring = 1; dry_ > 0 && ring <= supports; ++ring)
    launch(
        "sisph::spread", Range(0, pairs.slices()), KOKKOS_LAMBDA(int s) {
          if (near(s) != ring) return;
          pairs.for_each(s, [&](int, PairIndex j) {
            for (int l = 0; l < lanes; ++l) {
              int& other = near(slice(lane_of(j.j, l)));
              if (other == 0) other = ring + 1;
            }
          });
        });
  Kokkos::parallel_scan(
      "sisph::list_active", Range(0, free.count),
      KOKKOS_LAMBDA(int k, int& count, bool last) {
        const int s = free(k);
        if (near(s) == 0) return;
        if (last) active.list(count) = s;
        ++count;
      },
      list_.count);
}

template class ActiveSlices<1>;
template class ActiveSlices<2>;

}  // namespace freshet::sisph
