// Pieces of lines by place: a lattice of cells over all of them, and for each cell a list of those that cross
// it. A query is a box; it reads the cells that the box touches, so that it costs what is near, however long
// the coast is. Made once, on the host.
#pragma once
#include <limits>
#include <vector>

#include "kernels/boundaries/walls/polyline.hpp"

namespace freshet {

// All places within a distance [m] of p along each axis.
KOKKOS_FORCEINLINE_FUNCTION Box box_around(const Vec<double, 1>& p, double reach) {
  return {p.x - reach, p.x + reach, 0.0, 0.0};
}
KOKKOS_FORCEINLINE_FUNCTION Box box_around(const Vec<double, 2>& p, double reach) {
  return {p.x - reach, p.x + reach, p.y - reach, p.y + reach};
}
// That with two places as corners.
KOKKOS_FORCEINLINE_FUNCTION Box box_between(const Vec<double, 1>& p, const Vec<double, 1>& q) {
  return {smaller(p.x, q.x), larger(p.x, q.x), 0.0, 0.0};
}
KOKKOS_FORCEINLINE_FUNCTION Box box_between(const Vec<double, 2>& p, const Vec<double, 2>& q) {
  return {smaller(p.x, q.x), larger(p.x, q.x), smaller(p.y, q.y), larger(p.y, q.y)};
}

class PieceBins {
 public:
  PieceBins() = default;  // of no pieces: nothing is allocated, nothing found
  // finest [m]: cells are no smaller, for queries of about that width; about 50 of them per piece at most.
  explicit PieceBins(const std::vector<Piece>& pieces, double finest = 0);

  KOKKOS_FORCEINLINE_FUNCTION int size() const { return size_; }

  // Calls see(k) once for every piece that touches the box, and some that do not, in ascending order: sums
  // and ties come out as if all were asked.
  template <class See>
  KOKKOS_FORCEINLINE_FUNCTION void for_each(const Box& box, const See& see) const {
    if (!reaches(box)) return;
    const CellRange c = cells_in(box);
    if (entries_in(c) == 0) return;
    const int cells = c.count();
    const bool one = cells == 1, all = cells >= size_;
    int n = first_(at(c.i0, c.j0));
    const int end = first_(at(c.i0, c.j0) + 1);
    // One loop for the three ways, so that what is seen is compiled once, in place.
    for (int k = one ? list_(n) : all ? 0 : next(c, -1); k < size_;) {
      see(k);
      k = one ? (++n < end ? list_(n) : size_) : all ? k + 1 : next(c, k);
    }
  }

  // Whether test(k) holds for one of them; asked in any order, of some more than once.
  template <class Test>
  KOKKOS_INLINE_FUNCTION bool any(const Box& box, const Test& test) const {
    if (!reaches(box)) return false;
    const CellRange c = cells_in(box);
    for (int j = c.j0; j <= c.j1; ++j)
      for (int n = first_(at(c.i0, j)), end = first_(at(c.i1, j) + 1); n < end; ++n)
        if (test(list_(n))) return true;
    return false;
  }

 private:
  struct CellRange {
    int i0, i1, j0, j1;  // first and last columns and rows
    KOKKOS_FORCEINLINE_FUNCTION int count() const { return (i1 - i0 + 1) * (j1 - j0 + 1); }
  };

  template <class Visit>
  void for_each_crossed(const Piece& s, const Visit& visit) const;
  void span(const std::vector<Piece>& pieces, double finest);

  // False of places that are not numbers, too.
  KOKKOS_FORCEINLINE_FUNCTION bool reaches(const Box& b) const {
    return b.xhi >= bounds_.xlo && b.xlo <= bounds_.xhi && b.yhi >= bounds_.ylo && b.ylo <= bounds_.yhi;
  }
  KOKKOS_FORCEINLINE_FUNCTION int at(int i, int j) const { return j * nx_ + i; }
  // The column or row of a place, the nearest one outside of them.
  KOKKOS_FORCEINLINE_FUNCTION int cell(double s, double low, int n) const {
    const double c = (s - low) * per_cell_;
    return c > 0 ? (c < n ? static_cast<int>(c) : n - 1) : 0;
  }
  KOKKOS_FORCEINLINE_FUNCTION CellRange cells_in(const Box& b) const {
    return {cell(b.xlo, bounds_.xlo, nx_), cell(b.xhi, bounds_.xlo, nx_), cell(b.ylo, bounds_.ylo, ny_),
            cell(b.yhi, bounds_.ylo, ny_)};
  }
  KOKKOS_FORCEINLINE_FUNCTION int entries_in(const CellRange& c) const {
    int count = 0;
    for (int j = c.j0; j <= c.j1; ++j) count += first_(at(c.i1, j) + 1) - first_(at(c.i0, j));
    return count;
  }

  // The first piece of the cells behind piece `last`, size() if there is none. Lists ascend: bisection.
  KOKKOS_INLINE_FUNCTION int next(const CellRange& c, int last) const {
    int best = size_;
    for (int j = c.j0; j <= c.j1; ++j)
      for (int i = c.i0; i <= c.i1; ++i) {
        const int end = first_(at(i, j) + 1);
        int low = first_(at(i, j)), high = end;
        while (low < high) {
          const int middle = (low + high) / 2;
          (list_(middle) > last ? high : low) = list_(middle) > last ? middle : middle + 1;
        }
        if (low < end) best = smaller(best, list_(low));
      }
    return best;
  }

  int size_ = 0, nx_ = 0, ny_ = 0;
  static constexpr double infinite = std::numeric_limits<double>::infinity();
  Box bounds_{infinite, -infinite, infinite, -infinite};  // m; of nothing, which no box reaches
  double per_cell_ = 0;                                   // 1/m
  double slack_ = 0;  // m, by which pieces count as thicker than they are: more than places round by
  Field<int> first_;  // entry of cell i + j nx; nx ny + 1 values
  Field<int> list_;   // pieces, cell by cell
};

template <class Pieces, int D>
KOKKOS_INLINE_FUNCTION NearestPiece nearest_piece(const Pieces& pieces, const PieceBins& bins,
                                                  const Vec<double, D>& p, double reach) {
  constexpr double more = 1 + 1e-6;  // than the tie
  NearestPiece nearest(reach);
  bins.for_each(box_around(p, more * reach), [&](int k) { nearest.look_at(k, pieces(k), p); });
  return nearest;
}

}  // namespace freshet
