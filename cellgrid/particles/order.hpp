// Particles in the order of rows of about two spacings and, within a row, of thin bins along x: who is near
// whom is then a few contiguous runs of indices. Rows and bins are fixed in space by the domain, so the order
// is a function of each position and id alone (row, bin, then id): a stray particle changes nobody else's.
// Tables reach over the window that holds particles. Bins are kept by blocks, and only blocks that hold a
// particle: dry land between waters costs one number per block.
#pragma once
#include "cellgrid/parallel/work.hpp"
#include "cellgrid/particles/fields.hpp"
#include "cellgrid/simd/box.hpp"
#include "cellgrid/simd/lanes.hpp"

namespace freshet {

// The sorted particles' rows and bins, as the device sees them.
struct Rows {
  double x0 = 0, y0 = 0;                 // m, corner of the window
  double x_origin = 0, y_origin = 0;     // m, corner of the domain, where bin 0 and row 0 of all begin
  int first_bin = 0, first_row = 0;      // the window's first, of the domain's
  double bin_width = 1, row_height = 1;  // m
  double per_bin_width = 1, per_row_height = 1;  // 1/m
  int rows = 1, bins = 1;  // of the window: rows, and bins in each; rows and bins are counted from its corner
  int columns = 1;         // blocks in each row
  Field<int> block;  // first kept cell of block c of row r at [r * columns + c], and the number of cells
  Field<int> start;  // first particle of each kept cell, and the number of particles

  double support = 0;                // m, largest
  int tile_rows = 1, tile_bins = 1;  // a tile's size in rows and bins: at least the largest support
  int tiles_x = 0, tiles_y = 0;
  double per_tile_width = 1, per_tile_height = 1;  // 1/m
  Field<double> reach;                             // m, largest h of a tile and its eight neighbours

  static constexpr int block_bins = 32;

  // First particle of bin b of row r, and one past its last; of a bin that is not kept, the next particle in
  // the order.
  KOKKOS_FORCEINLINE_FUNCTION int begin(int r, int b) const {
    const int k = r * columns + b / block_bins, first = block(k);
    return start(block(k + 1) > first ? first + b % block_bins : first);
  }
  KOKKOS_FORCEINLINE_FUNCTION int end(int r, int b) const {
    const int k = r * columns + b / block_bins, first = block(k);
    return start(block(k + 1) > first ? first + b % block_bins + 1 : first);
  }
  KOKKOS_FORCEINLINE_FUNCTION int row_begin(int r) const {
    return start(block(r * columns));
  }  // r = rows: all particles

  KOKKOS_FORCEINLINE_FUNCTION int bin_of(double x) const {
    return cell((x - x_origin) * per_bin_width, first_bin, bins);
  }
  KOKKOS_FORCEINLINE_FUNCTION int row_of(double y) const {
    return cell((y - y_origin) * per_row_height, first_row, rows);
  }

  // Of n from the first on, clamped to them; a NaN lands in the last.
  static KOKKOS_FORCEINLINE_FUNCTION int cell(double c, int first, int n) {
    return c < first + n - 1 ? (c > first ? static_cast<int>(c) - first : 0) : n - 1;
  }

  // Largest h [m] of the particles whose support can touch the box.
  KOKKOS_INLINE_FUNCTION double largest_h(double xlo, double xhi, double ylo, double yhi) const {
    double h = 0;
    const int tx1 = cell((xhi - x0) * per_tile_width, 0, tiles_x),
              ty1 = cell((yhi - y0) * per_tile_height, 0, tiles_y);
    for (int ty = cell((ylo - y0) * per_tile_height, 0, tiles_y); ty <= ty1; ++ty)
      for (int tx = cell((xlo - x0) * per_tile_width, 0, tiles_x); tx <= tx1; ++tx)
        h = larger(h, reach(ty * tiles_x + tx));
    return h;
  }

  // Calls run(begin, end) for the runs of particles that may lie within distance of the box.
  template <class Run>
  KOKKOS_INLINE_FUNCTION void for_each_run(double xlo, double xhi, double ylo, double yhi, double distance,
                                           const Run& run) const {
    const int last = row_of(yhi + distance);
    for (int r = row_of(ylo - distance); r <= last; ++r) {
      // Rows at the rim also hold what was clamped into them, so they count as reaching outwards.
      const double below = r == rows - 1 ? 0 : ylo - (y_origin + (first_row + r + 1) * row_height);
      const double above = r == 0 ? 0 : y_origin + (first_row + r) * row_height - yhi;
      const double dy = larger(0.0, larger(below, above));
      if (dy > distance) continue;
      const double s = root(distance * distance - dy * dy);
      run(begin(r, bin_of(xlo - s)), end(r, bin_of(xhi + s)));
    }
  }
};

// The passes of a sort in 2-D; permute: of one field.
inline constexpr Cost extent_cost{0, 4, 2.5}, count_cost{0, 4, 4.5}, place_cost{0, 0, 2},
    permute_cost{0, 0, 2.5};

class RowOrder {
 public:
  // spacing [m]: rows are 2 spacings high, bins half a spacing wide (both wider where the domain is larger
  // than 1e9 square spacings). domain: where particles are looked for; those outside are found in its
  // outermost cells. Of a periodic axis it is the period.
  RowOrder(int dimension, double spacing, const Box& domain);

  // Sorts all carried fields; particles with id < 0 are dropped. Uses x, (y), id.
  void sort(FieldSet& particles);

  // Measures the local largest of the field h [m]; support_factor x h is a particle's reach.
  void measure_reach(const FieldSet& particles, const Field<double>& h, double support_factor);

  const Rows& rows() const { return rows_; }

 public:
  int keep_blocks(const FieldSet& particles);
  void count_bins(const FieldSet& particles, int cells);
  void place(const FieldSet& particles, int cells);

 private:
  void lay_window(const FieldSet& particles);
  int lay_tiles();

  int dimension_;
  double spacing_;
  int domain_bins_, domain_rows_;
  Rows rows_;
  Field<int> mark_;  // 1 where a block holds a particle; all zero between sorts
  Field<int> key_, slot_, order_;
  Field<double> x_, y_, tile_h_;
  Field<int> id_;
};

}  // namespace freshet
