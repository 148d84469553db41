// RowOrder: tiles of cells, and the largest h around each of them.
#include <algorithm>
#include <cmath>

#include "cellgrid/parallel/launch.hpp"
#include "cellgrid/particles/order.hpp"

namespace freshet {

int RowOrder::lay_tiles() {
  rows_.tiles_x = (rows_.bins - 1) / rows_.tile_bins + 1;
  rows_.tiles_y = (rows_.rows - 1) / rows_.tile_rows + 1;
  return rows_.tiles_x * rows_.tiles_y;
}

void RowOrder::measure_reach(const FieldSet& particles, const Field<double>& h, double support_factor) {
  double h_max = 0;
  Kokkos::parallel_reduce(
      "cellgrid::largest_h", Range(0, particles.size()),
      KOKKOS_LAMBDA(int i, double& m) { m = larger(m, h(i)); }, Kokkos::Max<double>(h_max));
  rows_.support = std::isfinite(h_max) ? std::max(support_factor * h_max, spacing_) : spacing_;
  const auto covering = [&](double width, int n) {
    return static_cast<int>(std::clamp(std::ceil(rows_.support / width), 1.0, static_cast<double>(n)));
  };
  rows_.tile_rows = covering(rows_.row_height, rows_.rows);
  rows_.tile_bins = covering(rows_.bin_width, rows_.bins);
  // Where water is sparse tiles are larger: a lattice has one for 12 particles.
  while (lay_tiles() > particles.size() / 8 + 1024) rows_.tile_rows *= 2, rows_.tile_bins *= 2;
  rows_.per_tile_width = rows_.per_bin_width / rows_.tile_bins;
  rows_.per_tile_height = rows_.per_row_height / rows_.tile_rows;
  const int tiles = lay_tiles();
  reserve(tile_h_, "cellgrid.tile_h", tiles);
  reserve(rows_.reach, "cellgrid.reach", tiles);
  const Rows rows = rows_;
  const Field<double> tile_h = tile_h_;
  launch(
      "cellgrid::tile_h", Range(0, tiles), KOKKOS_LAMBDA(int t) {
        const int ty = t / rows.tiles_x, tx = t % rows.tiles_x;
        const int b0 = tx * rows.tile_bins, b1 = smaller(b0 + rows.tile_bins, rows.bins);
        double m = 0;
        for (int r = ty * rows.tile_rows; r < smaller((ty + 1) * rows.tile_rows, rows.rows); ++r)
          if (rows.row_begin(r) < rows.row_begin(r + 1))
            for (int i = rows.begin(r, b0); i < rows.end(r, b1 - 1); ++i) m = larger(m, h(i));
        tile_h(t) = m;
      });
  launch(
      "cellgrid::reach", Range(0, tiles), KOKKOS_LAMBDA(int t) {
        const int ty = t / rows.tiles_x, tx = t % rows.tiles_x;
        double m = 0;
        for (int y = larger(ty - 1, 0); y <= smaller(ty + 1, rows.tiles_y - 1); ++y)
          for (int x = larger(tx - 1, 0); x <= smaller(tx + 1, rows.tiles_x - 1); ++x)
            m = larger(m, tile_h(y * rows.tiles_x + x));
        rows.reach(t) = m;
      });
}

}  // namespace freshet
