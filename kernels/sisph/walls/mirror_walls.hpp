// Walls by mirror pairs (docs/formulas/sisph.md (I7)): every pair (i, j) near a wall, i = j included, has a
// second one (i, image of j), the image in the plane that touches the wall at the point nearest to the middle
// of i and j. The middle is the same for (j, i), so |x_i - x_j'| = |x_j - x_i'|: coefficients stay symmetric
// and fluxes antisymmetric, mass is kept to round-off. Walls with right-angled corners (the water inside)
// also have the image through the corner. Pairs that a wall separates are none.
#pragma once
#include <functional>
#include <vector>

#include "cellgrid/particles/pairs.hpp"
#include "kernels/boundaries/walls/piece_bins.hpp"
#include "kernels/sisph/walls/images.hpp"

namespace freshet::sisph {

// Where two walls meet; 1-D: the wall.
struct WallCorner {
  Vec<double, 2> x{};           // m
  Vec<double, 2> normals[2]{};  // of both, towards the water
};

// Straight pieces in chains: along a chain only the nearest point reflects, at corners with the water inside
// chains end.
template <int D>
class MirrorWalls {
 public:
  MirrorWalls() = default;  // no walls
  // Ends that meet no other wall go on straight for `beyond` [m], more than a support, where goes_on(end):
  // sides of the domain, where openings begin.
  using Ends = std::function<bool(const Point&)>;
  MirrorWalls(
      const std::vector<Polyline>& lines, double beyond,
      const Ends& goes_on = [](const auto&) { return true; });

  KOKKOS_FORCEINLINE_FUNCTION bool given() const { return bins_.size() > 0 || corner_bins_.size() > 0; }
  int slanting_corners() const {
    return slanting_;
  }  // corners with the water inside that are not right ones: no image through them

  // Whether a wall may matter to a particle: one is nearer than the distance.
  KOKKOS_INLINE_FUNCTION bool near(const Vec<double, D>& x, double distance) const;

  // Calls see(image of xj, reflection) for the images of the pair that lie nearer to xi than the support [m].
  template <class See>
  KOKKOS_FORCEINLINE_FUNCTION void for_each_image(const Vec<double, D>& xi, const Vec<double, D>& xj,
                                                  double support, const See& see) const;

  // Whether a wall stands between the two.
  KOKKOS_INLINE_FUNCTION bool part(const Vec<double, D>& xi, const Vec<double, D>& xj) const;

 private:
  struct Plane {
    Vec<double, 2> q, m;  // a point of it [m], and its normal towards the water
    bool valid = false;
  };
  // Of the first chain from `chain` on that has pieces in the box; chain becomes the next one there, -1:
  // none.
  KOKKOS_FORCEINLINE_FUNCTION Plane nearest(const Box& box, const Vec<double, 2>& x, int& chain) const;

