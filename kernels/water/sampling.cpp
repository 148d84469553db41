#include "kernels/water/sampling.hpp"

#include <optional>

#include "cellgrid/parallel/launch.hpp"
#include "cellgrid/parallel/types.hpp"

namespace freshet {
namespace {

// sum V W is 1 within the water, 1/2 at a straight wall, 1/4 in a corner, and falls to 0 beyond a dry front:
// there the mean of the few particles that reach a point would carry their depth up to 2h ahead of the water.
constexpr double least_cover = 0.25;

// Calls visit(j) for the wet particles in the runs around a place.
template <int D, class Visit>
KOKKOS_INLINE_FUNCTION void for_each_near(const SortedWater<D>& water, const Vec<double, D>& place,
                                          double distance, const Visit& visit) {
  const double y = y_of(place);
  water.rows.for_each_run(place.x, place.x, y, y, distance, [&](int begin, int end) {
    for (int j = begin; j < end; ++j)
      if ((water.kind.extent(0) == 0 || water.kind(j) == 0) && water.depth(j) > 0) visit(j);
  });
}

template <int D>
KOKKOS_FUNCTION FRESHET_OUT_OF_LINE SampledDepth sample_depth(const SortedWater<D>& water,
                                                              const Vec<double, D>& place) {
  const double y = y_of(place), far = CubicSpline<D>::support * water.rows.largest_h(place.x, place.x, y, y);
  double weight = 0, depth = 0;
  for_each_near(water, place, far, [&](int j) {
    const Vec<double, D> d = at(water.x, j) - place;
    const double inv_h = 1.0 / water.h(j);
    const double w =
        water.mass(j) / water.depth(j) * power<D>(inv_h) * CubicSpline<D>::at(root(dot(d, d)) * inv_h).w;
    weight += w;
    depth += w * water.depth(j);
  });
  return {0, depth / larger(weight, least_cover), weight > 0};
}

template <int D>
struct Raise {
  SortedWater<D> water;
  std::optional<BedSpline<D>> bed;
  double spacing;
  Shores shores;

  KOKKOS_INLINE_FUNCTION void operator()(int k) const {
    const ShorePlace& shore = shores.shore(k);
    const Vec<double, D> place = to_vec<D>(shore.x, shore.y);
    WetLevels highest = shores.highest(k);
    for_each_near(water, place, shore.radius, [&](int j) {
      const Vec<double, D> x = at(water.x, j), d = x - place;
      if (water.depth(j) < shore.min_depth || dot(d, d) > shore.radius * shore.radius) return;
      const BedPoint<double, D> ground = bed ? bed->at(x) : BedPoint<double, D>{};
      const double rise = spacing * root(dot(ground.slope, ground.slope));
      highest.bed = larger(highest.bed, ground.b);
      highest.line = larger(highest.line, ground.b + smaller(water.depth(j), rise));
    });
    shores.highest(k) = highest;
  }
};

template <int D>
std::optional<BedSpline<D>> copy_of(const BedSpline<D>* bed) {
  return bed ? std::optional<BedSpline<D>>(*bed) : std::nullopt;
}

}  // namespace

template <int D>
void Sampler<D>::lay(const std::vector<std::array<double, 2>>& places) {
  if (places == places_) return;
  places_ = places;
  if (place_.extent(0) != places.size()) {
    place_ = Kokkos::View<Vec<double, D>*, Memory>("sampling.place", places.size());
    found_ = Kokkos::View<SampledDepth*, Memory>("sampling.found", places.size());
  }
  const auto host = Kokkos::create_mirror_view(place_);
  for (std::size_t k = 0; k < places.size(); ++k) host(k) = to_vec<D>(places[k]);
  Kokkos::deep_copy(place_, host);
}

template <int D>
std::vector<SampledDepth> Sampler<D>::sample(const SortedWater<D>& water, const BedSpline<D>* bed,
                                             const std::vector<std::array<double, 2>>& places) {
  lay(places);
  const SortedWater<D> sorted = water;
  const std::optional<BedSpline<D>> ground = copy_of(bed);
  const auto place = place_;
  const auto found = found_;
  const int count = place.extent_int(0);
  launch(
      "sampling::depth", Range(0, count), KOKKOS_LAMBDA(int k) {
        found(k) = sample_depth(sorted, place(k));
        found(k).bed = ground ? ground->at(place(k)).b : 0.0;
      });
  const auto host = on_host(found_);
  return {host.data(), host.data() + count};
}

template <int D>
void raise_wet_levels(const SortedWater<D>& water, const BedSpline<D>* bed, double spacing,
                      const Shores& shores) {
  const int count = shores.shore.extent_int(0);
  launch("sampling::run_up", Range(0, count), Raise<D>{water, copy_of(bed), spacing, shores});
}

template class Sampler<1>;
template class Sampler<2>;
template void raise_wet_levels(const SortedWater<1>&, const BedSpline<1>*, double, const Shores&);
template void raise_wet_levels(const SortedWater<2>&, const BedSpline<2>*, double, const Shores&);

}  // namespace freshet
