// Where points on walls may be: on their side, in a corner, or free again beyond the wall's end; and which
// fluid points have come to a wall.
#pragma once
#include "kernels/fpm/tank.hpp"

namespace freshet::fpm {

struct Standing {
  Vec<double, 2> x;  // m
  int kind, side;
};

// A point that slid past an end of its side: round the corner to the next side, into the corner, or off the
// wall.
KOKKOS_INLINE_FUNCTION Standing past_end(const TankView& tank, const Standing& here, double along) {
  const Side& s = tank.sides(here.side);
  const bool at_b = along > s.length;
  const int next = at_b ? s.after : s.before;
  if (next < 0) return {here.x, in_fluid, -1};
  if (at_b ? s.corner_b : s.corner_a) return {at_b ? s.b : s.a, in_corner, at_b ? here.side : next};
  const Side& t = tank.sides(next);
  const double over = at_b ? along - s.length : -along, rest = smaller(over, t.length);
  return {tank.place(next, at_b ? rest : t.length - rest), on_wall, next};
}

// reach [m]: how far behind a wall a point may have come in one step. close [m]: fluid points this near
// before it stand on it too.
KOKKOS_INLINE_FUNCTION Standing hold(const TankView& tank, const Standing& here, double reach,
                                     double close = 0) {
  if (here.kind == in_corner) return {tank.sides(here.side).b, in_corner, here.side};
  if (here.kind == on_wall) {
    const Side& s = tank.sides(here.side);
    const double along = foot_on(s, here.x).along;
    if (along < 0 || along > s.length) return past_end(tank, here, along);
    return {tank.place(here.side, along), on_wall, here.side};
  }
  const NearestPiece f = tank.nearest(here.x, reach);
  if (f.piece < 0 || f.foot.off >= close) return here;
  return {tank.place(f.piece, clamp(f.foot.along, 0.0, tank.sides(f.piece).length)), on_wall, f.piece};
}

}  // namespace freshet::fpm
