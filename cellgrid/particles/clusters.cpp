#include "cellgrid/particles/clusters.hpp"

#include <type_traits>

#include "cellgrid/parallel/launch.hpp"
#include "cellgrid/simd/box.hpp"

namespace freshet {

void ClusterSet::cut(const Rows& rows, int later) {
  if (row_start_.extent_int(0) < rows.rows + 1)
    row_start_ = Field<int>("cellgrid.row_start", static_cast<size_t>(2 * rows.rows + 16));
  const Field<int> row_start = row_start_;
  const Rows r = rows;
  Kokkos::parallel_scan(
      "cellgrid::count_clusters", Range(0, rows.rows + 1), KOKKOS_LAMBDA(int row, int& sum, bool last) {
        if (last) row_start(row) = sum;
        if (row == r.rows) return;
        const int held = r.row_begin(row + 1) - r.row_begin(row);
        sum += held > 0 ? blocks(later + held) : 0;
      });
  Kokkos::deep_copy(size_, Kokkos::subview(row_start_, rows.rows));
  if (first_.extent_int(0) < size_) {
    const size_t room = static_cast<size_t>(size_ + size_ / 4 + 16);
    first_ = Field<int>("cellgrid.cluster_first", room);
    count_ = Field<int>("cellgrid.cluster_count", room);
  }
  const Field<int> first = first_, count = count_;
  launch(
      "cellgrid::cut_clusters", Range(0, rows.rows), KOKKOS_LAMBDA(int row) {
        const int begin = r.row_begin(row), end = r.row_begin(row + 1);
        if (begin == end) return;
        int c = row_start(row);
        for (int i = begin - later; i < end; i += lanes, ++c) {
          first(c) = larger(i, begin);
          count(c) = smaller(i + lanes, end) - first(c);
        }
      });
}

namespace {

// The sources' numbers as plain addresses.
template <int D>
struct Sources {
  const double *x0, *x1, *h;
  KOKKOS_FORCEINLINE_FUNCTION Sources(const VecField<double, D>& x, const Field<double>& h_of)
      : x0(x.x.data()), x1(x0), h(h_of.data()) {
    if constexpr (D == 2) x1 = x.y.data();
  }
  KOKKOS_FORCEINLINE_FUNCTION Vec<double, D> x(int j) const {
    if constexpr (D == 1) return {x0[j]};
    else return {x0[j], x1[j]};
  }
};

// What a cluster's list holds so far; of its parts the places in it.
struct Listed {
  int* j;
  NeighbourView::Place* place[parts_of_cluster];
  int n, of_part[parts_of_cluster];
};

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
  bool by_parts;

  KOKKOS_FORCEINLINE_FUNCTION Listed listed_in(int c) const {
    Listed listed{&out.list(c, 0), {}, 0, {}};
    if (by_parts)
      for (int part = 0; part < parts_of_cluster; ++part)
        listed.place[part] = &out.part_place(c * parts_of_cluster + part, 0);
    return listed;
  }

  // With the sources begin ... end - 1. All by value: places are bytes, and what is written as bytes might be
  // anything in memory.
  KOKKOS_FORCEINLINE_FUNCTION Listed add(Listed to, const Vec<Lane, D> xi, const Lane reach_i, int begin,
                                         int end) const {
    const Sources<D> there(source_x, source_h);
    const double far = reach;
    const int room = slab;
    const bool of_parts = by_parts;
    const auto near = [&](int j, int fits) FRESHET_INLINE_LAMBDA {
      const Vec<Lane, D> d = xi - broadcast(there.x(j));
      const Lane limit = larger(reach_i, Lane(far) * Lane(there.h[j]));
      const auto felt = dot(d, d) < limit * limit;
      if constexpr (parts_of_cluster == 2)
        if (of_parts) {
          const bool first = any(felt.low), second = any(felt.high);
          to.place[0][to.of_part[0]] = to.place[1][to.of_part[1]] = static_cast<NeighbourView::Place>(to.n);
          to.of_part[0] += fits & (first ? 1 : 0), to.of_part[1] += fits & (second ? 1 : 0);
          return first || second;
        }
      return any(felt);
    };
    int j = begin;
    for (const int sure = smaller(end, begin + room - to.n); j < sure;
         ++j) {  // these fit in, even if all are near
      to.j[to.n] = j;
      to.n += near(j, 1);
    }
    for (; j < end; ++j) {
      to.j[smaller(to.n, room)] = j;  // the slab's last entry takes the overflow
      to.n += near(j, to.n < room ? 1 : 0);
    }
    return to;
  }

