// Solid walls along polylines, the water on their left. In all kinds but `mirror` a wall is a set of virtual
// particles that copy the state of the fluid particle i that looks at them, with the velocity mirrored,
// v_k = v_i - 2 P v_i: a wall term depends on i and the geometry alone.
//   vbp     x_k = x_i - 2 (x_i - x_w) for wall points x_w half a spacing apart, m_k = m_i (h0/h_i)^(D-1)
//   (thesis 1.2) mvbp    also x_k = x_i - 4 (x_i - x_w), and two points more at corners (thesis 1.3; (1.8)
//   corrected:
//           docs/formulas/swe.md (S30))
//   rows    fixed points on rows dx/2, 3 dx/2, ... behind the wall, m_k = rho_i x the area that a point
//   stands for mirror  i's image in each straight piece of wall nearby sees i's real neighbours (the same as
//   i seeing their images).
//           Exact for straight walls and right corners whatever the particles' positions; wrong at corners of
//           more than 180 degrees. Costs one more walk over the neighbours of the clusters at a wall.
//   none    nothing but the reflection of what crosses the line
#pragma once
#include "cellgrid/particles/clusters.hpp"
#include "kernels/boundaries/walls/points.hpp"
#include "kernels/smoothing/smoothing.hpp"

namespace freshet {

template <int D>
KOKKOS_INLINE_FUNCTION Vec<double, D> normal_of(const Piece& s) {
  return to_vec<D>(s.normal.x, s.normal.y);
}

// An orthogonal map x -> R x + shift: a reflection in one wall, or in both walls of a corner.
template <int D>
struct Image {
  double r[D][D] = {};
  double shift[D] = {};

