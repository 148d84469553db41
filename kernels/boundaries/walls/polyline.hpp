// The geometry of lines, for walls, open boundaries and regions alike: straight pieces and how they are
// joined, feet and distances, turns, what is nearest and what lies inside. Of walls and open boundaries the
// water is on the left.
#pragma once
#include "cellgrid/simd/box.hpp"
#include "kernels/boundaries/walls/point.hpp"

namespace freshet {

// A straight piece from a to b. In 1-D both are the wall, and the normal points to the water.
struct Piece {
  Vec<double, 2> a{}, b{};             // m
  Vec<double, 2> tangent{}, normal{};  // unit, from a to b and to its left; 0 where a and b are the same
  double length = 0;                   // m
  int before = -1, after = -1;         // the pieces joined at a and at b, -1: free ends
};

// A place as a piece sees it.
template <class V>
struct Foot {
  V along{0.0};  // m, from a, of the perpendicular's foot; 1-D: 0
  V off{0.0};    // m, from the piece's line, positive on its left
};

template <class V>
KOKKOS_FORCEINLINE_FUNCTION Foot<V> foot_on(const Piece& s, const Vec<V, 1>& p) {
  return {0.0, (p.x - s.a.x) * s.normal.x};
}
template <class V>
KOKKOS_FORCEINLINE_FUNCTION Foot<V> foot_on(const Piece& s, const Vec<V, 2>& p) {
  const V rx = p.x - s.a.x, ry = p.y - s.a.y;
  return {rx * s.tangent.x + ry * s.tangent.y, rx * s.normal.x + ry * s.normal.y};
}

// From the piece's nearest point to a place with the foot `along` it [m].
template <class V>
KOKKOS_FORCEINLINE_FUNCTION Vec<V, 1> from_nearest(const Piece& s, const Vec<V, 1>& p, const V&) {
  return {p.x - s.a.x};
}
template <class V>
KOKKOS_FORCEINLINE_FUNCTION Vec<V, 2> from_nearest(const Piece& s, const Vec<V, 2>& p, const V& along) {
  const V on = clamp(along, V(0.0), V(s.length));
  return {p.x - s.a.x - on * s.tangent.x, p.y - s.a.y - on * s.tangent.y};
}

KOKKOS_FORCEINLINE_FUNCTION bool past_free_end(const Piece& s, double along) {
  return (s.before < 0 && along < 0) || (s.after < 0 && along > s.length);
}

// The nearest of the pieces looked at, within a reach; beside a free end a piece is not seen. Of two that
// share the nearest end it is the one whose line is farther away, which tells on which side the place is.
struct NearestPiece {
  double distance2, tie;  // m2
  int piece = -1;
  Foot<double> foot{};

  explicit KOKKOS_INLINE_FUNCTION NearestPiece(double reach)
      : distance2(reach * reach), tie(1e-9 * distance2) {}
  template <int D>
  KOKKOS_INLINE_FUNCTION void look_at(int k, const Piece& s, const Vec<double, D>& p) {
    const Foot<double> f = foot_on(s, p);
    const Vec<double, D> from = from_nearest(s, p, f.along);
    const double d2 = dot(from, from);
    const bool same = d2 < distance2 + tie && piece >= 0 && f.off * f.off > foot.off * foot.off;
    if (!(d2 < distance2 - tie || same) || past_free_end(s, f.along)) return;
    distance2 = d2, piece = k, foot = f;
  }
};

// Whether the way from p to q crosses the piece, its ends included.
KOKKOS_FORCEINLINE_FUNCTION bool crosses(const Piece& s, const Vec<double, 2>& p, const Vec<double, 2>& q) {
  const double off_p = foot_on(s, p).off, off_q = foot_on(s, q).off;
  if (off_p * off_q >= 0) return false;
  const double along = foot_on(s, p + (off_p / (off_p - off_q)) * (q - p)).along;
  return along >= 0 && along <= s.length;
}

// Whether the ray from p towards greater x crosses the side from a to b: an odd number of them encloses p.
KOKKOS_FORCEINLINE_FUNCTION bool crosses_ray(const Vec<double, 2>& a, const Vec<double, 2>& b,
                                             const Vec<double, 2>& p) {
  if ((b.y > p.y) == (a.y > p.y)) return false;
  return p.x < b.x + (p.y - b.y) / (a.y - b.y) * (a.x - b.x);
}

// ---- On the host ------------------------------------------------------------------------------------------
bool meet(const Point& p, const Point& q, double tolerance);  // m
bool is_closed(const Polyline& line, double tolerance = 0);   // m, between its ends

Piece piece_between(const Point& a, const Point& b);  // of one point: without direction
// Adds a line's pieces, joined to each other.
void append_pieces(const Polyline& line, bool closed, std::vector<Piece>& pieces);
std::vector<Piece> pieces_of(const std::vector<Polyline>& lines, double tolerance = 0);

// rad, from one direction to another: positive to the left, where corners hold less than 180 degrees of
// water.
double turn(const Vec<double, 2>& from, const Vec<double, 2>& to);

double distance(const Point& p, const Piece& piece);  // m
// m, to a line's nearest piece; of one point: to that; of none: 1e300.
double distance(const Point& p, const Polyline& line);

// Of polygons, whose last corner is joined to the first; it may be given twice.
double signed_area(const Polyline& polygon);  // m2, positive counter-clockwise
bool crosses_itself(const Polyline& polygon);
bool encloses(const Polyline& polygon, const Point& p);  // low edges count as inside, high ones as outside

Box bounds_of(const Polyline& line);  // of one point at least

}  // namespace freshet
