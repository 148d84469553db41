// Solid walls by modified virtual boundary particles (MVBP, Vacondio 2010, 1.3; corrected (1.8): SWE-FORMULAS section 7).
// A wall is a row of points x_w half a spacing apart. Of each it makes two virtual particles for every fluid particle i
// nearby, x_k = x_i - s (x_i - x_w) with s = 2 and 4, that copy i's state with the velocity mirrored:
// v_k = v_i - 2 P v_i, m_k = m_i (h0/h_i)^(D-1). So a wall term depends on particle i and the geometry alone.
#pragma once
#include <vector>

#include "cellgrid/clusters.hpp"
#include "kernels/smoothing.hpp"

namespace freshet {

// A straight piece of wall; the water is on the left of a -> b. In 1-D a is the wall and normal[0] points to the water.
struct WallSegment {
  double a[2], b[2];     // m
  double tangent[2];     // unit
  double normal[2];      // unit, towards the water
  double length;         // m
  double before, after;  // m, how far beyond a and b it still catches particles: behind corners of less than 180 degrees
};

template <int D>
struct WallView {
  bool on = false;
  VecField<double, D> x;           // m, wall points
  SymField<double, D> projector;   // P: onto the directions that the wall reflects
  NeighbourView near;              // wall points by cluster
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

// Points, projectors and segments of a scene's walls; the list of points near each cluster.
template <int D>
class Walls {
 public:
  // lines: polylines with the water on their left (1-D: one point each). spacing [m] = dx: points lie dx/2 apart.
  // inside: a point of the water, which tells the side of a 1-D wall.
  Walls(const std::vector<std::vector<std::array<double, 2>>>& lines, double spacing, const std::array<double, 2>& inside);

  // Lists the wall points within h (1 + margin) of each cluster.
  void find(const ClusterSet& clusters, const VecField<double, D>& x, const Field<double>& h, double margin);

  // Puts particles that crossed a wall back: position and normal velocity reflected. clusters: those of the last find();
  // only particles that were near a wall then are looked at, since none moves further than a fraction of h in a step.
  void reflect(const ClusterSet& clusters, const VecField<double, D>& x, const VecField<double, D>& v,
               const VecField<double, D>& v_pred) const;

  WallView<D> view() const;
  int points() const { return points_.size(); }

 private:
  FieldSet points_;
  RowOrder order_;
  NeighbourList near_;
  Kokkos::View<WallSegment*, Memory> segments_;
  double depth_;  // m, how far behind a wall a particle is still caught
};

}  // namespace freshet
