#include "cellgrid/order.hpp"

#include <algorithm>
#include <cmath>

namespace freshet {
namespace {

// The particles' bounding box; without y its y is zero.
struct Extent {
  double xlo = 0, xhi = 0, ylo = 0, yhi = 0;  // m
};

Extent extent_of(const Field<double>& x, const Field<double>& y, const Field<int>& id, int n) {
  const bool plane = y.extent(0) > 0;
  Extent e;
  Kokkos::parallel_reduce(
      "cellgrid::extent", Range(0, n),
      KOKKOS_LAMBDA(int i, double& xlo, double& xhi, double& ylo, double& yhi) {
        if (id(i) < 0) return;
        const double px = x(i), py = plane ? y(i) : 0.0;
        xlo = smaller(xlo, px), xhi = larger(xhi, px);
        ylo = smaller(ylo, py), yhi = larger(yhi, py);
      },
      Kokkos::Min<double>(e.xlo), Kokkos::Max<double>(e.xhi), Kokkos::Min<double>(e.ylo), Kokkos::Max<double>(e.yhi));
  return e.xlo <= e.xhi ? e : Extent{};
}

template <class View>
void reserve(View& view, const char* label, int n) {
  if (view.extent_int(0) < n) view = View(Kokkos::ViewAllocateWithoutInitializing(label), static_cast<size_t>(n + n / 2));
}

int cells(double length, double width) { return static_cast<int>(length / width) + 1; }

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

}  // namespace

RowOrder::RowOrder(int dimension, double spacing) : dimension_(dimension), spacing_(spacing) {}

void RowOrder::lay_grid(const FieldSet& particles) {
  const int n = particles.size();
  const Extent e = extent_of(x_, y_, id_, n);
  const double width = e.xhi - e.xlo, height = e.yhi - e.ylo;
  if (!std::isfinite(width + height)) return;  // a lost particle: keep the last grid, the monitor reports it
  rows_.x0 = e.xlo;
  rows_.y0 = e.ylo;
  rows_.row_height = 2 * spacing_;
  rows_.bin_width = 0.5 * spacing_;
  const double most = std::min(4.0 * n + 4096, 3e7);  // blocks: a stray particle must not make a huge table
  while (height / rows_.row_height > most) rows_.row_height *= 2;
  rows_.rows = cells(height, rows_.row_height);
  while (width / (Rows::block_bins * rows_.bin_width) * rows_.rows > most) rows_.bin_width *= 2;
  rows_.bins = cells(width, rows_.bin_width);
  rows_.columns = (rows_.bins - 1) / Rows::block_bins + 1;
  rows_.per_row_height = 1 / rows_.row_height;
  rows_.per_bin_width = 1 / rows_.bin_width;
}

// Which blocks hold particles; returns how many cells they have. Keys: block and bin within it, -1 = to be dropped.
int RowOrder::keep_blocks(const FieldSet& particles) {
  const int n = particles.size(), blocks = rows_.rows * rows_.columns, dimension = dimension_;
  if (mark_.extent_int(0) < blocks + 1) mark_ = Field<int>("cellgrid.mark", static_cast<size_t>(blocks + blocks / 2 + 256));
  reserve(rows_.block, "cellgrid.block", blocks + 1);
  reserve(key_, "cellgrid.key", n);
  const Rows rows = rows_;
  const Field<int> key = key_, mark = mark_, block = rows_.block, id = id_;
  const Field<double> x = x_, y = y_;
  Kokkos::parallel_for("cellgrid::mark", Range(0, n), KOKKOS_LAMBDA(int i) {
        const int r = dimension == 2 ? rows.row_of(y(i)) : 0, b = rows.bin_of(x(i)), k = r * rows.columns + b / Rows::block_bins;
        key(i) = id(i) < 0 ? -1 : k * Rows::block_bins + b % Rows::block_bins;
        if (id(i) >= 0 && mark(k) == 0) mark(k) = 1;
      });
  Kokkos::parallel_scan("cellgrid::keep", Range(0, blocks + 1), KOKKOS_LAMBDA(int k, int& sum, bool last) {
        const int kept = mark(k);
        if (last) block(k) = sum, mark(k) = 0;
        sum += kept * Rows::block_bins;
      });
  int kept_cells = 0;
  Kokkos::deep_copy(kept_cells, Kokkos::subview(rows_.block, blocks));
  return kept_cells;
}

void RowOrder::count_bins(const FieldSet& particles, int cells) {
  const int n = particles.size();
  reserve(rows_.start, "cellgrid.start", cells + 2);
  reserve(slot_, "cellgrid.slot", n);
  const Field<int> key = key_, slot = slot_, start = rows_.start, block = rows_.block;
  Kokkos::parallel_for("cellgrid::clear", Range(0, cells + 2), KOKKOS_LAMBDA(int c) { start(c) = 0; });
  Kokkos::parallel_for("cellgrid::count", Range(0, n), KOKKOS_LAMBDA(int i) {
        const int k = key(i);
        key(i) = k < 0 ? cells : block(k / Rows::block_bins) + k % Rows::block_bins;
        slot(i) = Kokkos::atomic_fetch_add(&start(key(i)), 1);
      });
  Kokkos::parallel_scan("cellgrid::scan", Range(0, cells + 2), KOKKOS_LAMBDA(int c, int& sum, bool last) {
        const int here = start(c);
        if (last) start(c) = sum;
        sum += here;
      });
}

void RowOrder::place(const FieldSet& particles, int cells) {
  const int n = particles.size();
  reserve(order_, "cellgrid.order", n);
  const Field<int> key = key_, slot = slot_, start = rows_.start, order = order_, id = id_;
  Kokkos::parallel_for("cellgrid::place", Range(0, n), KOKKOS_LAMBDA(int i) { order(start(key(i)) + slot(i)) = i; });
  Kokkos::parallel_for("cellgrid::settle", Range(0, cells), KOKKOS_LAMBDA(int c) {
        const int first = start(c), in_bin = start(c + 1) - first;
        if (in_bin > 1) sort_by_id(&order(first), in_bin, id.data());
      });
}

void RowOrder::sort(FieldSet& particles) {
  const Region region("cellgrid::sort");
  x_ = particles.real("x");
  y_ = dimension_ == 2 ? particles.real("y") : Field<double>();
  id_ = particles.integer("id");
  lay_grid(particles);
  const int cells = keep_blocks(particles);
  count_bins(particles, cells);
  place(particles, cells);
  int kept = 0;
  Kokkos::deep_copy(kept, Kokkos::subview(rows_.start, cells));
  particles.permute(order_, kept);
  particles.resize(kept);
}

int RowOrder::lay_tiles() {
  rows_.tiles_x = (rows_.bins - 1) / rows_.tile_bins + 1;
  rows_.tiles_y = (rows_.rows - 1) / rows_.tile_rows + 1;
  return rows_.tiles_x * rows_.tiles_y;
}

void RowOrder::measure_reach(const FieldSet& particles, const Field<double>& h, double support_factor) {
  double h_max = 0;
  Kokkos::parallel_reduce("cellgrid::largest_h", Range(0, particles.size()),
      KOKKOS_LAMBDA(int i, double& m) { m = larger(m, h(i)); }, Kokkos::Max<double>(h_max));
  rows_.support = std::isfinite(h_max) ? std::max(support_factor * h_max, spacing_) : spacing_;
  const auto covering = [&](double width, int n) {
    return static_cast<int>(std::clamp(std::ceil(rows_.support / width), 1.0, static_cast<double>(n)));
  };
  rows_.tile_rows = covering(rows_.row_height, rows_.rows);
  rows_.tile_bins = covering(rows_.bin_width, rows_.bins);
  // Where water is sparse tiles are larger: a lattice has one for 12 particles.
  while (lay_tiles() > particles.size() / 8 + 1024) rows_.tile_rows *= 2, rows_.tile_bins *= 2;
  const int tiles = lay_tiles();
  reserve(tile_h_, "cellgrid.tile_h", tiles);
  reserve(rows_.reach, "cellgrid.reach", tiles);
  const Rows rows = rows_;
  const Field<double> tile_h = tile_h_;
  Kokkos::parallel_for("cellgrid::tile_h", Range(0, tiles), KOKKOS_LAMBDA(int t) {
        const int ty = t / rows.tiles_x, tx = t % rows.tiles_x;
        const int b0 = tx * rows.tile_bins, b1 = smaller(b0 + rows.tile_bins, rows.bins);
        double m = 0;
        for (int r = ty * rows.tile_rows; r < smaller((ty + 1) * rows.tile_rows, rows.rows); ++r)
          for (int i = rows.begin(r, b0); i < rows.end(r, b1 - 1); ++i) m = larger(m, h(i));
        tile_h(t) = m;
      });
  Kokkos::parallel_for("cellgrid::reach", Range(0, tiles), KOKKOS_LAMBDA(int t) {
        const int ty = t / rows.tiles_x, tx = t % rows.tiles_x;
        double m = 0;
        for (int y = larger(ty - 1, 0); y <= smaller(ty + 1, rows.tiles_y - 1); ++y)
          for (int x = larger(tx - 1, 0); x <= smaller(tx + 1, rows.tiles_x - 1); ++x)
            m = larger(m, tile_h(y * rows.tiles_x + x));
        rows.reach(t) = m;
      });
}

}  // namespace freshet
