#include "kernels/walls.hpp"

#include <array>
#include <cmath>

namespace freshet {
namespace {

using Line = std::vector<std::array<double, 2>>;

struct WallPoint {
  double x[2];
  double p[3];  // projector xx, xy, yy
  int segment;
};

WallSegment segment_between(const std::array<double, 2>& a, const std::array<double, 2>& b) {
  WallSegment s{{a[0], a[1]}, {b[0], b[1]}, {}, {}, std::hypot(b[0] - a[0], b[1] - a[1]), 0, 0, -1};
  for (int k = 0; k < 2; ++k) s.tangent[k] = (s.b[k] - s.a[k]) / s.length;
  s.normal[0] = -s.tangent[1];
  s.normal[1] = s.tangent[0];
  return s;
}

// Projector of a point between two segments: the eigenvalues of n1 n1^T + n2 n2^T cut at one, so that it turns from
// n n^T (straight wall) to the identity (right corner: the image through it moves exactly opposite).
WallPoint corner_point(const double* x, const WallSegment& s, const WallSegment& t, int segment) {
  const double bx = s.normal[0] + t.normal[0], by = s.normal[1] + t.normal[1], length = std::hypot(bx, by);
  if (length < 1e-9) return {{x[0], x[1]}, {1, 0, 1}, segment};
  const double nx = bx / length, ny = by / length;
  const double cosine = s.normal[0] * t.normal[0] + s.normal[1] * t.normal[1];
  const double across = std::fmin(1.0, 1 + cosine), along = std::fmin(1.0, 1 - cosine);
  return {{x[0], x[1]},
          {across * nx * nx + along * ny * ny, (across - along) * nx * ny, across * ny * ny + along * nx * nx},
          segment};
}

WallPoint face_point(const WallSegment& s, double along, int segment) {
  const double *n = s.normal, *e = s.tangent;
  return {{s.a[0] + along * e[0], s.a[1] + along * e[1]}, {n[0] * n[0], n[0] * n[1], n[1] * n[1]}, segment};
}

bool same(const double* a, const double* b, double tolerance) { return std::hypot(a[0] - b[0], a[1] - b[1]) < tolerance; }

// A corner of less than 180 degrees: each wall goes on by half a spacing (the two extra points), and behind it both walls
// catch what slips through.
void extend_corner(WallSegment& s, WallSegment& t, int first, int second, double step, std::vector<WallPoint>& points) {
  const double turn = s.tangent[0] * t.tangent[1] - s.tangent[1] * t.tangent[0];
  if (turn <= 1e-9) return;
  points.push_back(face_point(s, s.length + step, first));
  points.push_back(face_point(t, -step, second));
  s.after = t.before = 4 * step;
  s.next = second;
}

// first: the number of the chain's first segment.
void sample_chain(std::vector<WallSegment>& chain, int first, bool closed, double spacing, std::vector<WallPoint>& points) {
  const int n = static_cast<int>(chain.size());
  for (int k = 0; k < n; ++k) {
    WallSegment& s = chain[k];
    const int here = first + k, next = first + (k + 1) % n;
    const int steps = 2 * std::max(1, static_cast<int>(std::lround(s.length / spacing)));  // in step with a lattice
    for (int i = 1; i < steps; ++i) points.push_back(face_point(s, s.length * i / steps, here));
    if (k + 1 < n || closed) {
      WallSegment& t = chain[next - first];
      points.push_back(corner_point(s.b, s, t, here));
      extend_corner(s, t, here, next, s.length / steps, points);
    } else {
      points.push_back(face_point(s, s.length, here));
    }
    if (k == 0 && !closed) points.push_back(face_point(s, 0, here));
  }
}

struct Geometry {
  std::vector<WallPoint> points;
  std::vector<WallSegment> segments;
};

Geometry lay_lines(const std::vector<Line>& lines, double spacing) {
  Geometry g;
  for (const Line& line : lines) {
    std::vector<WallSegment> chain;
    for (size_t k = 0; k + 1 < line.size(); ++k) chain.push_back(segment_between(line[k], line[k + 1]));
    const bool closed = line.size() > 2 && same(line.front().data(), line.back().data(), 1e-6 * spacing);
    sample_chain(chain, static_cast<int>(g.segments.size()), closed, spacing, g.points);
    g.segments.insert(g.segments.end(), chain.begin(), chain.end());
  }
  return g;
}

Geometry lay_ends(const std::vector<Line>& lines, double inside) {
  Geometry g;
  for (const Line& line : lines) {
    const double x = line.front()[0], side = inside > x ? 1.0 : -1.0;
    g.points.push_back({{x, 0}, {1, 0, 0}, static_cast<int>(g.segments.size())});
    g.segments.push_back({{x, 0}, {x, 0}, {0, 0}, {side, 0}, 0, 0, 0, -1});
  }
  return g;
}

template <class T, class F>
void fill(const Field<T>& field, const std::vector<WallPoint>& points, const F& value) {
  auto host = Kokkos::create_mirror_view(field);
  for (size_t k = 0; k < points.size(); ++k) host(k) = value(points[k]);
  Kokkos::deep_copy(field, host);
}

}  // namespace

bool only_right_corners(const std::vector<Line>& lines) {
  for (const Line& line : lines) {
    const bool closed = line.size() > 2 && line.front() == line.back();
    for (size_t k = 0; k + 2 < line.size() + closed; ++k) {
      const WallSegment s = segment_between(line[k], line[k + 1]);
      const WallSegment t = k + 2 < line.size() ? segment_between(line[k + 1], line[k + 2]) : segment_between(line[0], line[1]);
      const double turn = s.tangent[0] * t.tangent[1] - s.tangent[1] * t.tangent[0];
      if (std::abs(turn - 1) > 1e-6) return false;
    }
  }
  return true;
}

template <int D>
Walls<D>::Walls(const std::vector<Line>& lines, WallKind kind, double spacing, const std::array<double, 2>& inside)
    : order_(D, spacing), near_(32), kind_(kind), depth_(2 * spacing) {
  const Geometry g = D == 1 ? lay_ends(lines, inside[0]) : lay_lines(lines, spacing);
  points_ = FieldSet(static_cast<int>(g.points.size()));
  const auto add = [&](const char* name, const auto& value) { fill(points_.real(name, "m", Carry::sort), g.points, value); };
  add("x", [](const WallPoint& w) { return w.x[0]; });
  add("pxx", [](const WallPoint& w) { return w.p[0]; });
  if (D == 2) {
    add("y", [](const WallPoint& w) { return w.x[1]; });
    add("pxy", [](const WallPoint& w) { return w.p[1]; });
    add("pyy", [](const WallPoint& w) { return w.p[2]; });
  }
  fill(points_.integer("segment", "1", Carry::sort), g.points, [](const WallPoint& w) { return w.segment; });
  const Field<int> id = points_.integer("id", "1", Carry::sort);
  Kokkos::parallel_for("walls::number", Range(0, points_.size()), KOKKOS_LAMBDA(int k) { id(k) = k; });
  order_.sort(points_);
  order_.measure_reach(points_, points_.real("h", "m", Carry::no), 1.0);
  segments_ = Kokkos::View<WallSegment*, Memory>("walls.segments", g.segments.size());
  auto host = Kokkos::create_mirror_view(segments_);
  for (size_t k = 0; k < g.segments.size(); ++k) host(k) = g.segments[k];
  Kokkos::deep_copy(segments_, host);
}

template <int D>
WallView<D> Walls<D>::view() const {
  WallView<D> view;
  view.on = true;
  view.near = near_.view();
  view.mirror = kind_ == WallKind::mirror;
  view.segment = points_.integer("segment");
  view.segments = segments_;
  view.deepest = depth_;
  view.x.x = points_.real("x");
  view.projector.xx = points_.real("pxx");
  if constexpr (D == 2) {
    view.x.y = points_.real("y");
    view.projector.xy = points_.real("pxy");
    view.projector.yy = points_.real("pyy");
  }
  return view;
}

template <int D>
void Walls<D>::find(const ClusterSet& clusters, const VecField<double, D>& x, const Field<double>& h, double margin) {
  const double reach = kind_ == WallKind::mirror ? 2.0 : 1.0;  // a neighbour's image may stand right behind the wall
  near_.build<D>(clusters, {x, h, order_.rows(), view().x, points_.real("h"), reach, margin});
}

template <int D>
void Walls<D>::reflect(const ClusterSet& clusters, const VecField<double, D>& x, const VecField<double, D>& v,
                       const VecField<double, D>& v_pred) const {
  const auto segments = segments_;
  const int count = segments.extent_int(0);
  const double deepest = depth_;
  const NeighbourView near = near_.view();
  const ClusterSet sets = clusters;
  Kokkos::parallel_for("walls::reflect", Range(0, clusters.size()), KOKKOS_LAMBDA(int c) {
        if (near.length(c) == 0) return;
        const Lanes me = sets(c);
        for (int i = me.first; i < me.first + me.count; ++i)
          for (int k = 0; k < count; ++k) {
            const double depth = behind<D>(segments(k), at(x, i), deepest);
            if (depth <= 0) continue;
            const Vec<double, D> normal = normal_of<D>(segments(k));
            put(x, i, at(x, i) + (2 * depth) * normal);
            for (const VecField<double, D>& velocity : {v, v_pred}) {
              const double outward = smaller(dot(at(velocity, i), normal), 0.0);
              put(velocity, i, at(velocity, i) + (-2 * outward) * normal);
            }
          }
      });
}

template class Walls<1>;
template class Walls<2>;

}  // namespace freshet
