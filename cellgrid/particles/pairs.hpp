// Pairs whose coefficients are stored (SELL-W): the W particles of a cluster are the lanes of a slice, and
// entry e of a slice holds one neighbour of each lane. Slices are cut row by row as clusters are, so a
// particle's slice hangs on its own row alone. Made once for particles at rest; matrix products and pair
// passes then stream through the entries. Short rows are padded with the particle itself: x_j - x_i = 0, so
// whatever vanishes with the distance needs no mask.
#pragma once
#include "cellgrid/parallel/launch.hpp"
#include "cellgrid/parallel/work.hpp"
#include "cellgrid/particles/clusters.hpp"

namespace freshet {

// The other particles of one entry, lane by lane: j, and the slot where its vector values stand. The slot is
// j itself, but for mirror images behind a wall: they have the scalars of j and reflected vectors in slots
// behind the particles.
struct PairIndex {
  LaneIndex j, slot;
};

KOKKOS_FORCEINLINE_FUNCTION Lane gather(const double* table, const PairIndex& index) {
  return gather(table, index.j);
}
KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 1> gather(const VecField<double, 1>& f, const PairIndex& index) {
  return {gather(f.x.data(), index.slot)};
}
KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 2> gather(const VecField<double, 2>& f, const PairIndex& index) {
  return {gather(f.x.data(), index.slot), gather(f.y.data(), index.slot)};
}

KOKKOS_FORCEINLINE_FUNCTION void prefetch(const void* address) {
#ifndef FRESHET_DEVICE
  __builtin_prefetch(address);
#else
  (void)address;
#endif
}

// As gather(), of indices in memory: eight loads put together take half the time of a gather (Zen 5).
KOKKOS_FORCEINLINE_FUNCTION Lane load_each(const double* table, const int* index) {
  return lanes_of<Lane>([&](int lane) { return table[index[lane]]; });
}

// The pairs as the device sees them. A coefficient is a Field with one value per entry and lane
// (Pairs::coefficient).
struct PairView {
  int particles = 0;
  ClusterSet clusters;  // the slices' particles
  Field<int> start;     // first entry of slice s; slices() + 1 values
  Field<int> j;         // neighbour of lane l in entry e at [e * lanes + l]
  Field<int> slot;      // where its vectors stand, likewise; the same field as j where there are no images

  KOKKOS_FORCEINLINE_FUNCTION int slices() const { return clusters.size(); }
  KOKKOS_FORCEINLINE_FUNCTION Lanes operator()(int slice) const { return clusters(slice); }
  KOKKOS_FORCEINLINE_FUNCTION static size_t at(int entry, int lane = 0) {
    return static_cast<size_t>(entry) * lanes + lane;
  }

  KOKKOS_FORCEINLINE_FUNCTION PairIndex neighbours(int entry) const {
    return {loaded<LaneIndex>(j.data() + at(entry)), loaded<LaneIndex>(slot.data() + at(entry))};
  }
  static KOKKOS_FORCEINLINE_FUNCTION Lane load(const Field<double>& coefficient, int entry) {
    return loaded<Lane>(coefficient.data() + at(entry));
  }
  static KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 1> load(const VecField<double, 1>& f, int entry) {
    return {load(f.x, entry)};
  }
  static KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 2> load(const VecField<double, 2>& f, int entry) {
    return {load(f.x, entry), load(f.y, entry)};
  }
  static KOKKOS_FORCEINLINE_FUNCTION void store(const Field<double>& coefficient, int entry, Lane value) {
    freshet::store(coefficient.data() + at(entry), value);
  }
  static KOKKOS_FORCEINLINE_FUNCTION void store(const VecField<double, 1>& f, int entry,
                                                const Vec<Lane, 1>& a) {
    store(f.x, entry, a.x);
  }
  static KOKKOS_FORCEINLINE_FUNCTION void store(const VecField<double, 2>& f, int entry,
                                                const Vec<Lane, 2>& a) {
    store(f.x, entry, a.x);
    store(f.y, entry, a.y);
  }

  // Calls pair(entry, j) for the entries of a slice.
  template <class Pair>
  KOKKOS_FORCEINLINE_FUNCTION void for_each(int slice, const Pair& pair) const {
    const int end = start(slice + 1);
    for (int e = start(slice); e < end; ++e) pair(e, neighbours(e));
  }

  // sum_j a_ij x_j per lane: the off-diagonal part of a matrix product. Padding must hold a = 0. Coefficients
  // and indices are asked for in time: the hardware does not look beyond the page.
  KOKKOS_FORCEINLINE_FUNCTION Lane weighted_sum(int slice, const Field<double>& a,
                                                const Field<double>& x) const {
    constexpr int ahead = 48;  // entries
    Lane sum(0.0);
    const int end = start(slice + 1);
    for (int e = start(slice); e < end; ++e) {
      prefetch(a.data() + at(e + ahead));
      prefetch(j.data() + at(e + ahead));
      sum += load(a, e) * load_each(x.data(), j.data() + at(e));
    }
    return sum;
  }
};

// A product y = d x - sum a x; per entry, padding included: the coefficient and the index are read once, x
// stays in the cache.
inline constexpr Cost matvec_cost{2, 2, 3};
inline constexpr double matvec_bytes_per_entry = 12;

// Of a pass over particles and entries, each with its coefficient and index.
inline Work work_of_entries(const Cost& cost, double particles, double entries) {
  Work work = work_of(cost, particles);
  work.listed = work.pairs = entries;
  work.flops += cost.pair_flops * entries;
  work.bytes += matvec_bytes_per_entry * entries;
  return work;
}

// What to pair: particles closer than factor (h_i + h_j) / 2.
template <int D>
struct PairRequest {
  const Rows& rows;       // their order, with the reach of their h measured
  VecField<double, D> x;  // m
  Field<double> h;        // m
  double factor;          // support / h
};

// Visits the neighbours of particle i within half (h_i + h_j) of it, i itself left out.
template <int D>
struct Nearby {
  Rows rows;
  VecField<double, D> x;
  Field<double> h;
  double half;  // of the support / h

