// The buffer of boundary particles outside one straight piece of an open boundary (Vacondio 2010,
// section 4.2). The line is cut into rows one spacing wide; the boundary particles of a row carry the row's
// exterior state, whoever determined it. They become fluid as they cross the line, fluid that crosses
// outwards becomes boundary particles, and the buffer is refilled and trimmed at its outer edge. Where the
// buffer's sides are not at right angles to the line (a mitre against the next piece, an oblique wall) rows
// are cut short, or rows beyond the ends, which nothing crosses, fill the wedge.
#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "cellgrid/particles/sums.hpp"
#include "kernels/swe/motion.hpp"
#include "kernels/swe/open/section.hpp"

namespace freshet::swe {

template <int D>
struct OpenLine {
  Vec<double, D> origin;   // m, a
  Vec<double, D> inward;   // unit normal towards the water
  Vec<double, D> tangent;  // unit, a -> b (1-D: zero)
  double length;           // m (1-D: 1)
  // How far the buffer widens beyond a and b, per metre outwards; negative where it narrows.
  double spread_a = 0, spread_b = 0;
};

// What the buffer takes from its scene.
struct OpenBufferOptions {
  double spacing;                    // m, of the boundary particles
  double eta;                        // h / spacing
  double support;                    // of the kernel, x h
  double summed;                     // what the density summation makes of a depth of 1 on a lattice
  std::optional<Friction> friction;  // the exterior flow's surface falls with it
};

struct Crossed {
  double in = 0, out = 0;  // m3
};

// Particles (re)bound after the fields have grown.
template <int D>
using Bind = std::function<Particles<D>()>;

template <int D>
class OpenBuffer {
 public:
  // owner: what the field kind of its boundary particles holds, > 0; fluid is 0.
  OpenBuffer(const OpenLine<D>& line, const OpenBufferOptions& options, int owner);

  // Levels of the bed on the line; call once.
  void survey(const std::optional<BedTerm<D>>& bed);

  // Shepard means of level and velocity at each row's point on the line, over the fluid within 2h.
  void observe(const Rows& rows, const Particles<D>& p, const Field<int>& kind,
               const std::optional<BedTerm<D>>& bed);

  // The states of the rows on the line, from a to b, whose exterior states others keep. Call once, before the
  // rest.
  void take_rows(const OpenRows& rows) { row_ = rows; }
  int rows() const { return count_; }                                   // on the line
  double width() const { return width_; }                               // m, of a row
  double length() const { return D == 1 ? 1.0 : line_.length; }         // m
  double smoothing() const { return options_.eta * options_.spacing; }  // m, h of the boundary particles
  double least_depth() const { return 1e-6 * options_.spacing; }

  // Conversions across the line, removals, and the exterior state on the boundary particles; then insertions.
  Crossed convert(FieldSet& particles, const Particles<D>& p, const std::optional<BedTerm<D>>& bed);
  int count_room(const FieldSet& particles, const VecField<double, D>& x);
  void insert(FieldSet& particles, const Bind<D>& bind, const std::optional<BedTerm<D>>& bed, int& next_id);

  // Volume of the footprints' parts across the line: boundary particles' inside minus fluid's outside [m3].
  double straddling(const Particles<D>& p, const Field<int>& kind, int n) const;

 public:
  // A row's part of the buffer [m outside the line]: no wider than the sides of the buffer allow.
  struct RowPart {
    double from = 0, to = 0;
  };
  struct Frame {
    OpenLine<D> line;
    double width;
    int before, count, total;  // rows beyond a, on the line, all

    KOKKOS_INLINE_FUNCTION double inside(const Vec<double, D>& x) const {
      return dot(x - line.origin, line.inward);
    }
    KOKKOS_INLINE_FUNCTION double along(const Vec<double, D>& x) const {  // in rows from a
      if constexpr (D == 1) return 0.5;
      return dot(x - line.origin, line.tangent) / width;
    }
    KOKKOS_INLINE_FUNCTION int row(const Vec<double, D>& x) const {
      const double r = ::floor(along(x)) + before;
      return r > 0 ? (r < total - 1 ? static_cast<int>(r) : total - 1) : 0;
    }
    // Whose state holds in a row: beyond the ends that of the row at the end.
    KOKKOS_INLINE_FUNCTION int state(int row) const { return smaller(larger(row - before, 0), count - 1); }
    KOKKOS_INLINE_FUNCTION bool on_line(int row) const { return row >= before && row < before + count; }
    KOKKOS_INLINE_FUNCTION Vec<double, D> point(int row, double inside) const {
      return line.origin + inside * line.inward + ((row - before + 0.5) * width) * line.tangent;
    }
    // slack: in rows.
    KOKKOS_INLINE_FUNCTION bool beside(const Vec<double, D>& x, double slack) const {
      const double k = along(x);
      return k > -before - slack && k < total - before + slack;
    }
  };
  Frame frame() const { return {line_, width_, before_, count_, total_}; }

 private:
  RowPart extent(int row) const;

  OpenLine<D> line_;
  OpenBufferOptions options_;
  int owner_;
  double buffer_;  // m, its depth
  double width_ = 1;
  int before_ = 0, count_ = 1, total_ = 1;
  OpenRows row_;  // on the line
  Kokkos::View<RowPart*, Memory> extent_;
  Field<double> farthest_, nearest_;  // m, outermost and innermost boundary particle of each row
  Field<int> room_, inner_room_;  // boundary particles to insert before each row; of them at the inner edge
};

}  // namespace freshet::swe
