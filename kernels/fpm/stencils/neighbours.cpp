#include "kernels/fpm/stencils/neighbours.hpp"

#include "cellgrid/simd/box.hpp"

namespace freshet::fpm {
namespace {

// The first and last whole period by which the range low..high widened by reach must move to meet all of the
// domain that it covers.
struct Turns {
  int first = 0, last = 0;
  KOKKOS_FORCEINLINE_FUNCTION Turns(double low, double high, double domain, double length) {
    if (length <= 0) return;
    if (high >= domain + length) first = -1;
    if (low < domain) last = 1;
  }
};

// Fills one cluster's slab; what does not fit is counted but not stored. Returns the full length.
template <int D>
struct CloudLister {
  Neighbourhood<D> out;
  Rows rows;
  int slab;

  KOKKOS_INLINE_FUNCTION void operator()(int c, int& longest) const {
    const Lanes me = out.clusters(c);
    const Vec<Lane, D> xi = me.load(out.x);
    const Lane h = me.load(out.h), h2 = h * h;
    const Box b = box_of(xi);
    const double reach = largest(h);
    const Turns tx(b.xlo - reach, b.xhi + reach, out.period.low.x, out.period.length.x);
    const Turns ty(b.ylo - reach, b.yhi + reach, out.period.low.y, out.period.length.y);
    int* list = &out.near.list(c, 0);
    int n = 0;
    for (int ny = ty.first; ny <= ty.last; ++ny)
      for (int nx = tx.first; nx <= tx.last; ++nx) {
        const double sx = nx * out.period.length.x, sy = ny * out.period.length.y;
        const int before = n;
        rows.for_each_run(b.xlo + sx, b.xhi + sx, b.ylo + sy, b.yhi + sy, reach, [&](int begin, int end) {
          for (int j = begin; j < end; ++j) {
            const Vec<Lane, D> d = shortest(broadcast(at(out.x, j)) - xi, out.period);
            if (before > 0 && listed(list, smaller(before, slab), j)) continue;
            list[n < slab ? n : slab] = j;  // the slab's last entry takes the overflow
            n += any(dot(d, d) < h2);
          }
        });
      }
    out.near.length(c) = smaller(n, slab);
    longest = larger(longest, n);
  }

  // A wide cluster may meet a point from both sides of the domain.
  static KOKKOS_INLINE_FUNCTION bool listed(const int* list, int n, int j) {
    for (int k = 0; k < n; ++k)
      if (list[k] == j) return true;
    return false;
  }
};

}  // namespace

template <int D>
void NeighbourFinder<D>::reserve(int clusters) {
  NeighbourView& near = view_.near;
  if (near.length.extent_int(0) >= clusters && near.list.extent_int(1) > slab_) return;
  const size_t room = static_cast<size_t>(larger(clusters + clusters / 4, 16));
  near.length = Field<int>("fpm.list_length", room);
  near.list = {};
  near.list = decltype(near.list)(Kokkos::ViewAllocateWithoutInitializing("fpm.list"), room,
                                  static_cast<size_t>(slab_ + 1));
}

template <int D>
const Neighbourhood<D>& NeighbourFinder<D>::find(const Rows& rows, const VecField<double, D>& x,
                                                 const Field<double>& h, int points, const Period& period) {
  view_.x = x;
  view_.h = h;
  view_.points = points;
  view_.period = period;
  view_.clusters.cut(rows);
  int longest = 0;
  do {
    if (longest > slab_) slab_ = longest + longest / 4;
    reserve(view_.clusters.size());
    const CloudLister<D> lister{view_, rows, slab_};
    Kokkos::parallel_reduce("fpm::list", Range(0, view_.clusters.size()), lister, Kokkos::Max<int>(longest));
  } while (longest > slab_);
  return view_;
}

template class NeighbourFinder<2>;

}  // namespace freshet::fpm
