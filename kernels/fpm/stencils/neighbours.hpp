// Who is near whom in FPM: for each cluster of points the list of those within h of any of its lanes. One
// list per step serves the stencils, the elliptic rows and all operators, which take a pair's geometry from
// the positions again (cheaper than memory).
#pragma once
#include "cellgrid/particles/clusters.hpp"
#include "cellgrid/particles/near.hpp"
#include "kernels/fpm/stencils/mls.hpp"

namespace freshet::fpm {

// The shortest of the ways that d stands for; length 0: there is but one.
KOKKOS_FORCEINLINE_FUNCTION Lane shortest(const Lane& d, double length) {
  const Lane half(length > 0 ? 0.5 * length : 1e300), round(length);
  return d - select(half < d, round, Lane(0.0)) + select(d < -half, round, Lane(0.0));
}
KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, 2> shortest(const Vec<Lane, 2>& d, const Period& period) {
  return {shortest(d.x, period.length.x), shortest(d.y, period.length.y)};
}

// The points and their lists as the device sees them.
template <int D>
struct Neighbourhood {
  ClusterSet clusters;
  NeighbourView near;
  VecField<double, D> x;  // m
  Field<double> h;        // m, support
  Period period;
  int points = 0;

  // Calls see(j, m, w) for the cluster's listed j; w = 0 in lanes that j is no neighbour of, itself included.
  template <class See>
  KOKKOS_FORCEINLINE_FUNCTION void for_each(int c, const See& see) const {
    const Lanes me = clusters(c);
    const Vec<Lane, D> xi = me.load(x);
    const Lane per_h = 1.0 / me.load(h);
    near.for_each(c, [&](int j) {
      const Vec<Lane, D> s = per_h * shortest(broadcast(at(x, j)) - xi, period);
      const Lane r2 = dot(s, s);
      see(j, basis(s), select(Lane(tiny_square) < r2, weight(r2), Lane(0.0)));
    });
  }

  // 1 in lanes with a point nearer than `part` of the support, itself included, that is one of those asked
  // for, else 0.
  template <class IsOne>
  KOKKOS_FORCEINLINE_FUNCTION Lane any_near(int c, double part, const IsOne& is_one) const {
    const Lanes me = clusters(c);
    const Vec<Lane, D> xi = me.load(x);
    const Lane far = part * me.load(h), far2 = far * far;
    Lane yes{0.0};
    near.for_each(c, [&](int j) {
      if (!is_one(j)) return;
      const Vec<Lane, D> d = shortest(broadcast(at(x, j)) - xi, period);
      yes = select(dot(d, d) < far2, Lane(1.0), yes);
    });
    return yes;
  }
};

// Makes the lists; keeps its memory from step to step.
template <int D>
class NeighbourFinder {
 public:
  // x [m] and h [m] in the order of rows. A periodic domain is longer than 2 h.
  const Neighbourhood<D>& find(const Rows& rows, const VecField<double, D>& x, const Field<double>& h,
                               int points, const Period& period = {});
  const Neighbourhood<D>& view() const { return view_; }

 private:
  void reserve(int clusters);

  Neighbourhood<D> view_;
  int slab_ = 96;
};

}  // namespace freshet::fpm
