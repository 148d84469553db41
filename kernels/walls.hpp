// Solid walls by modified virtual boundary particles (MVBP, Vacondio 2010, 1.3; corrected (1.8): SWE-FORMULAS section 7).
// A wall is a row of points x_w half a spacing apart. Of each it makes two virtual particles for every fluid particle i
// nearby, x_k = x_i - s (x_i - x_w) with s = 2 and 4, that copy i's state with the velocity mirrored:
// v_k = v_i - 2 P v_i, m_k = m_i (h0/h_i)^(D-1). So a wall term depends on particle i and the geometry alone.
#pragma once
#include <array>
#include <vector>

#include "cellgrid/clusters.hpp"
#include "kernels/smoothing.hpp"

namespace freshet {

// The choice beside it, mirror: particle i's image in each straight piece of wall nearby sees i's real neighbours (the same
// as i seeing their images). Exact for straight walls and right corners whatever the particles' positions; costs one more
// walk over the neighbours of the clusters at a wall.
enum class WallKind { mvbp, mirror };

// A straight piece of wall; the water is on the left of a -> b. In 1-D a is the wall and normal[0] points to the water.
struct WallSegment {
  double a[2], b[2];     // m
  double tangent[2];     // unit
  double normal[2];      // unit, towards the water
  double length;         // m
  double before, after;  // m, how far beyond a and b it still catches particles: behind corners of less than 180 degrees
  int next;              // the segment behind the corner of less than 180 degrees at b; -1 if there is none
};

// How far a position lies on the water's side of a segment; nothing where the segment does not catch it.
template <int D>
KOKKOS_INLINE_FUNCTION double behind(const WallSegment& s, const Vec<double, D>& p, double deepest) {
  double inside = (p.x - s.a[0]) * s.normal[0], along = 0;
  if constexpr (D == 2) {
    inside += (p.y - s.a[1]) * s.normal[1];
    along = (p.x - s.a[0]) * s.tangent[0] + (p.y - s.a[1]) * s.tangent[1];
  }
  const bool caught = inside < 0 && inside > -deepest && along >= -s.before && along <= s.length + s.after;
  return caught ? -inside : 0.0;
}

template <int D>
KOKKOS_INLINE_FUNCTION Vec<double, D> normal_of(const WallSegment& s) {
  Vec<double, D> n;
  n.x = s.normal[0];
  if constexpr (D == 2) n.y = s.normal[1];
  return n;
}

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
  VecField<double, D> x;           // m, wall points
  SymField<double, D> projector;   // P: onto the directions that the wall reflects
  NeighbourView near;              // wall points by cluster
  bool mirror = false;
  Field<int> segment;              // of each wall point
  Kokkos::View<WallSegment*, Memory> segments;
  double deepest = 0;              // m, how far behind a wall a particle is still caught

  // The position, mirrored in every wall that it stands behind.
  KOKKOS_INLINE_FUNCTION Vec<double, D> inside(Vec<double, D> p) const {
    for (int k = 0; k < segments.extent_int(0); ++k)
      p += (2 * behind<D>(segments(k), p, deepest)) * normal_of<D>(segments(k));
    return p;
  }

  // 1 in the lanes that stand before the segment itself, not beside it.
  KOKKOS_FORCEINLINE_FUNCTION static Lane before(const WallSegment&, const Vec<Lane, 1>&) { return 1.0; }
  KOKKOS_FORCEINLINE_FUNCTION static Lane before(const WallSegment& s, const Vec<Lane, 2>& x) {
    const Lane along = (x.x - s.a[0]) * s.tangent[0] + (x.y - s.a[1]) * s.tangent[1];
    return select((Lane(-s.before) < along) & (along < Lane(s.length + s.after)), Lane(1.0), Lane(0.0));
  }

  // mirror: calls see(image, weight) for the images of a cluster in the walls near it; weight is 0 in lanes without one.
  template <class See>
  KOKKOS_INLINE_FUNCTION void for_each_image(int cluster, const Vec<Lane, D>& here, const See& see) const {
    constexpr int most = 4;  // more pieces of wall do not meet within a support
    int found[most], n = 0;
    near.for_each(cluster, [&](int k) {
      bool known = n == most;
      for (int m = 0; m < n; ++m) known = known || found[m] == segment(k);
      if (!known) found[n++] = segment(k);
    });
    for (int a = 0; a < n; ++a) {
      const WallSegment s = segments(found[a]);
      const Image<D> image(s);
      const Lane weight = before(s, here);
      see(image, weight);
      for (int b = 0; b < n; ++b)
        if (found[b] == s.next) see(image.then(Image<D>(segments(s.next))), weight * before(segments(s.next), here));
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
KOKKOS_INLINE_FUNCTION void add_wall(const Vec<V, D>& to_wall, const Vec<V, D>& normal_velocity, const V& inv_h, const V& mass,
                                     WallSums<V, D>& sum) {
  const V r2 = dot(to_wall, to_wall) + tiny_square;
  const V inv_r = rsqrt(r2), r = r2 * inv_r;
  const V per_volume = mass * power<D>(inv_h);
  const V closing = dot(to_wall, normal_velocity);
  for (const double s : {2.0, 4.0}) {
    const auto k = K::at(s * r * inv_h);
    const V f = -k.dw * per_volume * inv_h * inv_r * (1.0 / s);
    sum.density += per_volume * k.w;
    sum.moment += f * (s * s) * r2;
    sum.approach += f * (2.0 * s) * closing;
  }
}

// Whether mirror images are exact for these polylines: every corner is a right one with the water inside.
bool only_right_corners(const std::vector<std::vector<std::array<double, 2>>>& lines);

// Points, projectors and segments of a scene's walls; the list of points near each cluster.
template <int D>
class Walls {
 public:
  // lines: polylines with the water on their left (1-D: one point each). spacing [m] = dx: points lie dx/2 apart.
  // inside: a point of the water, which tells the side of a 1-D wall.
  Walls(const std::vector<std::vector<std::array<double, 2>>>& lines, WallKind kind, double spacing,
        const std::array<double, 2>& inside);

  // Lists the wall points within h (1 + margin) of each cluster (mirror: 2h).
  void find(const ClusterSet& clusters, const VecField<double, D>& x, const Field<double>& h, double margin);

  // Puts particles that crossed a wall back: position and normal velocity reflected. clusters: those of the last find();
  // only particles that were near a wall then are looked at, since none moves further than a fraction of h in a step.
  void reflect(const ClusterSet& clusters, const VecField<double, D>& x, const VecField<double, D>& v,
               const VecField<double, D>& v_pred) const;

  WallView<D> view() const;
  int points() const { return points_.size(); }
  WallKind kind() const { return kind_; }

 private:
  FieldSet points_;
  RowOrder order_;
  NeighbourList near_;
  WallKind kind_;
  Kokkos::View<WallSegment*, Memory> segments_;
  double depth_;  // m, how far behind a wall a particle is still caught
};

}  // namespace freshet
