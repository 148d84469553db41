// A sparse matrix with ones on its diagonal, stored beside a cluster list: entry [start(c) + k][lane] couples
// the lane's row with the column of cluster c's k-th neighbour (zero where that is no neighbour of the row).
// No gathers: columns are broadcast to the lanes. For preconditioners there is a rough copy in a quarter of
// the memory: whole multiples of the row's unit, its largest entry / 32767. Its diagonal takes up what
// rounding changed in the sum of the row, so that it acts on differences alone as the matrix does.
#pragma once
#include <cstdint>

#include "cellgrid/parallel/huge_pages.hpp"
#include "cellgrid/parallel/launch.hpp"
#include "cellgrid/particles/clusters.hpp"

namespace freshet::linear {

// Lanes of whole numbers of 16 bits.
#ifdef FRESHET_ONE_LANE
KOKKOS_FORCEINLINE_FUNCTION Lane load_short(const std::int16_t* from) { return *from; }
KOKKOS_FORCEINLINE_FUNCTION void store_short(std::int16_t* to, LaneIndex value) {
  *to = static_cast<std::int16_t>(value);
}
#else
using Shorts = pack<std::int16_t, lanes>;
KOKKOS_FORCEINLINE_FUNCTION Lane load_short(const std::int16_t* from) {
  return to_real(convert<int>(loaded<Shorts>(from)));
}
KOKKOS_FORCEINLINE_FUNCTION void store_short(std::int16_t* to, LaneIndex value) {
  store(to, convert<std::int16_t>(value));
}
#endif

struct ClusterMatrix {
  ClusterSet clusters;
  NeighbourView near;  // columns
  Field<int> start;    // of each cluster: the lengths of the lists before it
  Kokkos::View<double* [lanes], Kokkos::LayoutRight, Memory> a;  // off the diagonal
  Kokkos::View<std::int16_t* [lanes], Kokkos::LayoutRight, Memory> rough;
  Field<double> unit, rough_diagonal;  // of each row
  int rows = 0;

 private:
  KOKKOS_FORCEINLINE_FUNCTION auto exact(int c) const {
    return [from = &a(start(c), 0)](int k) { return loaded<Lane>(from + k * lanes); };
  }

  template <class Sum, class Entry, class Value>
  KOKKOS_FORCEINLINE_FUNCTION Sum sum(int c, const Sum& nothing, const Entry& entry_at,
                                      const Value& value_of) const {
    const int n = near.length(c);
    const int* j = &near.list(c, 0);
    Sum even = nothing, odd = nothing;  // two chains: a multiply-add takes four cycles
    int k = 0;
    for (; k + 1 < n; k += 2) {
      even += entry_at(k) * value_of(j[k]);
      odd += entry_at(k + 1) * value_of(j[k + 1]);
    }
    if (k < n) even += entry_at(k) * value_of(j[k]);
    return even + odd;
  }

 public:
  // Room for the entries beside these lists.
  void lay_out(const ClusterSet& of, const NeighbourView& columns, int points) {
    clusters = of;
    near = columns;
    rows = points;
    const int n = clusters.size();
    if (start.extent_int(0) < n) start = Field<int>("matrix.start", static_cast<size_t>(n + n / 4));
    const Field<int> first = start, length = near.length;
    int entries = 0;
    Kokkos::parallel_scan(
        "linear::lay_out", Range(0, n),
        KOKKOS_LAMBDA(int c, int& sum, bool last) {
          if (last) first(c) = sum;
          sum += length(c);
        },
        entries);
    if (a.extent_int(0) >= entries) return;
    a = {};
    a = decltype(a)(Kokkos::ViewAllocateWithoutInitializing("matrix.entries"),
                    static_cast<size_t>(entries) + static_cast<size_t>(entries) / 8);
    prefer_huge_pages(a);
  }
  // Room for the rough copy too.
  void lay_out_rough() {
    for (Field<double>* f : {&unit, &rough_diagonal})
      if (f->extent_int(0) < rows + lanes)
        *f = Field<double>("matrix.rows", static_cast<size_t>(rows + rows / 4 + lanes));
    if (rough.extent(0) >= a.extent(0)) return;
    rough = {};
    rough = decltype(rough)(Kokkos::ViewAllocateWithoutInitializing("matrix.rough"), a.extent(0));
    prefer_huge_pages(rough);
  }

  KOKKOS_FORCEINLINE_FUNCTION Lane entry(int c, int k) const { return loaded<Lane>(&a(start(c) + k, 0)); }
  KOKKOS_FORCEINLINE_FUNCTION void set(int c, int k, Lane value) const { store(&a(start(c) + k, 0), value); }

  // Makes the rough copy of a cluster whose entries are set.
  KOKKOS_INLINE_FUNCTION void round(int c) const {
    const int n = near.length(c);
    Lane most(1e-300), lost{0.0};
    for (int k = 0; k < n; ++k) most = larger(most, larger(entry(c, k), -entry(c, k)));
    const Lane step = (1.0 / 32767) * most, per_step = 32767.0 / most;
    for (int k = 0; k < n; ++k) {
      // cut where positive: rounded
      const LaneIndex whole = to_index(entry(c, k) * per_step + Lane(32768.5)) - LaneIndex(32768);
      store_short(&rough(start(c) + k, 0), whole);
      lost += entry(c, k) - step * to_real(whole);
    }
    clusters(c).store(unit, step);
    clusters(c).store(rough_diagonal, Lane(1.0) + lost);
  }

  // The cluster's rows of A x without the diagonal; x: one field, or one of vectors.
  KOKKOS_FORCEINLINE_FUNCTION Lane off_diagonal(int c, const Field<double>& x) const {
    return sum(c, Lane(0.0), exact(c), [&](int j) { return Lane(x(j)); });
  }
  KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 2> off_diagonal(int c, const VecField<double, 2>& x) const {
    return sum(c, Vec<Lane, 2>{}, exact(c), [&](int j) { return broadcast(at(x, j)); });
  }
  // The cluster's rows of the rough copy's product.
  KOKKOS_FORCEINLINE_FUNCTION Lane times_rough(int c, const Field<double>& x) const {
    const Lanes me = clusters(c);
    const std::int16_t* from = &rough(start(c), 0);
    const auto entry_at = [from](int k) { return load_short(from + k * lanes); };
    return me.load(rough_diagonal) * me.load(x) +
           me.load(unit) * sum(c, Lane(0.0), entry_at, [&](int j) { return Lane(x(j)); });
  }

  // y := A x
  void multiply(const Field<double>& x, const Field<double>& y) const {
    const ClusterMatrix m = *this;
    launch(
        "linear::multiply", Range(0, clusters.size()), KOKKOS_LAMBDA(int c) {
          const Lanes me = m.clusters(c);
          me.store(y, me.load(x) + m.off_diagonal(c, x));
        });
  }
  // Of one product: each entry and each index of a list once. Counted on the host: for measurements.
  Work work() const {
    const auto length = on_host(near.length);
    double entries = 0;
    for (int c = 0; c < clusters.size(); ++c) entries += lanes * length(c);
    const double values = static_cast<double>(sizeof(double)) * entries;
    Work product = work_of({2, 1, 2}, rows, 0, entries, lanes);
    product.bytes += values;
    return product;
  }
};

}  // namespace freshet::linear
