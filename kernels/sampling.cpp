#include "kernels/sampling.hpp"

namespace freshet {
namespace {

// sum V W is 1 within the water, 1/2 at a straight wall, 1/4 in a corner, and falls to 0 beyond a dry front: there the mean of the
// few particles that reach a point would carry their depth up to 2h ahead of the water.
constexpr double least_cover = 0.25;

double y_of(const Vec<double, 1>&) { return 0; }
double y_of(const Vec<double, 2>& p) { return p.y; }

// Calls visit(j) for the wet particles in the runs around a place.
template <int D, class Visit>
void for_each_near(const SortedWater<D>& water, const Vec<double, D>& place, double distance, const Visit& visit) {
  const double y = y_of(place);
  water.rows.for_each_run(place.x, place.x, y, y, distance, [&](int begin, int end) {
    for (int j = begin; j < end; ++j)
      if ((water.kind.extent(0) == 0 || water.kind(j) == 0) && water.depth(j) > 0) visit(j);
  });
}

}  // namespace

template <int D>
SampledDepth sample_depth(const SortedWater<D>& water, const Vec<double, D>& place) {
  const double y = y_of(place), far = CubicSpline<D>::support * water.rows.largest_h(place.x, place.x, y, y);
  double weight = 0, depth = 0;
  for_each_near(water, place, far, [&](int j) {
    const Vec<double, D> d = at(water.x, j) - place;
    const double inv_h = 1.0 / water.h(j);
    const double w = water.mass(j) / water.depth(j) * power<D>(inv_h) * CubicSpline<D>::at(root(dot(d, d)) * inv_h).w;
    weight += w;
    depth += w * water.depth(j);
  });
  return {depth / larger(weight, least_cover), weight > 0};
}

template <int D>
WetLevels highest_wet_levels(const SortedWater<D>& water, const BedSpline<D>* bed, const Shore<D>& shore) {
  WetLevels highest;
  for_each_near(water, shore.place, shore.radius, [&](int j) {
    const Vec<double, D> x = at(water.x, j), d = x - shore.place;
    if (water.depth(j) < shore.min_depth || dot(d, d) > shore.radius * shore.radius) return;
    const BedPoint<double, D> ground = bed ? bed->at(x) : BedPoint<double, D>{};
    const double rise = shore.spacing * root(dot(ground.slope, ground.slope));
    highest.bed = larger(highest.bed, ground.b);
    highest.line = larger(highest.line, ground.b + smaller(water.depth(j), rise));
  });
  return highest;
}

template SampledDepth sample_depth(const SortedWater<1>&, const Vec<double, 1>&);
template SampledDepth sample_depth(const SortedWater<2>&, const Vec<double, 2>&);
template WetLevels highest_wet_levels(const SortedWater<1>&, const BedSpline<1>*, const Shore<1>&);
template WetLevels highest_wet_levels(const SortedWater<2>&, const BedSpline<2>*, const Shore<2>&);

}  // namespace freshet
