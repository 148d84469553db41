// Walls by mirror pairs (docs/formulas/sisph.md (I7)): every pair (i, j) near a wall, i = j included, has a
// second one (i, image of j), the image in the plane that touches the wall at the point nearest to the middle
// of i and j. The middle is the same for (j, i), so |x_i - x_j'| = |x_j - x_i'|: coefficients stay symmetric
// and fluxes antisymmetric, mass is kept to round-off. Walls with right-angled corners (the water inside)
// also have the image through the corner. Pairs that a wall separates are none.
#pragma once
#include <array>
#include <functional>
#include <vector>

#include "cellgrid/pairs.hpp"
#include "kernels/segment_bins.hpp"
#include "kernels/sisph/images.hpp"

namespace freshet::sisph {

using Polyline = std::vector<std::array<double, 2>>;  // m, the water on its left; closed if it ends where it begins; 1-D: one point

// Straight pieces in chains: along a chain only the nearest point reflects, at corners with the water inside chains end.
template <int D>
class MirrorWalls {
 public:
  MirrorWalls() = default;  // no walls
  // Ends that meet no other wall go on straight for `beyond` [m], more than a support, where goes_on(end): sides of the domain, where openings begin.
  using Ends = std::function<bool(const std::array<double, 2>&)>;
  MirrorWalls(const std::vector<Polyline>& lines, double beyond, const Ends& goes_on = [](const auto&) { return true; });

  KOKKOS_FORCEINLINE_FUNCTION bool given() const { return pieces_.size() > 0 || corners_.size() > 0; }
  int slanting_corners() const { return slanting_; }  // corners with the water inside that are not right ones: no image through them

  // Whether a wall may matter to a particle: one is nearer than the distance.
  KOKKOS_INLINE_FUNCTION bool near(const Vec<double, D>& x, double distance) const;

  // Calls see(image of xj, reflection) for the images of the pair that lie nearer to xi than the support [m].
  template <class See>
  KOKKOS_FORCEINLINE_FUNCTION void for_each_image(const Vec<double, D>& xi, const Vec<double, D>& xj, double support,
                                                  const See& see) const;

  // Whether a wall stands between the two.
  KOKKOS_INLINE_FUNCTION bool part(const Vec<double, D>& xi, const Vec<double, D>& xj) const;

 private:
  struct Plane {
    double q[2] = {0, 0}, m[2] = {0, 0};  // a point of it, and its normal towards the water
    double square = 1e300;                // m2, distance
    bool valid = false;
  };
  enum End : int { at_a = 1, at_b = 2 };
  // Of the first chain from `chain` on that has pieces in the box; chain becomes the next one there, -1: none.
  KOKKOS_FORCEINLINE_FUNCTION Plane nearest(const Box& box, double x, double y, int& chain) const;

