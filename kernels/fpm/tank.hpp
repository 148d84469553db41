// The walls of an incompressible flow: straight sides along polylines, the water on their left, and the corners between them.
// Points on walls slide along their side; corners that turn towards the water by more than 10 degrees hold a fixed point.
// Of corners that turn away from it (more than 180 degrees of water) no point is kept: points slide round them.
#pragma once
#include <array>
#include <vector>

#include "kernels/segment_bins.hpp"

namespace freshet::fpm {

// What a point is: its row in the pressure system and how it moves depend on it.
enum PointKind : int {
  in_fluid = 0,
  on_wall = 1,    // slides along its side, or is held by it (no slip)
  in_corner = 2,  // held where two sides meet
};

struct Side {
  Vec<double, 2> a, b;             // m
  Vec<double, 2> tangent, normal;  // unit, from a to b; towards the water
  double length;                   // m
  int before, after;               // the sides joined at a and at b, -1: free ends
  bool corner_a, corner_b;         // a fixed point belongs there
  bool round_a, round_b;           // the water fills more than 180 degrees there, or the wall ends
};

// A place as a side sees it.
struct Foot {
  double along;  // m, from a, of the perpendicular's foot
  double off;    // m, distance from the side's line, positive in the water
};

struct Footing {
  int side = -1;     // the nearest side within the reach asked for, -1: none
  Foot foot{0, 0};
  double distance2 = 0;  // m2, to the side itself, ends included
};

// The sides as the device sees them.
struct TankView {
  Kokkos::View<Side*, Memory> sides;
  SegmentBins bins;  // of the sides

  KOKKOS_INLINE_FUNCTION int size() const { return sides.extent_int(0); }

  static KOKKOS_FORCEINLINE_FUNCTION Foot foot_on(const Side& s, const Vec<double, 2>& p) {
    const Vec<double, 2> r = p - s.a;
    return {dot(r, s.tangent), dot(r, s.normal)};
  }

  KOKKOS_FORCEINLINE_FUNCTION Vec<double, 2> place(int side, double along) const {
    const Side& s = sides(side);
    return s.a + along * s.tangent;
  }

  // Whether the half-plane before the side bounds what p sees: p is before the side or, where the water fills less than 180
  // degrees, beside it.
  static KOKKOS_FORCEINLINE_FUNCTION bool bounds(const Side& s, const Foot& f, double reach) {
    const double slack = 1e-9 * s.length;
    const double from = s.round_a ? -slack : -reach, to = s.length + (s.round_b ? slack : reach);
    return f.off < reach && f.off > -1e-6 * reach && f.along >= from && f.along <= to;
  }

  // The side nearest to p; of two that share the nearest end, the one whose line is farther away, which tells the side of p.
  KOKKOS_INLINE_FUNCTION Footing nearest(const Vec<double, 2>& p, double reach) const {
    Footing best;
    best.distance2 = reach * reach;
    const double tie = 1e-9 * best.distance2;
    constexpr double more = 1 + 1e-6;  // than the tie
    bins.for_each(box_around(p, more * reach), [&](int k) {
      const Side& s = sides(k);
      const Foot f = foot_on(s, p);
      const double over = f.along < 0 ? -f.along : f.along > s.length ? f.along - s.length : 0;
      if ((f.along < 0 && s.before < 0) || (f.along > s.length && s.after < 0)) return;  // beside a free end
      const double d2 = over * over + f.off * f.off;
      const bool same = d2 < best.distance2 + tie && best.side >= 0 && f.off * f.off > best.foot.off * best.foot.off;
      if (d2 < best.distance2 - tie || same) best = {k, f, d2};
    });
    return best;
  }

  // The unit normal of a point on the side; in the corner at its end b the mean of both sides'.
  KOKKOS_INLINE_FUNCTION Vec<double, 2> normal(int side, int kind) const {
    Vec<double, 2> n = sides(side).normal;
    if (kind != in_corner || sides(side).after < 0) return n;
    n += sides(sides(side).after).normal;
    const double length = root(dot(n, n));
    return length > 1e-9 ? (1 / length) * n : sides(side).normal;
  }
};

// A point that the walls start with.
struct WallStart {
  std::array<double, 2> x;  // m
  int kind, side;           // of corners the side that ends there
};

// The sides of polylines (closed where they end as they begin) [m].
class Tank {
 public:
  // cell [m]: of the bins of sides, the width of usual queries; 0: many small ones.
  explicit Tank(const std::vector<std::vector<std::array<double, 2>>>& lines, double cell = 0);

  // Points along all sides, spacing [m] apart or a little less, with the corners.
  std::vector<WallStart> lay_points(double spacing) const;

  const TankView& view() const { return view_; }
  int size() const { return static_cast<int>(sides_.size()); }

 private:
  std::vector<Side> sides_;
  TankView view_;
};

}  // namespace freshet::fpm
