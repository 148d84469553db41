// Solid walls along polylines, the water on their left. In all kinds but `mirror` a wall is a set of virtual particles that
// copy the state of the fluid particle i that looks at them, with the velocity mirrored, v_k = v_i - 2 P v_i: a wall term
// depends on i and the geometry alone.
//   vbp     x_k = x_i - 2 (x_i - x_w) for wall points x_w half a spacing apart, m_k = m_i (h0/h_i)^(D-1)   (thesis 1.2)
//   mvbp    also x_k = x_i - 4 (x_i - x_w), and two points more at corners (thesis 1.3; (1.8) corrected:
//           docs/formulas/swe.md (S30))
//   rows    fixed points on rows dx/2, 3 dx/2, ... behind the wall, m_k = rho_i x the area that a point stands for
//   mirror  i's image in each straight piece of wall nearby sees i's real neighbours (the same as i seeing their images).
//           Exact for straight walls and right corners whatever the particles' positions; wrong at corners of more than
//           180 degrees. Costs one more walk over the neighbours of the clusters at a wall.
//   none    nothing but the reflection of what crosses the line
#pragma once
#include "cellgrid/clusters.hpp"
#include "kernels/smoothing.hpp"
#include "kernels/wall_points.hpp"

namespace freshet {

// A segment as a position sees it.
struct Side {
  double distance2;  // m2, to its nearest point
  double inside;     // m, on the water's side of its line
};

KOKKOS_INLINE_FUNCTION Side side_of(const WallSegment& s, const Vec<double, 1>& p) {
  const double r = p.x - s.a[0];
  return {r * r, r * s.normal[0]};
}
KOKKOS_INLINE_FUNCTION Side side_of(const WallSegment& s, const Vec<double, 2>& p) {
  const double rx = p.x - s.a[0], ry = p.y - s.a[1];
  const double foot = rx * s.tangent[0] + ry * s.tangent[1], along = clamp(foot, 0.0, s.length);
  const double dx = rx - along * s.tangent[0], dy = ry - along * s.tangent[1];
  const bool beyond = (foot < 0 && s.see_a == free_end) || (foot > s.length && s.see_b == free_end);
  return {beyond ? free_end : dx * dx + dy * dy, rx * s.normal[0] + ry * s.normal[1]};
}

template <int D>
KOKKOS_INLINE_FUNCTION Vec<double, D> normal_of(const WallSegment& s) {
  Vec<double, D> n;
  n.x = s.normal[0];
  if constexpr (D == 2) n.y = s.normal[1];
  return n;
}

// The segment that a position is behind: its nearest one decides; at a corner, where two are equally near, the one whose line
// is farther away.
struct NearestSegment {
  double deepest2;           // m2, as far as a position behind a wall is still caught
  Side side{deepest2, 0};
  int segment = -1;

  KOKKOS_INLINE_FUNCTION void look_at(int k, const Side& here) {
    const double tie = 1e-9 * deepest2;
    const bool same = here.distance2 < side.distance2 + tie && here.inside * here.inside > side.inside * side.inside;
    if (here.distance2 >= side.distance2 - tie && !same) return;
    side = here;
    segment = k;
  }
  KOKKOS_INLINE_FUNCTION int behind() const { return side.inside < 0 ? segment : -1; }
};

// An orthogonal map x -> R x + shift: a reflection in one wall, or in both walls of a corner.
template <int D>
struct Image {
  double r[D][D] = {};
  double shift[D] = {};

  Image() = default;
  explicit KOKKOS_FORCEINLINE_FUNCTION Image(const WallSegment& s) {
    double offset = 0;
    for (int k = 0; k < D; ++k) offset += s.normal[k] * s.a[k];
    for (int k = 0; k < D; ++k) {
      shift[k] = 2 * offset * s.normal[k];
      for (int l = 0; l < D; ++l) r[k][l] = (k == l ? 1.0 : 0.0) - 2 * s.normal[k] * s.normal[l];
    }
  }
  // First this, then the other.
  KOKKOS_FORCEINLINE_FUNCTION Image then(const Image& other) const {
    Image both;
    for (int k = 0; k < D; ++k) {
      both.shift[k] = other.shift[k];
      for (int l = 0; l < D; ++l) {
        both.shift[k] += other.r[k][l] * shift[l];
        for (int m = 0; m < D; ++m) both.r[k][l] += other.r[k][m] * r[m][l];
      }
    }
    return both;
  }

  KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 1> turn(const Vec<Lane, 1>& a) const { return {r[0][0] * a.x}; }
  KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 2> turn(const Vec<Lane, 2>& a) const {
    return {r[0][0] * a.x + r[0][1] * a.y, r[1][0] * a.x + r[1][1] * a.y};
  }
  KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 1> turn_back(const Vec<Lane, 1>& a) const { return turn(a); }
  KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 2> turn_back(const Vec<Lane, 2>& a) const {
    return {r[0][0] * a.x + r[1][0] * a.y, r[0][1] * a.x + r[1][1] * a.y};
  }
  KOKKOS_FORCEINLINE_FUNCTION Sym<Lane, 1> turn(const Sym<Lane, 1>& m) const { return m; }
  KOKKOS_FORCEINLINE_FUNCTION Sym<Lane, 2> turn(const Sym<Lane, 2>& m) const {
    const Vec<Lane, 2> x{r[0][0], r[0][1]}, y{r[1][0], r[1][1]};
    return {quadratic(m, x), dot(x, m * y), quadratic(m, y)};
  }
  KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 1> operator()(const Vec<Lane, 1>& a) const { return turn(a) + Vec<Lane, 1>{shift[0]}; }
  KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 2> operator()(const Vec<Lane, 2>& a) const {
    return turn(a) + Vec<Lane, 2>{shift[0], shift[1]};
  }
};

template <int D>
struct WallView {
  bool on = false;
  bool mirror = false;
  bool rows = false;
  Stretch stretch;
  VecField<double, D> x;           // m, wall points
  SymField<double, D> projector;   // P: onto the directions that the wall reflects
  Field<double> share;             // of the virtual mass: about 1; rows: the area of each point [m2] (1-D: m)
  NeighbourView near;              // wall points by cluster
  Field<int> segment;              // of each wall point
  Kokkos::View<WallSegment*, Memory> segments;
  SegmentBins bins;                // of the segments
  double deepest = 0;              // m, how far behind a wall a particle is still caught

  // The position, mirrored in the wall that it stands behind; again in the one behind which that puts it.
  KOKKOS_INLINE_FUNCTION Vec<double, D> inside(Vec<double, D> p) const {
    constexpr double more = 1 + 1e-6;  // than the ties of NearestSegment
    for (int turns = 0; turns < 4; ++turns) {
      NearestSegment nearest{deepest * deepest};
      bins.for_each(box_around(p, more * deepest), [&](int k) { nearest.look_at(k, side_of(segments(k), p)); });
      if (nearest.behind() < 0) break;
      p += (-2 * nearest.side.inside) * normal_of<D>(segments(nearest.segment));
    }
    return p;
  }

  // m_k, to be multiplied by the point's share.
  KOKKOS_FORCEINLINE_FUNCTION Lane virtual_mass(Lane m, Lane h0_per_h, Lane rho) const {
    if (rows) return rho;
    return D == 1 ? m : m * h0_per_h;
  }
  // d ln m_k / d ln rho_i: how far virtual masses follow the particle's own depth.
  KOKKOS_FORCEINLINE_FUNCTION double follows_depth() const { return !on || mirror ? 0.0 : rows ? 1.0 : (D - 1.0) / D; }
  // How often a virtual particle at `s` times the distance of its wall point pushes. Rows push like real particles, whose own
  // sums feel i too; the others push as the energy of i alone asks, since dx_k/dx_i = 1 - s.
  KOKKOS_FORCEINLINE_FUNCTION double pushes(double s) const { return rows ? 2.0 : s; }

  // 1 in the lanes that see the images behind the segment.
  KOKKOS_FORCEINLINE_FUNCTION static Lane before(const WallSegment&, const Vec<Lane, 1>&) { return 1.0; }
  KOKKOS_FORCEINLINE_FUNCTION static Lane before(const WallSegment& s, const Vec<Lane, 2>& x) {
    const Lane along = (x.x - s.a[0]) * s.tangent[0] + (x.y - s.a[1]) * s.tangent[1];
    return select((Lane(-s.see_a) < along) & (along < Lane(s.length + s.see_b)), Lane(1.0), Lane(0.0));
  }

  // How far inside the water the foremost of a cluster's images stands [m]: negative behind the wall.
  KOKKOS_FORCEINLINE_FUNCTION static double foremost(const WallSegment& s, const Vec<Lane, 1>& image) {
    return largest((image.x - s.a[0]) * s.normal[0]);
  }
  KOKKOS_FORCEINLINE_FUNCTION static double foremost(const WallSegment& s, const Vec<Lane, 2>& image) {
    return largest((image.x - s.a[0]) * s.normal[0] + (image.y - s.a[1]) * s.normal[1]);
  }

