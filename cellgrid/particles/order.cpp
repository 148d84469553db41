#include "cellgrid/particles/order.hpp"

#include <algorithm>
#include <cmath>

#include "cellgrid/parallel/launch.hpp"
#include "cellgrid/parallel/runtime.hpp"
#include "cellgrid/particles/clusters.hpp"

namespace freshet {
namespace {

// The particles' bounding box; without y its y is zero.
struct Extent {
  double xlo = 0, xhi = 0, ylo = 0, yhi = 0;  // m
};

// Of a chunk of particles, lane by lane; what is dropped or not finite does not count.
struct ChunkExtent {
  static constexpr int chunk = 1024;
  Field<double> x, y;
  Field<int> id;
  int n;
  bool plane;

  KOKKOS_INLINE_FUNCTION void operator()(int c, double& xlo, double& xhi, double& ylo, double& yhi) const {
    const Lane far = 1e300;
    Lane low_x = far, high_x = -far, low_y = far, high_y = -far;
    const int end = smaller((c + 1) * chunk, n);
    for (int first = c * chunk; first < end; first += lanes) {
      const Lanes me{first, smaller(lanes, end - first)};
      const Lane px = me.load(x), py = plane ? me.load(y) : Lane(0.0);
      const auto counts =
          (Lane(-0.5) < to_real(me.load(id))) & (-far < px) & (px < far) & (-far < py) & (py < far);
      low_x = select(counts, smaller(low_x, px), low_x), high_x = select(counts, larger(high_x, px), high_x);
      low_y = select(counts, smaller(low_y, py), low_y), high_y = select(counts, larger(high_y, py), high_y);
    }
    xlo = smaller(xlo, smallest(low_x)), xhi = larger(xhi, largest(high_x));
    ylo = smaller(ylo, smallest(low_y)), yhi = larger(yhi, largest(high_y));
  }
};

Extent extent_of(const Field<double>& x, const Field<double>& y, const Field<int>& id, int n) {
  Extent e;
  Kokkos::parallel_reduce("cellgrid::extent", Range(0, (n + ChunkExtent::chunk - 1) / ChunkExtent::chunk),
                          ChunkExtent{x, y, id, n, y.extent(0) > 0}, Kokkos::Min<double>(e.xlo),
                          Kokkos::Max<double>(e.xhi), Kokkos::Min<double>(e.ylo), Kokkos::Max<double>(e.yhi));
  return e.xlo <= e.xhi ? e : Extent{};
}

// The key of each of a few particles: block times bins plus the bin within it; -1 for those that are dropped.
struct Keys {
  Rows rows;
  Field<double> x, y;
  Field<int> id;
  bool plane;

  static KOKKOS_FORCEINLINE_FUNCTION LaneIndex cell(Lane c, int first, int n) {
    const Lane low(static_cast<double>(first)), high(static_cast<double>(first + n - 1));
    return to_index(select(c < high, larger(c, low), high)) - first;
  }
  KOKKOS_FORCEINLINE_FUNCTION LaneIndex operator()(const Lanes& me) const {
    const LaneIndex bin = cell((me.load(x) - rows.x_origin) * rows.per_bin_width, rows.first_bin, rows.bins);
    const LaneIndex row =
        plane ? cell((me.load(y) - rows.y_origin) * rows.per_row_height, rows.first_row, rows.rows)
              : LaneIndex(0);
    const Lane key = to_real(row * (rows.columns * Rows::block_bins) + bin);
    return to_index(select(Lane(-0.5) < to_real(me.load(id)), key, Lane(-1.0)));
  }
};

// Threads count in tables of their own: an atomic takes ten times as long as an addition. Of more threads, or
// where most cells are empty, the tables would cost more; of 4e8 cells they would have more counters than an
// int has numbers.
int tables_for(int cells, int n) {
  const int threads = thread_count();
  return threads > 4 || cells / 4 > n || cells > 400000000 ? 1 : threads == 3 ? 4 : threads;
}

// Counts a particle in its cell; its key becomes that counter, its slot the number of those before it there.
struct Count {
  Field<int> key, slot, start, block;
  int cells;

