// What becomes of two points that are each other's nearest and too close (docs/formulas/fpm.md (F27), with
// the rules for kinds that it needs).
#pragma once
#include "kernels/fpm/tank.hpp"

namespace freshet::fpm {

enum Fate : int { keep = 0, drop = 1, move = 2 };  // move: to the middle of the two

struct Closeness {
  int kind, side;
  bool surface;
  int id;
};

// My fate. Surfaces and walls hold their points, two of a kind become one half way. near: a surface point
// sits on the wall's.
KOKKOS_INLINE_FUNCTION Fate fate_of(const TankView& tank, const Closeness& me, const Closeness& other,
                                    bool near) {
  if (me.kind == in_fluid && other.kind != in_fluid) return !me.surface || near ? drop : keep;
  if (me.kind != in_fluid && other.kind == in_fluid) return keep;
  if (me.kind == in_corner || other.kind == in_corner)
    return me.kind == other.kind || me.kind == in_corner ? keep : drop;
  if (me.side != other.side) {  // two sides of a bend
    const bool joined = tank.sides(me.side).after == other.side || tank.sides(me.side).before == other.side;
    return joined && me.id > other.id ? drop : keep;
  }
  if (me.surface != other.surface) return me.surface ? keep : drop;
  return me.id < other.id ? move : drop;
}

// Total order on pairs: nearer first, then the smaller of the two ids, then the larger. The same for both of
// a pair.
struct Closest {
  double r2 = 1e300;
  int low = 0, high = 0, partner = -1;

  KOKKOS_FORCEINLINE_FUNCTION void look_at(int j, double d2, int id, int other_id) {
    const int l = smaller(id, other_id), h = larger(id, other_id);
    const bool first = d2 < r2 || (d2 == r2 && (l < low || (l == low && h < high)));
    if (first) r2 = d2, low = l, high = h, partner = j;
  }
};

}  // namespace freshet::fpm
