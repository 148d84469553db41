#include "kernels/fpm/neighbours.hpp"

namespace freshet::fpm {
namespace {

struct Box {
  double xlo, xhi, ylo, yhi;  // m
};
KOKKOS_FORCEINLINE_FUNCTION Box box_of(const Vec<Lane, 2>& x) { return {smallest(x.x), largest(x.x), smallest(x.y), largest(x.y)}; }

// Fills one cluster's slab; what does not fit is counted but not stored. Returns the full length.
template <int D>
struct Lister {
  Neighbourhood<D> out;
  Rows rows;
  int slab;

  KOKKOS_INLINE_FUNCTION void operator()(int c, int& longest) const {
    const Lanes me = out.clusters(c);
    const Vec<Lane, D> xi = me.load(out.x);
    const Lane h = me.load(out.h), h2 = h * h;
    const Box b = box_of(xi);
    int* list = &out.near.list(c, 0);
    int n = 0;
    rows.for_each_run(b.xlo, b.xhi, b.ylo, b.yhi, largest(h), [&](int begin, int end) {
      for (int j = begin; j < end; ++j) {
        const Vec<Lane, D> d = xi - broadcast(at(out.x, j));
        list[n < slab ? n : slab] = j;  // the slab's last entry takes the overflow
        n += any(dot(d, d) < h2);
      }
    });
    out.near.length(c) = smaller(n, slab);
    longest = larger(longest, n);
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
  near.list = decltype(near.list)(Kokkos::ViewAllocateWithoutInitializing("fpm.list"), room, static_cast<size_t>(slab_ + 1));
}

template <int D>
const Neighbourhood<D>& NeighbourFinder<D>::find(const Rows& rows, const VecField<double, D>& x, const Field<double>& h, int points) {
  view_.x = x;
  view_.h = h;
  view_.points = points;
  view_.clusters.cut(rows);
  int longest = 0;
  do {
    if (longest > slab_) slab_ = longest + longest / 4;
    reserve(view_.clusters.size());
    const Lister<D> lister{view_, rows, slab_};
    Kokkos::parallel_reduce("fpm::list", Range(0, view_.clusters.size()), lister, Kokkos::Max<int>(longest));
  } while (longest > slab_);
  return view_;
}

template class NeighbourFinder<2>;

}  // namespace freshet::fpm