  // A billionth beyond the support: lattices have pairs at just that distance, and rounding, which differs
  // from one pass's machine code to another's, would decide which of them are listed.
  explicit Nearby(const PairRequest<D>& request)
      : rows(request.rows), x(request.x), h(request.h), half((1 + 1e-9) * 0.5 * request.factor) {}

  template <class Put>
  KOKKOS_INLINE_FUNCTION void operator()(int i, const Put& put) const {
    const Vec<double, D> xi = at(x, i);
    double y = 0;
    if constexpr (D == 2) y = xi.y;
    const double most = rows.largest_h(xi.x, xi.x, y, y);
    rows.for_each_run(xi.x, xi.x, y, y, half * (h(i) + most), [&](int begin, int end) {
      for (int j = begin; j < end; ++j) {
        const Vec<double, D> d = at(x, j) - xi;
        const double limit = half * (h(i) + h(j));
        if (j != i && dot(d, d) < limit * limit) put(j, j);
      }
    });
  }
};

class Pairs {
 public:
  // Neighbours by distance, in the order of rows and bins.
  template <int D>
  void build(int particles, const PairRequest<D>& request);

  // visit(i, put) calls put(j, slot) for every neighbour of i, the same ones each time that it is asked.
  // rows: the particles' order. images: some slot is not j. Listing again keeps the room that there is; more
  // is made with some to spare.
  template <class Visit>
  void list(int particles, const Rows& rows, const Visit& visit, bool images = false);

  const PairView& view() const { return view_; }
  int entries() const { return entries_; }  // of all slices; a coefficient has lanes times as many values
  // A zero coefficient of every pair that there is room for.
  Field<double> coefficient(const std::string& label) const {
    return Field<double>(label, view_.j.extent(0));
  }
  template <int D>
  VecField<double, D> vector_coefficient(const std::string& label) const;

 private:
  PairView view_;
  int entries_ = 0;
};

// The first entry of each slice, in view.start; the longest row of a slice is its number of entries. Returns
// that of all slices. Free, as the next: nvcc takes no launch in a private member.
template <class Visit>
int place_slices(const PairView& view, const Visit& visit) {
  const int slices = view.slices();
  const Field<int> start = view.start;
  launch(
      "cellgrid::count_pairs", Range(0, slices), KOKKOS_LAMBDA(int s) {
        const Lanes me = view(s);
        int longest = 0;
        for (int l = 0; l < me.count; ++l) {
          int n = 0;
          visit(me.particle(l), [&](int, int) { ++n; });
          longest = larger(longest, n);
        }
        start(s) = longest;
      });
  Kokkos::parallel_scan(
      "cellgrid::place_slices", Range(0, slices + 1), KOKKOS_LAMBDA(int s, int& sum, bool last) {
        const int here = s < slices ? start(s) : 0;
        if (last) start(s) = sum;
        sum += here;
      });
  int entries = 0;
  Kokkos::deep_copy(entries, Kokkos::subview(start, slices));
  return entries;
}

template <class Visit>
void fill_pairs(const PairView& view, const Visit& visit) {
  launch(
      "cellgrid::fill_pairs", Range(0, view.slices()), KOKKOS_LAMBDA(int s) {
        const Lanes me = view(s);
        for (int l = 0; l < lanes; ++l) {
          const int i = me.particle(l);
          int e = view.start(s);
          const auto put = [&](int j, int slot) {
            view.slot(PairView::at(e, l)) = slot;
            view.j(PairView::at(e++, l)) = j;
          };
          if (l < me.count) visit(i, put);
          while (e < view.start(s + 1)) put(i, i);
        }
      });
}

template <class Visit>
void Pairs::list(int particles, const Rows& rows, const Visit& visit, bool images) {
  view_.particles = particles;
  view_.clusters.cut(rows);
  const int slices = view_.slices();
  if (view_.start.extent_int(0) <= slices)
    view_.start = Field<int>("cellgrid.pair_start", static_cast<size_t>(slices + slices / 8 + 1));
  entries_ = place_slices(view_, visit);
  const size_t held = view_.j.extent(0), wanted = PairView::at(entries_),
               room = held > 0 ? wanted + wanted / 4 : wanted;
  const auto indices = [](const char* label, size_t n) {
    return Field<int>(Kokkos::ViewAllocateWithoutInitializing(label), n);
  };
  const bool fits = wanted <= held && held > 0, had_images = view_.slot.data() != view_.j.data();
  if (!fits) view_.j = indices("cellgrid.pair_j", room);
  if (!images) view_.slot = view_.j;
  else if (!fits || !had_images) view_.slot = indices("cellgrid.pair_slot", view_.j.extent(0));
  fill_pairs(view_, visit);
}

}  // namespace freshet
