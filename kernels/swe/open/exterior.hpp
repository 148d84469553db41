// What an open boundary's particles take from their row of the line, and how the surface goes on beside the
// line: level with still water, falling along the flow with the slope of friction. Used on both sides of the
// line: for what is seen of the water inside and for what stands outside. Units: m, m/s.
#pragma once
#include <optional>

#include "kernels/swe/open/buffer.hpp"

namespace freshet::swe {

template <int D>
KOKKOS_FORCEINLINE_FUNCTION double bed_at(const std::optional<BedTerm<D>>& bed, const Vec<double, D>& x) {
  return bed ? bed->spline.sloped_at(x).b : 0.0;
}

// A place beside the line: how far inside [m], and how far its bed lies below that on the line [m].
template <int D>
struct BesideLine {
  Vec<double, D> x;
  double inside, drop;
};

// m, how much higher the surface stands on the line than there, by friction in flow of that depth and inward
// velocity; no more than what the bed falls by, or a fifth of the depth.
template <int D>
KOKKOS_INLINE_FUNCTION double fall(const std::optional<Friction>& friction, double depth, double inward,
                                   const BesideLine<D>& there) {
  if (!friction) return 0;
  const double most = larger(0.2 * depth, larger(there.drop, -there.drop));
  const double slope = friction->drag(depth, there.x) / friction->gravity * inward * larger(inward, -inward);
  return clamp(slope * there.inside, -most, most);
}

// What a boundary particle takes from its row.
template <int D>
struct Exterior {
  std::optional<BedTerm<D>> bed;
  std::optional<Friction> friction;
  double least;  // m

  // Depth: the row's level over the bed beyond the line, so that still water stays still there, falling along
  // the flow with the slope of friction, so that uniform flow stays uniform.
  KOKKOS_INLINE_FUNCTION double depth(const OpenRow& row, const Vec<double, D>& x, double inside) const {
    const double drop = row.bed - bed_at<D>(bed, x);
    const double d =
        row.depth + drop - fall<D>(friction, larger(row.depth, least), row.inward, {x, inside, drop});
    return larger(larger(d, 0.2 * row.depth), least);
  }
  static KOKKOS_INLINE_FUNCTION Vec<double, D> velocity(const OpenRow& row, const OpenLine<D>& line) {
    return row.inward * line.inward + row.along * line.tangent;
  }
};

}  // namespace freshet::swe
