// The cluster list: W consecutive particles of one row are the lanes of a cluster; each cluster has one list of the
// particles j that any lane can feel, |x_i - x_j| < factor max(h_i, h_j) (1 + margin). With W = 1 it is an ordinary list.
#pragma once
#include "cellgrid/order.hpp"
#include "cellgrid/pack.hpp"
#include "cellgrid/vec.hpp"

namespace freshet {

// The particles first ... first + count - 1; a partial cluster repeats its last particle in the lanes beyond.
struct Lanes {
  int first, count;

  KOKKOS_FORCEINLINE_FUNCTION int particle(int lane) const { return first + (lane < count ? lane : count - 1); }

  KOKKOS_FORCEINLINE_FUNCTION Lane load(const Field<double>& f) const {
    Lane value;
#if defined(KOKKOS_ENABLE_CUDA) || defined(KOKKOS_ENABLE_HIP) || defined(FRESHET_SCALAR)
    value = f(first);
#else
    if (count == lanes)
      __builtin_memcpy(&value, f.data() + first, sizeof(value));
    else
      for (int l = 0; l < lanes; ++l) value.set(l, f(particle(l)));
#endif
    return value;
  }

  KOKKOS_FORCEINLINE_FUNCTION LaneIndex load(const Field<int>& f) const {
    LaneIndex value;
#if defined(KOKKOS_ENABLE_CUDA) || defined(KOKKOS_ENABLE_HIP) || defined(FRESHET_SCALAR)
    value = f(first);
#else
    if (count == lanes)
      __builtin_memcpy(&value, f.data() + first, sizeof(value));
    else
      for (int l = 0; l < lanes; ++l) value.set(l, f(particle(l)));
#endif
    return value;
  }

  KOKKOS_FORCEINLINE_FUNCTION void store(const Field<double>& f, Lane value) const {
#if defined(KOKKOS_ENABLE_CUDA) || defined(KOKKOS_ENABLE_HIP) || defined(FRESHET_SCALAR)
    f(first) = value;
#else
    if (count == lanes)
      __builtin_memcpy(f.data() + first, &value, sizeof(value));
    else
      for (int l = 0; l < count; ++l) f(first + l) = value[l];
#endif
  }

  KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 1> load(const VecField<double, 1>& f) const { return {load(f.x)}; }
  KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 2> load(const VecField<double, 2>& f) const { return {load(f.x), load(f.y)}; }
  KOKKOS_FORCEINLINE_FUNCTION Sym<Lane, 1> load(const SymField<double, 1>& f) const { return {load(f.xx)}; }
  KOKKOS_FORCEINLINE_FUNCTION Sym<Lane, 2> load(const SymField<double, 2>& f) const {
    return {load(f.xx), load(f.xy), load(f.yy)};
  }
  KOKKOS_FORCEINLINE_FUNCTION void store(const VecField<double, 1>& f, const Vec<Lane, 1>& a) const { store(f.x, a.x); }
  KOKKOS_FORCEINLINE_FUNCTION void store(const VecField<double, 2>& f, const Vec<Lane, 2>& a) const {
    store(f.x, a.x);
    store(f.y, a.y);
  }
  KOKKOS_FORCEINLINE_FUNCTION void store(const SymField<double, 1>& f, const Sym<Lane, 1>& a) const { store(f.xx, a.xx); }
  KOKKOS_FORCEINLINE_FUNCTION void store(const SymField<double, 2>& f, const Sym<Lane, 2>& a) const {
    store(f.xx, a.xx);
    store(f.xy, a.xy);
    store(f.yy, a.yy);
  }
};

// One value in every lane: the neighbour's side of a pair.
KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 1> broadcast(const Vec<double, 1>& a) { return {Lane(a.x)}; }
KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 2> broadcast(const Vec<double, 2>& a) { return {Lane(a.x), Lane(a.y)}; }
KOKKOS_FORCEINLINE_FUNCTION Sym<Lane, 1> broadcast(const SymField<double, 1>& f, int j) { return {Lane(f.xx(j))}; }
KOKKOS_FORCEINLINE_FUNCTION Sym<Lane, 2> broadcast(const SymField<double, 2>& f, int j) {
  return {Lane(f.xx(j)), Lane(f.xy(j)), Lane(f.yy(j))};
}

// All particles cut into clusters, row by row.
class ClusterSet {
 public:
  void cut(const Rows& rows);
  int size() const { return size_; }
  KOKKOS_FORCEINLINE_FUNCTION Lanes operator()(int cluster) const { return {first_(cluster), count_(cluster)}; }

 private:
  int size_ = 0;
  Field<int> first_, count_, row_start_;
};

// The lists as the device sees them.
struct NeighbourView {
  Field<int> length;
  Kokkos::View<int**, Kokkos::LayoutRight, Memory> list;

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

// 2-D; a candidate costs 9 operations in each lane, and 1.7 are looked at for one that is listed (water on a lattice).
inline constexpr Cost list_cost{15.5, 4, 3};

class NeighbourList {
 public:
  explicit NeighbourList(int slab = 96, const char* label = "cellgrid::list") : slab_(slab), label_(label) {}

  // Lists every cluster's neighbours (a particle is its own neighbour). Slabs grow when a list overflows: no pair is lost.
  template <int D>
  void build(const ClusterSet& clusters, const ListRequest<D>& request);

  // Pairs within max(h_i, h_j) factor, of those that the list holds; a particle's pair with itself is one.
  template <int D>
  double count_pairs(const ClusterSet& clusters, const ListRequest<D>& request) const;

  const NeighbourView& view() const { return view_; }
  double mean_length(const ClusterSet& clusters) const;

 private:
  void reserve(int clusters);
  int slab_;
  const char* label_;  // of the launch
  NeighbourView view_;
};

}  // namespace freshet