  KOKKOS_INLINE_FUNCTION void operator()(int c, int& longest) const {
    const Lanes me = clusters(c);
    const Vec<Lane, D> xi = me.load(x);
    const Lane reach_i = reach * me.load(h);
    const Box b = box_of(xi);
    const double mine = largest(reach_i), theirs = sources.largest_h(b.xlo, b.xhi, b.ylo, b.yhi);
    if (theirs == 0 &&
        mine < sources.support) {  // no source within a tile (each has an h of its own, be it tiny)
      out.length(c) = 0;
      if (by_parts)
        for (int part = 0; part < parts_of_cluster; ++part) out.part_length(c * parts_of_cluster + part) = 0;
      return;
    }
    const double far = larger(mine, reach * theirs);
    Listed listed = listed_in(c);
    sources.for_each_run(b.xlo, b.xhi, b.ylo, b.yhi, far,
                         [&](int begin, int end) { listed = add(listed, xi, reach_i, begin, end); });
    const int n = listed.n;
    out.length(c) = smaller(n, slab);
    if (by_parts)
      for (int part = 0; part < parts_of_cluster; ++part)
        out.part_length(c * parts_of_cluster + part) = listed.of_part[part];
    longest = larger(longest, n);
  }
};

}  // namespace

void NeighbourList::reserve(int clusters) {
  if (view_.length.extent_int(0) >= clusters && view_.list.extent_int(1) > slab_) return;
  const size_t room = static_cast<size_t>(larger(clusters + clusters / 8, 16));
  view_.length = Field<int>("cellgrid.list_length", room);
  view_.list = {};
  const size_t width = static_cast<size_t>(slab_ + 1);
  view_.list = NeighbourView::Lists(Kokkos::ViewAllocateWithoutInitializing("cellgrid.list"), room, width);
  view_.part_length = {}, view_.part_place = {};
  if (!lists_parts()) return;
  view_.part_length = Field<int>("cellgrid.part_length", parts_of_cluster * room);
  view_.part_place = decltype(view_.part_place)(
      Kokkos::ViewAllocateWithoutInitializing("cellgrid.part_place"), parts_of_cluster * room, width);
}

template <int D>
void NeighbourList::build(const ClusterSet& clusters, const ListRequest<D>& request) {
  int longest = 0;
  do {
    if (longest > slab_) slab_ = longest + longest / 4;
    reserve(clusters.size());
    const Lister<D> lister{clusters,
                           request.x,
                           request.source_x,
                           request.h,
                           request.source_h,
                           request.source_rows,
                           request.factor * (1 + request.margin),
                           view_,
                           slab_,
                           lists_parts()};
    Kokkos::parallel_reduce(label_, balanced(clusters.size()), lister, Kokkos::Max<int>(longest));
  } while (longest > slab_);
}

double NeighbourList::mean_length(const ClusterSet& clusters) const {
  long sum = 0;
  const Field<int> length = view_.length;
  Kokkos::parallel_reduce(
      "cellgrid::mean_length", Range(0, clusters.size()), KOKKOS_LAMBDA(int c, long& s) { s += length(c); },
      sum);
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
  Kokkos::parallel_reduce(
      "cellgrid::pairs", Range(0, clusters.size()),
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