  Image() = default;
  explicit KOKKOS_FORCEINLINE_FUNCTION Image(const Piece& s) {
    const double n[2] = {s.normal.x, s.normal.y}, a[2] = {s.a.x, s.a.y};
    double offset = 0;
    for (int k = 0; k < D; ++k) offset += n[k] * a[k];
    for (int k = 0; k < D; ++k) {
      shift[k] = 2 * offset * n[k];
      for (int l = 0; l < D; ++l) r[k][l] = (k == l ? 1.0 : 0.0) - 2 * n[k] * n[l];
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
  KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 1> operator()(const Vec<Lane, 1>& a) const {
    return turn(a) + Vec<Lane, 1>{shift[0]};
  }
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
  VecField<double, D> x;          // m, wall points
  SymField<double, D> projector;  // P: onto the directions that the wall reflects
  Field<double> share;            // of the virtual mass: about 1; rows: the area of each point [m2] (1-D: m)
  NeighbourView near;             // wall points by cluster
  Field<int> piece;               // of each wall point
  Kokkos::View<WallPiece*, Memory> pieces;
  PieceBins bins;      // of the pieces
  double deepest = 0;  // m, how far behind a wall a particle is still caught

  // The position, mirrored in the wall that it stands behind; again in the one behind which that puts it.
  KOKKOS_INLINE_FUNCTION Vec<double, D> inside(Vec<double, D> p) const {
    for (int turns = 0; turns < 4; ++turns) {
      const NearestPiece nearest = nearest_piece(pieces, bins, p, deepest);
      if (nearest.foot.off >= 0) break;
      p += (-2 * nearest.foot.off) * normal_of<D>(pieces(nearest.piece));
    }
    return p;
  }

  // m_k, to be multiplied by the point's share.
  KOKKOS_FORCEINLINE_FUNCTION Lane virtual_mass(Lane m, Lane h0_per_h, Lane rho) const {
    if (rows) return rho;
    return D == 1 ? m : m * h0_per_h;
  }
  // d ln m_k / d ln rho_i: how far virtual masses follow the particle's own depth.
  KOKKOS_FORCEINLINE_FUNCTION double follows_depth() const {
    return !on || mirror ? 0.0 : rows ? 1.0 : (D - 1.0) / D;
  }
  // How often a virtual particle at `s` times the distance of its wall point pushes. Rows push like real
  // particles, whose own sums feel i too; the others as the energy of i alone asks, since dx_k/dx_i = 1 - s.
  KOKKOS_FORCEINLINE_FUNCTION double pushes(double s) const { return rows ? 2.0 : s; }

  // 1 in the lanes that see the images behind the piece: past free ends, where openings begin, all do.
  KOKKOS_FORCEINLINE_FUNCTION static Lane before(const WallPiece&, const Vec<Lane, 1>&) { return 1.0; }
  KOKKOS_FORCEINLINE_FUNCTION static Lane before(const WallPiece& s, const Vec<Lane, 2>& x) {
    constexpr double all = 1e300;  // m
    const Lane along = foot_on(s, x).along, from(s.before < 0 ? -all : -s.beyond_a);
    const Lane to(s.length + (s.after < 0 ? all : s.beyond_b));
    return select((from < along) & (along < to), Lane(1.0), Lane(0.0));
  }

  // How far inside the water the foremost of a cluster's images stands [m]: negative behind the wall.
  KOKKOS_FORCEINLINE_FUNCTION static double foremost(const WallPiece& s, const Vec<Lane, D>& image) {
    return largest(foot_on(s, image).off);
  }

  // Whether the piece mirrors a particle to an image that stands no further than `limit` from it along the
  // normal, measured from the wall: it is on the water's side, not beside the piece (in an opening there).
  KOKKOS_FORCEINLINE_FUNCTION static bool mirrors(const WallPiece& s, const Vec<double, D>& x, double limit) {
    const Foot<double> f = foot_on(s, x);
    if constexpr (D == 1) return f.off < limit;
    return f.off > 0 && f.off < limit && f.along > -s.beyond_a && f.along < s.length + s.beyond_b;
  }

  // mirror: calls see(image, weight, piece) for the images of a cluster in the walls near it; weight is 0 in
  // lanes without one. The image sees the particles that the piece mirrors.
  template <class See>
  KOKKOS_INLINE_FUNCTION void for_each_image(int cluster, const Vec<Lane, D>& here, const See& see) const {
    constexpr int most = 24;  // pieces of wall within a support: two or three, many along a curve
    int found[most], n = 0;
    near.for_each(cluster, [&](int k) {
      bool known = n == most || (n > 0 && found[n - 1] == piece(k));
      for (int m = 0; m < n; ++m) known = known || found[m] == piece(k);
      if (!known) found[n++] = piece(k);
    });
    for (int a = 0; a < n; ++a) {
      const WallPiece s = pieces(found[a]);
      const Image<D> image(s);
      const Lane weight = before(s, here);
      if (!any(Lane(0.0) < weight)) continue;
      see(image, weight, s);
      for (int b = 0; b < n; ++b)
        if (s.beyond_b > 0 && found[b] == s.after)
          see(image.then(Image<D>(pieces(s.after))), weight * before(pieces(s.after), here), s);
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
                                     const Vec<V, D>& normal_velocity, const V& inv_h, const V& mass,
                                     WallSums<V, D>& sum) {
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

// Points, projectors and pieces of a scene's walls; the list of points near each cluster.
template <int D>
class Walls {
 public:
  // inside: a point of the water, which tells the side of a 1-D wall. support: of the kernel, in units of h.
  Walls(const std::vector<Polyline>& lines, const WallOptions& options, const Point& inside, double support);

  // Lists the wall points within reach of each cluster for h (1 + margin); of mirrors also those behind which
  // images of larger neighbours reach further than the particle's own h. near: what was listed of the same
  // water.
  void find(const ClusterSet& clusters, const ListRequest<D>& water, const NeighbourView& near);

  // Puts particles that crossed a wall back: position and normal velocity reflected. clusters: those of the
  // last find(); only particles that were near a wall then are looked at, since none moves further than a
  // fraction of h in a step.
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
  Kokkos::View<WallPiece*, Memory> pieces_;
  PieceBins bins_;
  double depth_;  // m, how far behind a wall a particle is still caught
};

}  // namespace freshet
