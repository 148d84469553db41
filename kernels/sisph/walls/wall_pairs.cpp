// Which pairs of particles walls part, and which have images.
#include "cellgrid/parallel/launch.hpp"
#include "kernels/sisph/walls/mirror_walls.hpp"

namespace freshet::sisph {
namespace {

template <int D>
struct WallPairs {
  Nearby<D> nearby;
  MirrorWalls<D> walls;
  Field<int> first;  // slot of the first image that particle i sees

  KOKKOS_INLINE_FUNCTION double support(int i, int j) const {
    return nearby.half * (nearby.h(i) + nearby.h(j));
  }
  // An image is further away than the wall; the largest h around counts, so that both sides of a pair agree.
  KOKKOS_INLINE_FUNCTION bool near_wall(int i) const {
    const Vec<double, D> x = at(nearby.x, i);
    const double y = y_of(x), most = nearby.rows.largest_h(x.x, x.x, y, y);
    return walls.near(x, nearby.half * (nearby.h(i) + most));
  }

  // Calls see(j, image of j, reflection) for all images that particle i pairs with.
  template <class See>
  KOKKOS_INLINE_FUNCTION void for_each_image(int i, const See& see) const {
    const Vec<double, D> xi = at(nearby.x, i);
    const auto from = [&](int j, const Vec<double, D>& xj) FRESHET_INLINE_LAMBDA {
      if (walls.part(xi, xj)) return;
      walls.for_each_image(xi, xj, support(i, j),
                           [&](const Vec<double, D>& image, const Sym<double, D>& r) { see(j, image, r); });
    };
    from(i, xi);
    nearby(i, [&](int j, int) { from(j, at(nearby.x, j)); });
  }

  template <class Put>
  KOKKOS_INLINE_FUNCTION void operator()(int i, const Put& put) const {
    if (!near_wall(i)) return nearby(i, put);
    const Vec<double, D> xi = at(nearby.x, i);
    nearby(i, [&](int j, int slot) {
      if (!walls.part(xi, at(nearby.x, j))) put(j, slot);
    });
    int slot = first(i);
    for_each_image(i, [&](int j, const Vec<double, D>&, const Sym<double, D>&) { put(j, slot++); });
  }
};

SymField<double, 1> symmetric(size_t n, Vec<double, 1>) { return {Field<double>("sisph.reflection", n)}; }
SymField<double, 2> symmetric(size_t n, Vec<double, 2>) {
  return {Field<double>("sisph.reflection", n), Field<double>("sisph.reflection", n),
          Field<double>("sisph.reflection", n)};
}
VecField<double, 1> vectors(size_t n, Vec<double, 1>) { return {Field<double>("sisph.x", n)}; }
VecField<double, 2> vectors(size_t n, Vec<double, 2>) {
  return {Field<double>("sisph.x", n), Field<double>("sisph.y", n)};
}

// Room for so many values where there were `held`: some to spare from the second time on.
size_t roomy(size_t held, int wanted) { return static_cast<size_t>(held > 0 ? wanted + wanted / 4 : wanted); }
KOKKOS_FORCEINLINE_FUNCTION void put(const SymField<double, 1>& f, int k, const Sym<double, 1>& a) {
  f.xx(k) = a.xx;
}
KOKKOS_FORCEINLINE_FUNCTION void put(const SymField<double, 2>& f, int k, const Sym<double, 2>& a) {
  f.xx(k) = a.xx, f.xy(k) = a.xy, f.yy(k) = a.yy;
}

// The first slot of each particle; returns the number of images.
template <int D>
int count_images(int particles, const WallPairs<D>& visit) {
  const Field<int> first = visit.first;
  int count = 0;
  launch(
      "sisph::count_images", Range(0, particles), KOKKOS_LAMBDA(int i) {
        int n = 0;
        if (visit.near_wall(i))
          visit.for_each_image(i, [&](int, const Vec<double, D>&, const Sym<double, D>&) { ++n; });
        first(i) = n;
      });
  Kokkos::parallel_scan(
      "sisph::place_slots", Range(0, particles),
      KOKKOS_LAMBDA(int i, int& sum, bool last) {
        const int here = first(i);
        if (last) first(i) = particles + sum;
        sum += here;
      },
      count);
  return count;
}

}  // namespace

template <int D>
void list_wall_pairs(int particles, const PairRequest<D>& request, const MirrorWalls<D>& walls, Pairs& pairs,
                     ImageLists<D>& lists) {
  Images<D>& images = lists.images;
  images.first = particles;
  if (!walls.given()) return pairs.build<D>(particles, request);
  if (lists.first.extent_int(0) < particles)
    lists.first = Field<int>("sisph.first_image", static_cast<size_t>(particles));
  const WallPairs<D> visit{Nearby<D>(request), walls, lists.first};
  images.count = count_images(particles, visit);
  pairs.list(particles, request.rows, visit, images.count > 0);
  if (images.source.extent_int(0) < images.count) {
    const size_t room = roomy(images.source.extent(0), images.count);
    images.source = Field<int>("sisph.image_source", room);
    images.reflection = symmetric(room, Vec<double, D>{});
  }
  const Images<D> found = images;
  launch(
      "sisph::list_images", Range(0, particles), KOKKOS_LAMBDA(int i) {
        if (!visit.near_wall(i)) return;
        int k = visit.first(i) - found.first;
        visit.for_each_image(i, [&](int j, const Vec<double, D>&, const Sym<double, D>& r) {
          found.source(k) = j;
          put(found.reflection, k++, r);
        });
      });
}

template <int D>
VecField<double, D> place_images(int particles, const PairRequest<D>& request, const MirrorWalls<D>& walls,
                                 ImageLists<D>& lists) {
  const Images<D>& images = lists.images;
  if (images.count == 0) return request.x;
  if (lists.x.x.extent_int(0) < images.slots() + lanes)
    lists.x = vectors(roomy(lists.x.x.extent(0), images.slots()) + lanes, Vec<double, D>{});
  const VecField<double, D> from = request.x, to = lists.x;
  launch(
      "sisph::copy_places", Range(0, particles), KOKKOS_LAMBDA(int i) { freshet::put(to, i, at(from, i)); });
  // Each image stands where the pair that it belongs to sees it: in the order in which they were listed.
  const WallPairs<D> visit{Nearby<D>(request), walls, lists.first};
  launch(
      "sisph::place_images", Range(0, particles), KOKKOS_LAMBDA(int i) {
        if (!visit.near_wall(i)) return;
        int slot = visit.first(i);
        visit.for_each_image(i, [&](int, const Vec<double, D>& image, const Sym<double, D>&) {
          freshet::put(to, slot++, image);
        });
      });
  return to;
}

template void list_wall_pairs(int, const PairRequest<1>&, const MirrorWalls<1>&, Pairs&, ImageLists<1>&);
template void list_wall_pairs(int, const PairRequest<2>&, const MirrorWalls<2>&, Pairs&, ImageLists<2>&);
template VecField<double, 1> place_images(int, const PairRequest<1>&, const MirrorWalls<1>&, ImageLists<1>&);
template VecField<double, 2> place_images(int, const PairRequest<2>&, const MirrorWalls<2>&, ImageLists<2>&);

}  // namespace freshet::sisph