  int slanting_ = 0;
  SegmentBins pieces_, corners_;         // where pieces and corners are
  Field<int> chain_;                     // of pieces: whose they are; one chain's follow each other
  Field<double> ax_, ay_, tx_, ty_, length_;  // of pieces: start [m], unit tangent, length [m]
  Field<int> end_;                       // of pieces: at which ends an open chain ends, at_a | at_b
  Field<double> corner_;                 // x, y, and both normals: six values each; 1-D: x
};

// Images, and what finding them needs; listing again keeps the room that there is, more is made with some to spare.
template <int D>
struct ImageLists {
  Images<D> images;    // of the last listing; their fields may be longer
  Field<int> first;    // slot of the first image that particle i sees
  VecField<double, D> x;  // m
};

// Lists the pairs of all particles, those with images included, and finds the images' sources and reflections.
template <int D>
void list_wall_pairs(int particles, const PairRequest<D>& request, const MirrorWalls<D>& walls, Pairs& pairs, ImageLists<D>& lists);

// The places of particles and, behind them, of the images of the last listing: lists.x, or the request's own where there are none.
template <int D>
VecField<double, D> place_images(int particles, const PairRequest<D>& request, const MirrorWalls<D>& walls, ImageLists<D>& lists);

namespace detail {
KOKKOS_FORCEINLINE_FUNCTION double second(const Vec<double, 1>&) { return 0; }
KOKKOS_FORCEINLINE_FUNCTION double second(const Vec<double, 2>& a) { return a.y; }
KOKKOS_FORCEINLINE_FUNCTION Vec<double, 1> make(double x, double, Vec<double, 1>) { return {x}; }
KOKKOS_FORCEINLINE_FUNCTION Vec<double, 2> make(double x, double y, Vec<double, 2>) { return {x, y}; }
KOKKOS_FORCEINLINE_FUNCTION Sym<double, 1> mirror(double, double, Vec<double, 1>) { return {-1.0}; }
KOKKOS_FORCEINLINE_FUNCTION Sym<double, 2> mirror(double mx, double my, Vec<double, 2>) {
  return {1 - 2 * mx * mx, -2 * mx * my, 1 - 2 * my * my};
}
KOKKOS_FORCEINLINE_FUNCTION Sym<double, 1> invert(Vec<double, 1>) { return {-1.0}; }
KOKKOS_FORCEINLINE_FUNCTION Sym<double, 2> invert(Vec<double, 2>) { return {-1.0, 0.0, -1.0}; }
}  // namespace detail

// The wall's nearest point; at a bend with the water outside (270 degrees) the plane stands across the line to it. A place beside
// an end of an open chain sees none.
template <int D>
KOKKOS_FORCEINLINE_FUNCTION typename MirrorWalls<D>::Plane MirrorWalls<D>::nearest(const Box& box, double x, double y,
                                                                                   int& chain) const {
  constexpr int none = 0x7fffffff;
  Plane best{{0, 0}, {0, 0}, 1e300, false};
  int here = none, next = none, nearest = none;
  pieces_.any(box, [&](int k) {  // in any order: of pieces equally near the first one counts
    const int whose = chain_(k);
    if (whose < chain) return false;
    if (whose < here) {
      next = here;
      here = whose;
      best.square = 1e300;
    } else if (whose > here) {
      next = smaller(next, whose);
      return false;
    }
    const double dx = x - ax_(k), dy = y - ay_(k), along = dx * tx_(k) + dy * ty_(k);
    const double s = smaller(larger(along, 0.0), length_(k)), px = dx - s * tx_(k), py = dy - s * ty_(k);
    const double square = px * px + py * py;
    if (!(square < best.square || (square == best.square && k < nearest))) return false;
    nearest = k;
    const bool inside = along > 0 && along < length_(k);
    const double per = inside || square == 0 ? 0 : 1 / root(square);
    const bool past_end = ((end_(k) & at_a) && along < 0) || ((end_(k) & at_b) && along > length_(k));
    const double side = -ty_(k) * dx + tx_(k) * dy;  // > 0: on the water's side
    best = {{ax_(k) + s * tx_(k), ay_(k) + s * ty_(k)},
            {per > 0 ? per * px : -ty_(k), per > 0 ? per * py : tx_(k)},
            square, side > 0 && !past_end};
    return false;
  });
  chain = next == none ? -1 : next;
  return best;
}

template <int D>
KOKKOS_INLINE_FUNCTION bool MirrorWalls<D>::near(const Vec<double, D>& x, double distance) const {
  const double px = x.x, py = detail::second(x);
  if constexpr (D == 1) {
    return corners_.any(box_around(x, distance), [&](int k) { return ::fabs(px - corner_(k)) < distance; });
  }
  return pieces_.any(box_around(x, distance), [&](int k) {
    const double dx = px - ax_(k), dy = py - ay_(k), s = smaller(larger(dx * tx_(k) + dy * ty_(k), 0.0), length_(k));
    const double ox = dx - s * tx_(k), oy = dy - s * ty_(k);
    return ox * ox + oy * oy < distance * distance;
  });
}

// An image is nearer than the support, so that its plane is within half of that of the middle. Inlined, so that the
// compiler sees where xj is xi: a particle's own image is simpler.
template <int D>
template <class See>
KOKKOS_FORCEINLINE_FUNCTION void MirrorWalls<D>::for_each_image(const Vec<double, D>& xi, const Vec<double, D>& xj,
                                                                double support, const See& see) const {
  const Vec<double, D> middle = 0.5 * (xi + xj), like{};
  const double limit = support * support;
  const Box near = box_around(middle, 0.5 * (1 + 1e-6) * support);
  for (int chain = 0; chain >= 0;) {
    const Plane p = nearest(near, middle.x, detail::second(middle), chain);
    if (!p.valid) continue;
    const Vec<double, D> q = detail::make(p.q[0], p.q[1], like), m = detail::make(p.m[0], p.m[1], like);
    const double away_i = dot(m, xi - q), away_j = dot(m, xj - q);
    if (!(away_i > 0) || !(away_j > 0)) continue;
    const Vec<double, D> image = xj - (2 * away_j) * m, d = image - xi;
    if (dot(d, d) < limit) see(image, detail::mirror(p.m[0], p.m[1], like));
  }
  corners_.for_each(near, [&](int k) {
    const int at = D == 2 ? 6 * k : k;
    const Vec<double, D> corner = detail::make(corner_(at), D == 2 ? corner_(at + 1) : 0.0, like);
    const Vec<double, D> off = middle - corner, image = 2.0 * corner - xj, d = image - xi;
    bool inside = true;
    if constexpr (D == 2)
      inside = corner_(at + 2) * off.x + corner_(at + 3) * off.y > 0 && corner_(at + 4) * off.x + corner_(at + 5) * off.y > 0;
    if (inside && dot(d, d) < limit) see(image, detail::invert(like));
  });
}

template <int D>
KOKKOS_INLINE_FUNCTION bool MirrorWalls<D>::part(const Vec<double, D>& xi, const Vec<double, D>& xj) const {
  const Box way = box_between(xi, xj);
  if constexpr (D == 1)
    return corners_.any(way, [&](int k) { return (xi.x - corner_(k)) * (xj.x - corner_(k)) < 0; });
  const double ix = xi.x, iy = detail::second(xi), jx = xj.x, jy = detail::second(xj);
  return pieces_.any(way, [&](int k) {
    const double side_i = tx_(k) * (iy - ay_(k)) - ty_(k) * (ix - ax_(k)), side_j = tx_(k) * (jy - ay_(k)) - ty_(k) * (jx - ax_(k));
    if (side_i * side_j >= 0) return false;
    const double f = side_i / (side_i - side_j);  // of the way from i to j
    const double along = tx_(k) * (ix + f * (jx - ix) - ax_(k)) + ty_(k) * (iy + f * (jy - iy) - ay_(k));
    return along >= 0 && along <= length_(k);
  });
}

}  // namespace freshet::sisph
