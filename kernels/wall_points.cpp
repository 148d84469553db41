#include "kernels/wall_points.hpp"

#include <algorithm>
#include <cmath>

namespace freshet {
namespace {

constexpr double small_turn = 0.5;  // rad: below it two pieces are one curve, not a corner
constexpr double cell = 4;          // x spacing: of the bins of segments, as wide as what is asked of them

WallSegment segment_between(const std::array<double, 2>& a, const std::array<double, 2>& b) {
  WallSegment s{{a[0], a[1]}, {b[0], b[1]}, {}, {}, std::hypot(b[0] - a[0], b[1] - a[1]), 0, 0, 0, 0, -1};
  for (int k = 0; k < 2; ++k) s.tangent[k] = (s.b[k] - s.a[k]) / s.length;
  s.normal[0] = -s.tangent[1];
  s.normal[1] = s.tangent[0];
  return s;
}

// Angle from s to t, positive where the water is inside the corner (less than 180 degrees).
double turn_between(const WallSegment& s, const WallSegment& t) {
  return std::atan2(s.tangent[0] * t.tangent[1] - s.tangent[1] * t.tangent[0],
                    s.tangent[0] * t.tangent[0] + s.tangent[1] * t.tangent[1]);
}

// Projector of a point between two segments: the eigenvalues of n1 n1^T + n2 n2^T cut at one, so that it turns from
// n n^T (straight wall) to the identity (right corner: the image through it moves exactly opposite).
WallPoint corner_point(const double* x, const WallSegment& s, const WallSegment& t, int segment) {
  const double bx = s.normal[0] + t.normal[0], by = s.normal[1] + t.normal[1], length = std::hypot(bx, by);
  if (length < 1e-9) return {{x[0], x[1]}, {1, 0, 1}, 1, segment};
  const double nx = bx / length, ny = by / length;
  const double cosine = s.normal[0] * t.normal[0] + s.normal[1] * t.normal[1];
  const double across = std::fmin(1.0, 1 + cosine), along = std::fmin(1.0, 1 - cosine);
  return {{x[0], x[1]},
          {across * nx * nx + along * ny * ny, (across - along) * nx * ny, across * ny * ny + along * nx * nx},
          1,
          segment};
}

// A point `along` the segment from a, `depth` behind it.
WallPoint face_point(const WallSegment& s, double along, double depth, int segment) {
  const double *n = s.normal, *e = s.tangent;
  return {{s.a[0] + along * e[0] - depth * n[0], s.a[1] + along * e[1] - depth * n[1]},
          {n[0] * n[0], n[0] * n[1], n[1] * n[1]},
          1,
          segment};
}

double distance(const double* x, const WallSegment& s) {
  const double rx = x[0] - s.a[0], ry = x[1] - s.a[1];
  const double along = std::clamp(rx * s.tangent[0] + ry * s.tangent[1], 0.0, s.length);
  return std::hypot(rx - along * s.tangent[0], ry - along * s.tangent[1]);
}

// One polyline's segments, first .. first + count - 1 of all.
struct Chain {
  int first, count;
  bool closed;
  int behind(int k) const { return k + 1 < first + count ? k + 1 : (closed ? first : -1); }
  int ahead(int k) const { return k > first ? k - 1 : (closed ? first + count - 1 : -1); }
};

// Corners of less than 180 degrees: images of one wall are seen beyond the corner, and in both walls together.
void join_corner(std::vector<WallSegment>& all, int k, int next, double step) {
  if (turn_between(all[k], all[next]) <= small_turn) return;
  all[k].after = all[k].see_b = all[next].before = all[next].see_a = 4 * step;
  all[k].next = next;
}

double face_step(const WallSegment& s, double spacing) {
  return s.length / std::max(1, static_cast<int>(std::lround(2 * s.length / spacing)));
}

// Wall points about half a spacing apart, with the corner points; each is worth as much as a whole half spacing but where the
// polyline's own pieces are much shorter.
// `extra`: at corners of less than 180 degrees each wall goes on by half a spacing more.
void lay_face(std::vector<WallSegment>& all, const Chain& chain, double spacing, bool extra, std::vector<WallPoint>& points) {
  const auto add = [&](WallPoint point, double length) {
    if (length < 0.4 * spacing) point.share = length / (0.5 * spacing);
    points.push_back(point);
  };
  for (int k = chain.first; k < chain.first + chain.count; ++k) {
    const WallSegment& s = all[k];
    const int next = chain.behind(k);
    const double step = face_step(s, spacing);
    for (double along = step; along < s.length - 0.5 * step; along += step) add(face_point(s, along, 0, k), step);
    if (next >= 0) {
      const double beyond = face_step(all[next], spacing);
      add(corner_point(s.b, s, all[next], k), 0.5 * (step + beyond));
      join_corner(all, k, next, step);
      if (extra && turn_between(s, all[next]) > small_turn) {
        add(face_point(s, s.length + step, 0, k), step);
        add(face_point(all[next], -beyond, 0, next), beyond);
      }
    } else {
      add(face_point(s, s.length, 0, k), step);
    }
    if (chain.ahead(k) < 0) add(face_point(s, 0, 0, k), step);
  }
}

// What of a row's point is this segment's: all, half where another segment is as near, nothing where one is nearer.
double own_part(const WallGeometry& g, int k, const double* x, double spacing) {
  const double own = distance(x, g.segments[k]), tie = 1e-6 * spacing;
  const Box near = box_around(Vec<double, 2>{x[0], x[1]}, own + tie);
  const auto other_within = [&](double reach) {
    return g.bins.any(near, [&](int other) { return other != k && distance(x, g.segments[other]) < reach; });
  };
  if (other_within(own - tie)) return 0;
  return other_within(own + tie) ? 0.5 : 1;
}

// Rows of points behind segment k, on the lattice of its own cells; round corners with the water inside they go on as far as
// they go deep. Along curves the outer rows are longer (the inner ones shorter) by depth x tan(turn/2) at each end.
void lay_rows(WallGeometry& g, const Chain& chain, int k, const WallOptions& o) {
  const std::vector<WallSegment>& all = g.segments;
  const WallSegment& s = all[k];
  const int cells = std::max(1, static_cast<int>(std::lround(s.length / o.spacing)));
  const int rows = static_cast<int>(std::ceil(o.reach / o.spacing)), next = chain.behind(k), previous = chain.ahead(k);
  const double at_a = previous >= 0 ? turn_between(all[previous], s) : 0, at_b = next >= 0 ? turn_between(s, all[next]) : 0;
  const double step = s.length / cells;
  double stretch = 0;
  for (const double turn : {at_a, at_b}) stretch += std::abs(turn) < small_turn ? std::tan(turn / 2) : 0;
  for (int row = 0; row < rows; ++row) {
    const double depth = (row + 0.5) * o.spacing, curved = std::max(0.0, 1 + depth * stretch / s.length);
    for (int i = at_a > small_turn ? -rows : 0; i < (at_b > small_turn ? cells + rows : cells); ++i) {
      WallPoint point = face_point(s, (i + 0.5) * step, depth, k);
      if (i < 0 || i >= cells) {
        const WallPoint corner = corner_point(s.a, i < 0 ? all[previous] : s, i < 0 ? s : all[next], k);
        std::copy(corner.p, corner.p + 3, point.p);
      }
      point.share = own_part(g, k, point.x, o.spacing) * step * o.spacing * curved;
      if (point.share > 0) g.points.push_back(point);
    }
  }
}

SegmentBins bins_of(const std::vector<WallSegment>& segments, double finest) {
  std::vector<SegmentBins::Ends> ends;
  for (const WallSegment& s : segments) ends.push_back({{s.a[0], s.a[1]}, {s.b[0], s.b[1]}});
  return SegmentBins(ends, finest);
}

WallGeometry lay_ends(const std::vector<WallLine>& lines, const WallOptions& o, double inside) {
  WallGeometry g;
  for (const WallLine& line : lines) {
    const double x = line.front()[0], side = inside > x ? 1.0 : -1.0;
    const int segment = static_cast<int>(g.segments.size());
    if (o.kind.rows)
      for (double depth = 0.5 * o.spacing; depth < o.reach; depth += o.spacing)
        g.points.push_back({{x - side * depth, 0}, {1, 0, 0}, o.spacing, segment});
    else
      g.points.push_back({{x, 0}, {1, 0, 0}, 1, segment});
    g.segments.push_back({{x, 0}, {x, 0}, {0, 0}, {side, 0}, 0, 0, 0, 0, 0, -1});
  }
  g.bins = bins_of(g.segments, cell * o.spacing);
  return g;
}

WallGeometry lay_lines(const std::vector<WallLine>& lines, const WallOptions& o) {
  WallGeometry g;
  std::vector<Chain> chains;
  for (const WallLine& line : lines) {
    const bool closed = line.size() > 2 && std::hypot(line.front()[0] - line.back()[0], line.front()[1] - line.back()[1]) < 1e-6 * o.spacing;
    chains.push_back({static_cast<int>(g.segments.size()), static_cast<int>(line.size()) - 1, closed});
    for (size_t k = 0; k + 1 < line.size(); ++k) g.segments.push_back(segment_between(line[k], line[k + 1]));
    if (closed || line.size() < 2) continue;
    g.segments[static_cast<size_t>(chains.back().first)].see_a = g.segments.back().see_b = free_end;
  }
  g.bins = bins_of(g.segments, cell * o.spacing);
  for (const Chain& chain : chains) {
    if (!o.kind.rows) lay_face(g.segments, chain, o.spacing, o.kind.corners, g.points);
    for (int k = chain.first; o.kind.rows && k < chain.first + chain.count; ++k)
      lay_rows(g, chain, k, o);
  }
  return g;
}

}  // namespace

WallGeometry lay_walls(int dimension, const std::vector<WallLine>& lines, const WallOptions& options,
                       const std::array<double, 2>& inside) {
  WallGeometry g = dimension == 1 ? lay_ends(lines, options, inside[0]) : lay_lines(lines, options);
  if (!options.slip)
    for (WallPoint& point : g.points) point.p[0] = 1, point.p[1] = 0, point.p[2] = 1;
  return g;
}

bool only_right_corners(const std::vector<WallLine>& lines) {
  for (const WallLine& line : lines) {
    const bool closed = line.size() > 2 && line.front() == line.back();
    for (size_t k = 0; k + 2 < line.size() + closed; ++k) {
      const WallSegment s = segment_between(line[k], line[k + 1]);
      const WallSegment t = k + 2 < line.size() ? segment_between(line[k + 1], line[k + 2]) : segment_between(line[0], line[1]);
      if (std::abs(turn_between(s, t) - std::acos(0.0)) > 1e-6) return false;
    }
  }
  return true;
}

}  // namespace freshet