  KOKKOS_FORCEINLINE_FUNCTION int cell(int i) const {
    const int k = key(i);
    return k < 0 ? cells : block(k / Rows::block_bins) + k % Rows::block_bins;
  }
  KOKKOS_FORCEINLINE_FUNCTION void alone(int i, int table) const {
    const int counter = table + cell(i);
    key(i) = counter;
    slot(i) = start(counter)++;
  }
  KOKKOS_FORCEINLINE_FUNCTION void shared(int i) const {
    const int counter = cell(i);
    key(i) = counter;
    slot(i) = Kokkos::atomic_fetch_add(&start(counter), 1);
  }
};

// From the numbers in each cell, table by table, to the place of the first of them; those of table 0 are the
// cells' own.
template <int tables>
void set_places(const Field<int>& start, int stride) {
  Kokkos::parallel_scan(
      "cellgrid::scan", Range(0, stride), KOKKOS_LAMBDA(int c, int& sum, bool last) {
        int next = sum;
        for (int t = 0; t < tables; ++t) {
          const int here = start(t * stride + c);
          if (last) start(t * stride + c) = next;
          next += here;
        }
        sum = next;
      });
}

// Cells of a width that cover a length; a period's own rounding makes no further one.
int cells(double length, double width) {
  return std::max(static_cast<int>(std::ceil(length / width - 1e-9)), 1);
}

// Restores the order by id within one bin; bins hold about one particle, but clustered input may fill them.
KOKKOS_INLINE_FUNCTION void sort_by_id(int* order, int n, const int* id) {
  for (int gap = n > 32 ? n / 2 : 1; gap > 0; gap /= 2)  // Shell's sort: insertion for the common case
    for (int i = gap; i < n; ++i) {
      const int moved = order[i];
      int k = i;
      for (; k >= gap && id[order[k - gap]] > id[moved]; k -= gap) order[k] = order[k - gap];
      order[k] = moved;
    }
}

// A run of neighbouring blocks: over dry land its loops are a load and a store of a vector.
struct Blocks {
  static constexpr int run = 64;
  Field<int> mark, block;
  int first, end;

  KOKKOS_FORCEINLINE_FUNCTION int kept() const {
    int sum = 0;
    for (int k = first; k < end; ++k) sum += mark(k);
    return sum;
  }

