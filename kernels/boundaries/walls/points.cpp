#include "kernels/boundaries/walls/points.hpp"

#include <algorithm>
#include <cmath>

namespace freshet {
namespace {

constexpr double small_turn = 0.5;  // rad: below it two pieces are one curve, not a corner
constexpr double cell = 4;          // x spacing: of the bins of pieces, as wide as what is asked of them

// Positive where the water is inside the corner (less than 180 degrees).
double turn_between(const Piece& s, const Piece& t) { return turn(s.tangent, t.tangent); }

// Projector of a point between two pieces: the eigenvalues of n1 n1^T + n2 n2^T cut at one, so that it turns
// from n n^T (straight wall) to the identity (right corner: the image through it moves exactly opposite).
WallPoint corner_point(const Vec<double, 2>& x, const Piece& s, const Piece& t, int piece) {
  const Vec<double, 2> sum = s.normal + t.normal;
  const double length = std::hypot(sum.x, sum.y);
  if (length < 1e-9) return {{x.x, x.y}, {1, 0, 1}, 1, piece};
  const double nx = sum.x / length, ny = sum.y / length, cosine = dot(s.normal, t.normal);
  const double across = std::fmin(1.0, 1 + cosine), along = std::fmin(1.0, 1 - cosine);
  return {
      {x.x, x.y},
      {across * nx * nx + along * ny * ny, (across - along) * nx * ny, across * ny * ny + along * nx * nx},
      1,
      piece};
}

// A point `along` the piece from a, `depth` behind it.
WallPoint face_point(const Piece& s, double along, double depth, int piece) {
  const Vec<double, 2>&n = s.normal, &e = s.tangent;
  return {{s.a.x + along * e.x - depth * n.x, s.a.y + along * e.y - depth * n.y},
          {n.x * n.x, n.x * n.y, n.y * n.y},
          1,
          piece};
}

double face_step(const Piece& s, double spacing) {
  return s.length / std::max(1, static_cast<int>(std::lround(2 * s.length / spacing)));
}

// Wall points about half a spacing apart along piece k and in the corner at its end; each is worth as much as
// a whole half spacing but where the polyline's own pieces are much shorter. `extra`: at corners of less than
// 180 degrees each wall goes on by half a spacing more.
void lay_face(std::vector<WallPiece>& all, int k, double spacing, bool extra,
              std::vector<WallPoint>& points) {
  const auto add = [&](WallPoint point, double length) {
    if (length < 0.4 * spacing) point.share = length / (0.5 * spacing);
    points.push_back(point);
  };
  WallPiece& s = all[k];
  const double step = face_step(s, spacing);
  for (double along = step; along < s.length - 0.5 * step; along += step)
    add(face_point(s, along, 0, k), step);
  if (s.after >= 0) {
    WallPiece& next = all[s.after];
    const double beyond = face_step(next, spacing);
    const bool corner = turn_between(s, next) > small_turn;
    add(corner_point(s.b, s, next, k), 0.5 * (step + beyond));
    if (corner) s.beyond_b = next.beyond_a = 4 * step;
    if (corner && extra) {
      add(face_point(s, s.length + step, 0, k), step);
      add(face_point(next, -beyond, 0, s.after), beyond);
    }
  } else {
    add(face_point(s, s.length, 0, k), step);
  }
  if (s.before < 0) add(face_point(s, 0, 0, k), step);
}

// What of a row's point is this piece's: all, half where another is as near, nothing where one is nearer.
double own_part(const WallGeometry& g, int k, const Point& x, double spacing) {
  const double own = distance(x, g.pieces[k]), tie = 1e-6 * spacing;
  const Box near = box_around(to_vec<2>(x), own + tie);
  const auto other_within = [&](double reach) {
    return g.bins.any(near, [&](int other) { return other != k && distance(x, g.pieces[other]) < reach; });
  };
  if (other_within(own - tie)) return 0;
  return other_within(own + tie) ? 0.5 : 1;
}

// Rows of points behind piece k, on the lattice of its own cells; round corners with the water inside they go
// on as far as they go deep. Along curves the outer rows are longer (the inner ones shorter) by depth x
// tan(turn/2) at each end.
void lay_rows(WallGeometry& g, int k, const WallOptions& o) {
  const Piece& s = g.pieces[k];
  const Piece &previous = g.pieces[std::max(s.before, 0)], &next = g.pieces[std::max(s.after, 0)];
  const int cells = std::max(1, static_cast<int>(std::lround(s.length / o.spacing)));
  const int rows = static_cast<int>(std::ceil(o.reach / o.spacing));
  const double at_a = s.before >= 0 ? turn_between(previous, s) : 0;
  const double at_b = s.after >= 0 ? turn_between(s, next) : 0;
  const double step = s.length / cells;
  double stretch = 0;
  for (const double turn : {at_a, at_b}) stretch += std::abs(turn) < small_turn ? std::tan(turn / 2) : 0;
  for (int row = 0; row < rows; ++row) {
    const double depth = (row + 0.5) * o.spacing, curved = std::max(0.0, 1 + depth * stretch / s.length);
    for (int i = at_a > small_turn ? -rows : 0; i < (at_b > small_turn ? cells + rows : cells); ++i) {
      WallPoint point = face_point(s, (i + 0.5) * step, depth, k);
      if (i < 0 || i >= cells) {
        const WallPoint corner = corner_point(s.a, i < 0 ? previous : s, i < 0 ? s : next, k);
        std::copy(corner.p, corner.p + 3, point.p);
      }
      point.share = own_part(g, k, {point.x[0], point.x[1]}, o.spacing) * step * o.spacing * curved;
      if (point.share > 0) g.points.push_back(point);
    }
  }
}

// In 1-D, where each line is one point.
std::vector<Piece> ends_of(const std::vector<Polyline>& lines, double inside) {
  std::vector<Piece> pieces;
  for (const Polyline& line : lines) {
    const Vec<double, 2> x = to_vec<2>(line.front());
    pieces.push_back({x, x, {}, {inside > x.x ? 1.0 : -1.0}});
  }
  return pieces;
}

void lay_end(const Piece& s, int k, const WallOptions& o, std::vector<WallPoint>& points) {
  if (!o.kind.rows) return points.push_back({{s.a.x, 0}, {1, 0, 0}, 1, k});
  for (double depth = 0.5 * o.spacing; depth < o.reach; depth += o.spacing)
    points.push_back({{s.a.x - s.normal.x * depth, 0}, {1, 0, 0}, o.spacing, k});
}

}  // namespace

WallGeometry lay_walls(int dimension, const std::vector<Polyline>& lines, const WallOptions& o,
                       const Point& inside) {
  const auto pieces = dimension == 1 ? ends_of(lines, inside[0]) : pieces_of(lines, 1e-6 * o.spacing);
  WallGeometry g{{}, {}, PieceBins(pieces, cell * o.spacing)};
  for (const Piece& piece : pieces) g.pieces.push_back({piece});
  for (int k = 0; k < g.bins.size(); ++k) {
    if (dimension == 1) lay_end(pieces[k], k, o, g.points);
    else if (o.kind.rows) lay_rows(g, k, o);
    else lay_face(g.pieces, k, o.spacing, o.kind.corners, g.points);
  }
  if (!o.slip)
    for (WallPoint& point : g.points) point.p[0] = 1, point.p[1] = 0, point.p[2] = 1;
  return g;
}

bool only_right_corners(const std::vector<Polyline>& lines) {
  const std::vector<Piece> all = pieces_of(lines);
  return std::none_of(all.begin(), all.end(), [&](const Piece& s) {
    return s.after >= 0 && std::abs(turn_between(s, all[s.after]) - 0.5 * pi) > 1e-6;
  });
}

}  // namespace freshet
