#include "cellgrid/clusters.hpp"

#include <type_traits>

#include "cellgrid/balanced.hpp"
#include "cellgrid/box.hpp"

namespace freshet {

void ClusterSet::cut(const Rows& rows) {
  if (row_start_.extent_int(0) < rows.rows + 1) row_start_ = Field<int>("cellgrid.row_start", static_cast<size_t>(2 * rows.rows + 16));
  const Field<int> row_start = row_start_;
  const Rows r = rows;
  Kokkos::parallel_scan("cellgrid::count_clusters", Range(0, rows.rows + 1), KOKKOS_LAMBDA(int row, int& sum, bool last) {
        if (last) row_start(row) = sum;
        if (row < r.rows) sum += (r.row_begin(row + 1) - r.row_begin(row) + lanes - 1) / lanes;
      });
  Kokkos::deep_copy(size_, Kokkos::subview(row_start_, rows.rows));
  if (first_.extent_int(0) < size_) {
    const size_t room = static_cast<size_t>(size_ + size_ / 4 + 16);
    first_ = Field<int>("cellgrid.cluster_first", room);
    count_ = Field<int>("cellgrid.cluster_count", room);
  }
  const Field<int> first = first_, count = count_;
  Kokkos::parallel_for("cellgrid::cut_clusters", Range(0, rows.rows), KOKKOS_LAMBDA(int row) {
        const int end = r.row_begin(row + 1);
        int c = row_start(row);
        for (int i = r.row_begin(row); i < end; i += lanes, ++c) {
          first(c) = i;
          count(c) = smaller(lanes, end - i);
        }
      });
}

namespace {

// Fills one cluster's slab; what does not fit is counted but not stored. Returns the full length.
template <int D>
struct Lister {
  ClusterSet clusters;
  VecField<double, D> x, source_x;
  Field<double> h, source_h;
  Rows sources;
  double reach;  // factor (1 + margin)
  NeighbourView out;
  int slab;

  KOKKOS_INLINE_FUNCTION void operator()(int c, int& longest) const {
    const Lanes me = clusters(c);
    const Vec<Lane, D> xi = me.load(x);
    const Lane reach_i = reach * me.load(h);
    const Box b = box_of(xi);
    const double mine = largest(reach_i), theirs = sources.largest_h(b.xlo, b.xhi, b.ylo, b.yhi);
    if (theirs == 0 && mine < sources.support) {  // no source within a tile (each has an h of its own, be it tiny)
      out.length(c) = 0;
      return;
    }
    const double far = larger(mine, reach * theirs);
    int* list = &out.list(c, 0);
    int n = 0;
    const auto near = [&](int j) {
      const Vec<Lane, D> d = xi - broadcast(at(source_x, j));
      const Lane limit = larger(reach_i, Lane(reach) * Lane(source_h(j)));
      return any(dot(d, d) < limit * limit);
    };
    sources.for_each_run(b.xlo, b.xhi, b.ylo, b.yhi, far, [&](int begin, int end) {
      int j = begin;
      for (const int sure = smaller(end, begin + slab - n); j < sure; ++j) {  // these fit in, even if all are near
        list[n] = j;
        n += near(j);
      }
      for (; j < end; ++j) {
        list[smaller(n, slab)] = j;  // the slab's last entry takes the overflow
        n += near(j);
      }
    });
    out.length(c) = smaller(n, slab);
    longest = larger(longest, n);
  }
};

}  // namespace

void NeighbourList::reserve(int clusters) {
  if (view_.length.extent_int(0) >= clusters && view_.list.extent_int(1) > slab_) return;
  const size_t room = static_cast<size_t>(larger(clusters + clusters / 4, 16));
  view_.length = Field<int>("cellgrid.list_length", room);
  view_.list = {};
  view_.list = decltype(view_.list)(Kokkos::ViewAllocateWithoutInitializing("cellgrid.list"), room, static_cast<size_t>(slab_ + 1));
}

template <int D>
void NeighbourList::build(const ClusterSet& clusters, const ListRequest<D>& request) {
  int longest = 0;
  do {
    if (longest > slab_) slab_ = longest + longest / 4;
    reserve(clusters.size());
    const Lister<D> lister{clusters, request.x, request.source_x, request.h, request.source_h, request.source_rows,
                           request.factor * (1 + request.margin), view_, slab_};
    Kokkos::parallel_reduce(label_, balanced(clusters.size()), lister, Kokkos::Max<int>(longest));
  } while (longest > slab_);
}

double NeighbourList::mean_length(const ClusterSet& clusters) const {
  long sum = 0;
  const Field<int> length = view_.length;
  Kokkos::parallel_reduce("cellgrid::mean_length", Range(0, clusters.size()),
      KOKKOS_LAMBDA(int c, long& s) { s += length(c); }, sum);
  return clusters.size() > 0 ? static_cast<double>(sum) / clusters.size() : 0;
}

template <int D>
double NeighbourList::count_pairs(const ClusterSet& clusters, const ListRequest<D>& request) const {
  const ClusterSet sets = clusters;
  const NeighbourView near = view_;
  const VecField<double, D> x = request.x, source_x = request.source_x;
  const Field<double> h = request.h, source_h = request.source_h;
  const double factor = request.factor;
  double pairs = 0;
  Kokkos::parallel_reduce("cellgrid::pairs", Range(0, clusters.size()),
      KOKKOS_LAMBDA(int c, double& sum) {
        const Lanes me = sets(c);
        near.for_each(c, [&](int j) {
          for (int i = me.first; i < me.first + me.count; ++i) {
            const Vec<double, D> d = at(x, i) - at(source_x, j);
            const double reach = factor * larger(h(i), source_h(j));
            sum += dot(d, d) < reach * reach ? 1.0 : 0.0;
          }
        });
      },
      pairs);
  return pairs;
}

template double NeighbourList::count_pairs<1>(const ClusterSet&, const ListRequest<1>&) const;
template double NeighbourList::count_pairs<2>(const ClusterSet&, const ListRequest<2>&) const;
template void NeighbourList::build<1>(const ClusterSet&, const ListRequest<1>&);
template void NeighbourList::build<2>(const ClusterSet&, const ListRequest<2>&);

}  // namespace freshet
