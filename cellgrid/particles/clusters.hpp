// The cluster list: W consecutive particles of one row are the lanes of a cluster; each cluster has one list
// of the particles j that any lane can feel, |x_i - x_j| < factor max(h_i, h_j) (1 + margin). With W = 1 it
// is an ordinary list.
#pragma once
#include "cellgrid/particles/order.hpp"
#include "cellgrid/simd/distance.hpp"
#include "cellgrid/simd/lanes.hpp"
#include "cellgrid/simd/vec.hpp"

namespace freshet {

// A row's last cluster, mostly: lane by lane in place these loads and stores were half of the machine code of
// all passes. Loads are a gather, since a call would keep what was loaded before in memory, also in the pair
// loop that follows.
KOKKOS_FORCEINLINE_FUNCTION LaneIndex partial_lanes(int count) {
  return smaller(lanes_of<LaneIndex>([](int lane) { return lane; }), LaneIndex(count - 1));
}
template <class V>
KOKKOS_FORCEINLINE_FUNCTION V load_partial(const double* from, int count) {
  return gather(from, partial_lanes(count));
}
template <class V>
FRESHET_OUT_OF_LINE KOKKOS_FUNCTION V load_partial(const int* from, int count) {
  return lanes_of<V>([&](int lane) { return from[lane < count ? lane : count - 1]; });
}
template <class V>
FRESHET_OUT_OF_LINE KOKKOS_FUNCTION void store_partial(double* to, int count, V value) {
  for_each_lane(value, [&](int lane, double one) {
    if (lane < count) to[lane] = one;
  });
}

// The particles first ... first + count - 1; a partial cluster repeats its last particle in the lanes beyond.
struct Lanes {
  int first, count;

  KOKKOS_FORCEINLINE_FUNCTION int particle(int lane) const {
    return first + (lane < count ? lane : count - 1);
  }

  KOKKOS_FORCEINLINE_FUNCTION Lane load(const Field<double>& f) const { return load<Lane>(f); }
  KOKKOS_FORCEINLINE_FUNCTION LaneIndex load(const Field<int>& f) const { return load<LaneIndex>(f); }
  KOKKOS_FORCEINLINE_FUNCTION void store(const Field<double>& f, Lane value) const {
    double* to = f.data() + first;
    if (count == lanes) freshet::store(to, value);
    else store_partial(to, count, value);
  }

  KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 1> load(const VecField<double, 1>& f) const { return {load(f.x)}; }
  KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 2> load(const VecField<double, 2>& f) const {
    return {load(f.x), load(f.y)};
  }
  KOKKOS_FORCEINLINE_FUNCTION Sym<Lane, 1> load(const SymField<double, 1>& f) const { return {load(f.xx)}; }
  KOKKOS_FORCEINLINE_FUNCTION Sym<Lane, 2> load(const SymField<double, 2>& f) const {
    return {load(f.xx), load(f.xy), load(f.yy)};
  }
  KOKKOS_FORCEINLINE_FUNCTION void store(const VecField<double, 1>& f, const Vec<Lane, 1>& a) const {
    store(f.x, a.x);
  }
  KOKKOS_FORCEINLINE_FUNCTION void store(const VecField<double, 2>& f, const Vec<Lane, 2>& a) const {
    store(f.x, a.x);
    store(f.y, a.y);
  }
  KOKKOS_FORCEINLINE_FUNCTION void store(const SymField<double, 1>& f, const Sym<Lane, 1>& a) const {
    store(f.xx, a.xx);
  }
  KOKKOS_FORCEINLINE_FUNCTION void store(const SymField<double, 2>& f, const Sym<Lane, 2>& a) const {
    store(f.xx, a.xx);
    store(f.xy, a.xy);
    store(f.yy, a.yy);
  }

