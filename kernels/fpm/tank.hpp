// The walls of an incompressible flow: straight sides along polylines, the water on their left, and the
// corners between them. Points on walls slide along their side; corners that turn towards the water by more
// than 10 degrees hold a fixed point. Of corners that turn away from it (more than 180 degrees of water) no
// point is kept: points slide round them.
#pragma once
#include "kernels/boundaries/walls/piece_bins.hpp"

namespace freshet::fpm {

// What a point is: its row in the pressure system and how it moves depend on it.
enum PointKind : int {
  in_fluid = 0,
  on_wall = 1,    // slides along its side, or is held by it (no slip)
  in_corner = 2,  // held where two sides meet
};

struct Side : Piece {
  bool corner_a = false, corner_b = false;  // a fixed point belongs there
  bool round_a = true, round_b = true;      // the water fills more than 180 degrees there, or the wall ends
};

// The sides as the device sees them.
struct TankView {
  Kokkos::View<Side*, Memory> sides;
  PieceBins bins;  // of the sides

  KOKKOS_INLINE_FUNCTION int size() const { return sides.extent_int(0); }

  KOKKOS_FORCEINLINE_FUNCTION Vec<double, 2> place(int side, double along) const {
    const Side& s = sides(side);
    return s.a + along * s.tangent;
  }

  // Whether the half-plane before the side bounds what p sees: p is before the side or, where the water fills
  // less than 180 degrees, beside it.
  static KOKKOS_FORCEINLINE_FUNCTION bool bounds(const Side& s, const Foot<double>& f, double reach) {
    const double slack = 1e-9 * s.length;
    const double from = s.round_a ? -slack : -reach, to = s.length + (s.round_b ? slack : reach);
    return f.off < reach && f.off > -1e-6 * reach && f.along >= from && f.along <= to;
  }

  KOKKOS_INLINE_FUNCTION NearestPiece nearest(const Vec<double, 2>& p, double reach) const {
    return nearest_piece(sides, bins, p, reach);
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
  Point x;         // m
  int kind, side;  // of corners the side that ends there
};

// The sides of polylines.
class Tank {
 public:
  // cell [m]: of the bins of sides, the width of usual queries; 0: many small ones.
  explicit Tank(const std::vector<Polyline>& lines, double cell = 0);

  // Points along all sides, spacing [m] apart or a little less, with the corners.
  std::vector<WallStart> lay_points(double spacing) const;

  const TankView& view() const { return view_; }
  int size() const { return static_cast<int>(sides_.size()); }

 private:
  std::vector<Side> sides_;
  TankView view_;
};

}  // namespace freshet::fpm