  // Whether the segment mirrors a particle to an image that stands no further than `limit` from it along the normal, measured
  // from the wall: it is on the water's side, not beside the segment (in an opening next to it).
  KOKKOS_FORCEINLINE_FUNCTION static bool mirrors(const WallSegment& s, const Vec<double, 1>& x, double limit) {
    return (x.x - s.a[0]) * s.normal[0] < limit;
  }
  KOKKOS_FORCEINLINE_FUNCTION static bool mirrors(const WallSegment& s, const Vec<double, 2>& x, double limit) {
    const double dx = x.x - s.a[0], dy = x.y - s.a[1], inside = dx * s.normal[0] + dy * s.normal[1];
    if (!(inside > 0 && inside < limit)) return false;
    const double along = dx * s.tangent[0] + dy * s.tangent[1];
    return along > -s.before && along < s.length + s.after;
  }

  // mirror: calls see(image, weight, segment) for the images of a cluster in the walls near it; weight is 0 in lanes without
  // one. The image sees the particles that the segment mirrors.
  template <class See>
  KOKKOS_INLINE_FUNCTION void for_each_image(int cluster, const Vec<Lane, D>& here, const See& see) const {
    constexpr int most = 24;  // pieces of wall within a support: two or three, many along a curve
    int found[most], n = 0;
    near.for_each(cluster, [&](int k) {
      bool known = n == most || (n > 0 && found[n - 1] == segment(k));
      for (int m = 0; m < n; ++m) known = known || found[m] == segment(k);
      if (!known) found[n++] = segment(k);
    });
    for (int a = 0; a < n; ++a) {
      const WallSegment s = segments(found[a]);
      const Image<D> image(s);
      const Lane weight = before(s, here);
      if (!any(Lane(0.0) < weight)) continue;
      see(image, weight, s);
      for (int b = 0; b < n; ++b)
        if (found[b] == s.next) see(image.then(Image<D>(segments(s.next))), weight * before(segments(s.next), here), s);
    }
  }
};

template <class V, int D>
struct WallSums {
  V density{0.0};   // sum m_k W
  V moment{0.0};    // sum m_k F r^2,    F = -W'/r
  V approach{0.0};  // sum m_k F x_ik . v_ik
};

// kernels' density pass: what the walls add to particle i's sums. mass is m_k.
template <class K, class V, int D>
KOKKOS_INLINE_FUNCTION void add_wall(const K& kernel, const Stretch& stretch, const Vec<V, D>& to_wall,
                                     const Vec<V, D>& normal_velocity, const V& inv_h, const V& mass, WallSums<V, D>& sum) {
  const V r2 = dot(to_wall, to_wall) + tiny_square;
  const V inv_r = rsqrt(r2), r = r2 * inv_r;
  const V per_volume = mass * power<D>(inv_h);
  const V closing = dot(to_wall, normal_velocity);
  for (int n = 0; n < stretch.count; ++n) {
    const double s = stretch.factor[n];
    const auto k = kernel.at(s * r * inv_h);
    const V f = -k.dw * per_volume * inv_h * inv_r * (1.0 / s);
    sum.density += per_volume * k.w;
    sum.moment += f * (s * s) * r2;
    sum.approach += f * (2.0 * s) * closing;
  }
}

// Points, projectors and segments of a scene's walls; the list of points near each cluster.
template <int D>
class Walls {
 public:
  // inside: a point of the water, which tells the side of a 1-D wall. support: of the kernel, in units of h.
  Walls(const std::vector<WallLine>& lines, const WallOptions& options, const std::array<double, 2>& inside, double support);

  // Lists the wall points within reach of each cluster for h (1 + margin); of mirrors also those behind which images of larger
  // neighbours reach further than the particle's own h. near: what was listed of the same water.
  void find(const ClusterSet& clusters, const ListRequest<D>& water, const NeighbourView& near);

  // Puts particles that crossed a wall back: position and normal velocity reflected. clusters: those of the last find();
  // only particles that were near a wall then are looked at, since none moves further than a fraction of h in a step.
  void reflect(const ClusterSet& clusters, const VecField<double, D>& x, const VecField<double, D>& v,
               const VecField<double, D>& v_pred) const;

  WallView<D> view() const;
  int points() const { return points_.size(); }
  const WallKind& kind() const { return kind_; }

 private:
  FieldSet points_;
  RowOrder order_;
  NeighbourList near_;
  Field<double> felt_h_;  // m, mirror: the largest h of a particle and of those that reach it
  WallKind kind_;
  double reach_;  // x h, how far wall points count
  Kokkos::View<WallSegment*, Memory> segments_;
  SegmentBins bins_;
  double depth_;  // m, how far behind a wall a particle is still caught
};

}  // namespace freshet