  int slanting_ = 0;
  PieceBins bins_, corner_bins_;
  Kokkos::View<Piece*, Memory> pieces_;  // those of one chain follow each other; joined along it alone
  Field<int> chain_;                     // of pieces: whose they are
  Kokkos::View<WallCorner*, Memory> corners_;
};

// Images, and what finding them needs; listing again keeps the room that there is, more is made with some to
// spare.
template <int D>
struct ImageLists {
  Images<D> images;       // of the last listing; their fields may be longer
  Field<int> first;       // slot of the first image that particle i sees
  VecField<double, D> x;  // m
};

// Lists the pairs of all particles, those with images included, and finds the images' sources and
// reflections.
template <int D>
void list_wall_pairs(int particles, const PairRequest<D>& request, const MirrorWalls<D>& walls, Pairs& pairs,
                     ImageLists<D>& lists);

// The places of particles and, behind them, of the images of the last listing: lists.x, or the request's own
// where there are none.
template <int D>
VecField<double, D> place_images(int particles, const PairRequest<D>& request, const MirrorWalls<D>& walls,
                                 ImageLists<D>& lists);

namespace detail {
KOKKOS_FORCEINLINE_FUNCTION Sym<double, 1> mirror(double, double, Vec<double, 1>) { return {-1.0}; }
KOKKOS_FORCEINLINE_FUNCTION Sym<double, 2> mirror(double mx, double my, Vec<double, 2>) {
  return {1 - 2 * mx * mx, -2 * mx * my, 1 - 2 * my * my};
}
KOKKOS_FORCEINLINE_FUNCTION Sym<double, 1> invert(Vec<double, 1>) { return {-1.0}; }
KOKKOS_FORCEINLINE_FUNCTION Sym<double, 2> invert(Vec<double, 2>) { return {-1.0, 0.0, -1.0}; }
}  // namespace detail

// The wall's nearest point; at a bend with the water outside (270 degrees) the plane stands across the line
// to it. A place beside an end of an open chain sees none.
template <int D>
KOKKOS_FORCEINLINE_FUNCTION auto MirrorWalls<D>::nearest(const Box& box, const Vec<double, 2>& x,
                                                         int& chain) const -> Plane {
  constexpr int none = 0x7fffffff;
  Plane best;
  double least = 1e300;  // m2
  int here = none, next = none, nearest = none;
  bins_.any(box, [&](int k) {  // in any order: of pieces equally near the first one counts
    const int whose = chain_(k);
    if (whose < chain) return false;
    if (whose < here) {
      next = here;
      here = whose;
      least = 1e300;
    } else if (whose > here) {
      next = smaller(next, whose);
      return false;
    }
    const Piece& s = pieces_(k);
    const Foot<double> f = foot_on(s, x);
    const Vec<double, 2> from = from_nearest(s, x, f.along);
    const double square = dot(from, from);
    if (!(square < least || (square == least && k < nearest))) return false;
    nearest = k;
    least = square;
    const bool inside = (f.along > 0 && f.along < s.length) || square == 0;
    best = {s.a + clamp(f.along, 0.0, s.length) * s.tangent, inside ? s.normal : (1 / root(square)) * from,
            f.off > 0 && !past_free_end(s, f.along)};
    return false;
  });
  chain = next == none ? -1 : next;
  return best;
}

template <int D>
KOKKOS_INLINE_FUNCTION bool MirrorWalls<D>::near(const Vec<double, D>& x, double distance) const {
  if constexpr (D == 1)
    return corner_bins_.any(box_around(x, distance),
                            [&](int k) { return ::fabs(x.x - corners_(k).x.x) < distance; });
  else
    return bins_.any(box_around(x, distance), [&](int k) {
      const Vec<double, 2> from = from_nearest(pieces_(k), x, foot_on(pieces_(k), x).along);
      return dot(from, from) < distance * distance;
    });
}

// An image is nearer than the support, so that its plane is within half of that of the middle. Inlined, so
// that the compiler sees where xj is xi: a particle's own image is simpler.
template <int D>
template <class See>
KOKKOS_FORCEINLINE_FUNCTION void MirrorWalls<D>::for_each_image(const Vec<double, D>& xi,
                                                                const Vec<double, D>& xj, double support,
                                                                const See& see) const {
  const Vec<double, D> middle = 0.5 * (xi + xj), like{};
  const Vec<double, 2> place{middle.x, y_of(middle)};
  const double limit = support * support;
  const Box near = box_around(middle, 0.5 * (1 + 1e-6) * support);
  for (int chain = 0; chain >= 0;) {
    const Plane p = nearest(near, place, chain);
    if (!p.valid) continue;
    const Vec<double, D> q = to_vec<D>(p.q.x, p.q.y), m = to_vec<D>(p.m.x, p.m.y);
    const double away_i = dot(m, xi - q), away_j = dot(m, xj - q);
    if (!(away_i > 0) || !(away_j > 0)) continue;
    const Vec<double, D> image = xj - (2 * away_j) * m, d = image - xi;
    if (dot(d, d) < limit) see(image, detail::mirror(p.m.x, p.m.y, like));
  }
  corner_bins_.for_each(near, [&](int k) {
    const WallCorner& at = corners_(k);
    const Vec<double, D> corner = to_vec<D>(at.x.x, at.x.y), image = 2.0 * corner - xj, d = image - xi;
    const Vec<double, 2> off = place - at.x;
    const bool inside = D == 1 || (dot(at.normals[0], off) > 0 && dot(at.normals[1], off) > 0);
    if (inside && dot(d, d) < limit) see(image, detail::invert(like));
  });
}

template <int D>
KOKKOS_INLINE_FUNCTION bool MirrorWalls<D>::part(const Vec<double, D>& xi, const Vec<double, D>& xj) const {
  const Box way = box_between(xi, xj);
  if constexpr (D == 1)
    return corner_bins_.any(way,
                            [&](int k) { return (xi.x - corners_(k).x.x) * (xj.x - corners_(k).x.x) < 0; });
  else return bins_.any(way, [&](int k) { return crosses(pieces_(k), xi, xj); });
}

}  // namespace freshet::sisph