 private:
  template <class V, class T>
  KOKKOS_FORCEINLINE_FUNCTION V load(const Field<T>& f) const {
    return count == lanes ? loaded<V>(f.data() + first) : load_partial<V>(f.data() + first, count);
  }
};

// Particles 0 ... n - 1 by lanes.
KOKKOS_FORCEINLINE_FUNCTION int blocks(int n) { return (n + lanes - 1) / lanes; }
KOKKOS_FORCEINLINE_FUNCTION Lanes block(int b, int n) { return {b * lanes, smaller(lanes, n - b * lanes)}; }

// Zero in lanes beyond the last particle.
KOKKOS_FORCEINLINE_FUNCTION Lane counted(const Lanes& me, Lane a) {
  return select(first_lanes(me.count), a, Lane(0.0));
}

// One value in every lane: the neighbour's side of a pair.
template <class V = Lane>
KOKKOS_FORCEINLINE_FUNCTION Vec<V, 1> broadcast(const Vec<double, 1>& a) {
  return {V(a.x)};
}
template <class V = Lane>
KOKKOS_FORCEINLINE_FUNCTION Vec<V, 2> broadcast(const Vec<double, 2>& a) {
  return {V(a.x), V(a.y)};
}
template <class V = Lane>
KOKKOS_FORCEINLINE_FUNCTION Sym<V, 1> broadcast(const SymField<double, 1>& f, int j) {
  return {V(f.xx(j))};
}
template <class V = Lane>
KOKKOS_FORCEINLINE_FUNCTION Sym<V, 2> broadcast(const SymField<double, 2>& f, int j) {
  return {V(f.xx(j)), V(f.xy(j)), V(f.yy(j))};
}

// All particles cut into clusters, row by row.
class ClusterSet {
 public:
  // later: how many lanes of each row's first cluster stay empty. What each particle gets does not hang on
  // it.
  void cut(const Rows& rows, int later = 0);
  KOKKOS_FORCEINLINE_FUNCTION int size() const { return size_; }
  KOKKOS_FORCEINLINE_FUNCTION Lanes operator()(int cluster) const {
    return {first_(cluster), count_(cluster)};
  }

 private:
  int size_ = 0;
  Field<int> first_, count_, row_start_;
};

// The lists as the device sees them.
struct NeighbourView {
  using Lists = Kokkos::View<int**, Kokkos::LayoutRight, Memory>;
  Field<int> length;
  Lists list;
  // Of each part of a cluster the places in its list of those that the part's lanes can feel, a third fewer:
  // row cluster * parts + part. Empty where packs are one register, nobody asked, or lists are longer than
  // places can say.
  using Place = std::uint8_t;
  Field<int> part_length;
  Kokkos::View<Place**, Kokkos::LayoutRight, Memory> part_place;

  KOKKOS_FORCEINLINE_FUNCTION NearList of(int cluster) const {
    return {&list(cluster, 0), nullptr, length(cluster)};
  }
  KOKKOS_FORCEINLINE_FUNCTION NearList of(int cluster, int part) const {
    if (parts_of_cluster == 1 || part_length.extent(0) == 0) return of(cluster);
    const int row = cluster * parts_of_cluster + part;
    return {&list(cluster, 0), &part_place(row, 0), part_length(row)};
  }

  template <class Pair>
  KOKKOS_FORCEINLINE_FUNCTION void for_each(int cluster, const Pair& pair) const {
    const int n = length(cluster);
    const int* j = &list(cluster, 0);
    for (int k = 0; k < n; ++k) pair(j[k]);
  }
};

// What to list: sources near targets.
template <int D>
struct ListRequest {
  VecField<double, D> x;         // targets' positions [m], cut into clusters
  Field<double> h;               // targets' smoothing length [m]
  const Rows& source_rows;       // the sources' order
  VecField<double, D> source_x;  // m
  Field<double> source_h;        // m
  double factor = 2.0;           // support / h
  double margin = 0.05;          // relative growth of h that the list still covers
};

// 2-D; a candidate costs 9 operations in each lane, and 1.7 are looked at for one that is listed (water on a
// lattice).
inline constexpr Cost list_cost{15.5, 4, 3};

class NeighbourList {
 public:
  // by_parts: lists of the parts of clusters too, where packs are several registers.
  explicit NeighbourList(int slab = 96, const char* label = "cellgrid::list", bool by_parts = true)
      : slab_(slab), label_(label), by_parts_(by_parts && parts_of_cluster > 1) {}

  // Lists every cluster's neighbours (a particle is its own neighbour). Slabs grow when a list overflows: no
  // pair is lost.
  template <int D>
  void build(const ClusterSet& clusters, const ListRequest<D>& request);

  // Pairs within max(h_i, h_j) factor, of those that the list holds; a particle's pair with itself is one.
  template <int D>
  double count_pairs(const ClusterSet& clusters, const ListRequest<D>& request) const;

  const NeighbourView& view() const { return view_; }
  double mean_length(const ClusterSet& clusters) const;

 private:
  void reserve(int clusters);
  bool lists_parts() const { return by_parts_ && slab_ < 256; }  // NeighbourView::Place
  int slab_;
  const char* label_;  // of the launch
  bool by_parts_;
  NeighbourView view_;
};

}  // namespace freshet