  // Their first cells from `cell` on; clears the marks.
  KOKKOS_FORCEINLINE_FUNCTION void number(int cell, int kept) const {
    if (kept == 0) {
      for (int k = first; k < end; ++k) block(k) = cell;
      return;
    }
    for (int k = first; k < end; ++k) {
      block(k) = cell;
      cell += mark(k) * Rows::block_bins;
      mark(k) = 0;
    }
  }
};

}  // namespace

RowOrder::RowOrder(int dimension, double spacing, const Box& domain)
    : dimension_(dimension), spacing_(spacing) {
  constexpr double most = 3e7;  // blocks of the whole domain: what a stray particle may make of the window
  const double width = domain.xhi - domain.xlo, height = dimension == 2 ? domain.yhi - domain.ylo : 0;
  rows_.x_origin = domain.xlo;
  rows_.y_origin = dimension == 2 ? domain.ylo : 0;
  rows_.row_height = 2 * spacing;
  rows_.bin_width = 0.5 * spacing;
  while (height / rows_.row_height > most) rows_.row_height *= 2;
  domain_rows_ = cells(height, rows_.row_height);
  while (width / (Rows::block_bins * rows_.bin_width) * domain_rows_ > most) rows_.bin_width *= 2;
  domain_bins_ = cells(width, rows_.bin_width);
  rows_.per_row_height = 1 / rows_.row_height;
  rows_.per_bin_width = 1 / rows_.bin_width;
}

// The window begins at a whole square of bins, so that what is built on those is fixed in space too.
void RowOrder::lay_window(const FieldSet& particles) {
  const Extent e = extent_of(x_, y_, id_, particles.size());
  const auto bin = [&](double x) {
    return Rows::cell((x - rows_.x_origin) * rows_.per_bin_width, 0, domain_bins_);
  };
  const auto row = [&](double y) {
    return Rows::cell((y - rows_.y_origin) * rows_.per_row_height, 0, domain_rows_);
  };
  const int square = std::max(1, static_cast<int>(std::lround(rows_.row_height / rows_.bin_width)));
  rows_.first_bin = bin(e.xlo) / square * square;
  rows_.first_row = row(e.ylo);
  rows_.bins = bin(e.xhi) - rows_.first_bin + 1;
  rows_.rows = row(e.yhi) - rows_.first_row + 1;
  rows_.x0 = rows_.x_origin + rows_.first_bin * rows_.bin_width;
  rows_.y0 = rows_.y_origin + rows_.first_row * rows_.row_height;
  rows_.columns = (rows_.bins - 1) / Rows::block_bins + 1;
}

// Which blocks hold particles; returns how many cells they have. Keys: block and bin within it, -1 = to be
// dropped.
int RowOrder::keep_blocks(const FieldSet& particles) {
  const int n = particles.size(), blocks = rows_.rows * rows_.columns;
  if (mark_.extent_int(0) < blocks + 1)
    mark_ = Field<int>("cellgrid.mark", static_cast<size_t>(blocks + blocks / 2 + 256));
  reserve(rows_.block, "cellgrid.block", blocks + 1);
  reserve(key_, "cellgrid.key", n);
  const Field<int> key = key_, mark = mark_, block = rows_.block;
  const Keys keys{rows_, x_, y_, id_, dimension_ == 2};
  launch(
      "cellgrid::mark", Range(0, freshet::blocks(n)), KOKKOS_LAMBDA(int b) {
        const Lanes me = freshet::block(b, n);
        for_each_lane(keys(me), [&](int lane, int k) {
          if (lane >= me.count) return;
          key(me.first + lane) = k;
          if (k >= 0 && mark(k / Rows::block_bins) == 0) mark(k / Rows::block_bins) = 1;
        });
      });
  Kokkos::parallel_scan(
      "cellgrid::keep", Range(0, blocks / Blocks::run + 1), KOKKOS_LAMBDA(int run, int& sum, bool last) {
        const Blocks here{mark, block, run * Blocks::run, smaller((run + 1) * Blocks::run, blocks + 1)};
        const int kept = here.kept();
        if (last) here.number(sum, kept);
        sum += kept * Rows::block_bins;
      });
  int kept_cells = 0;
  Kokkos::deep_copy(kept_cells, Kokkos::subview(rows_.block, blocks));
  return kept_cells;
}

void RowOrder::count_bins(const FieldSet& particles, int cells) {
  const int n = particles.size(), tables = tables_for(cells, n), stride = cells + 2;
  const bool shared = tables < thread_count();
  reserve(rows_.start, "cellgrid.start", tables * stride);
  reserve(slot_, "cellgrid.slot", n);
  const Field<int> start = rows_.start;
  const Count count{key_, slot_, start, rows_.block, cells};
  launch(
      "cellgrid::clear", Range(0, tables * stride), KOKKOS_LAMBDA(int c) { start(c) = 0; });
  if (shared)
    launch(
        "cellgrid::count", Range(0, n), KOKKOS_LAMBDA(int i) { count.shared(i); });
  else
    launch(
        "cellgrid::count", Range(0, tables), KOKKOS_LAMBDA(int t) {
          const long per = (static_cast<long>(n) + tables - 1) / tables,
                     end = smaller((t + 1) * per, static_cast<long>(n));
          for (long i = t * per; i < end; ++i) count.alone(static_cast<int>(i), t * stride);
        });
  tables == 1   ? set_places<1>(start, stride)
  : tables == 2 ? set_places<2>(start, stride)
                : set_places<4>(start, stride);
}

void RowOrder::place(const FieldSet& particles, int cells) {
  const int n = particles.size();
  reserve(order_, "cellgrid.order", n);
  const Field<int> key = key_, slot = slot_, start = rows_.start, order = order_, id = id_;
  launch(
      "cellgrid::place", Range(0, n), KOKKOS_LAMBDA(int i) { order(start(key(i)) + slot(i)) = i; });
  launch(
      "cellgrid::settle", Range(0, cells), KOKKOS_LAMBDA(int c) {
        const int first = start(c), in_bin = start(c + 1) - first;
        if (in_bin > 1) sort_by_id(&order(first), in_bin, id.data());
      });
}

void RowOrder::sort(FieldSet& particles) {
  const TimedRegion region("cellgrid::sort");
  x_ = particles.real("x");
  y_ = dimension_ == 2 ? particles.real("y") : Field<double>();
  id_ = particles.integer("id");
  lay_window(particles);
  const int cells = keep_blocks(particles);
  count_bins(particles, cells);
  place(particles, cells);
  int kept = 0;
  Kokkos::deep_copy(kept, Kokkos::subview(rows_.start, cells));
  particles.permute(order_, kept);
  particles.resize(kept);
}

}  // namespace freshet
