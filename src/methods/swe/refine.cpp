// Splitting and merging as the scene asks for them.
#include <cmath>

#include "src/methods/swe/solver.hpp"

namespace freshet::swe {
namespace {

// elsewhere: where the scene names no limit.
PlacedValue in_metres(const AreaLimit& limit, double cell, double elsewhere) {
  std::vector<ValuedRegion> regions;
  for (const auto& region : limit.regions) regions.push_back({region.corners, region.area * cell});
  return {limit.elsewhere ? *limit.elsewhere * cell : elsewhere, regions};
}

// The largest area named, at least one cell [m^D].
double largest(const AreaLimit& limit, double cell, double area) {
  for (const auto& region : limit.regions) area = std::max(area, region.area * cell);
  return limit.elsewhere ? std::max(area, *limit.elsewhere * cell) : area;
}

// 15 degrees: the corners of neighbours on a square lattice then pass each other at equal distances along x
// and y.
constexpr double turn = pi / 12;

}  // namespace

template <int D>
void ExplicitSph<D>::build_refinement() {
  const auto& split = scene_.split;
  const auto& merge = scene_.merge;
  if (!split && !merge) return;
  const double cell = std::pow(scene_.water.spacing, D), huge = 1e300;
  const PlacedValue split_area = split ? in_metres(split->area, cell, huge) : PlacedValue(huge, {});
  std::optional<SplitOptions> splitting;
  std::optional<MergeOptions> merging;
  if (split)
    splitting = SplitOptions{split_pattern<D>(split->into, split->alpha, split->eps, turn),
                             split_area,
                             split->alpha,
                             split->linear,
                             split->least_depth,
                             split->most_particles};
  if (merge) merging = MergeOptions{in_metres(merge->area, cell, 0.0), split_area, merge->reach};
  const double area = std::max(split ? largest(split->area, cell, cell) : cell,
                               merge ? 2 * largest(merge->area, cell, cell) : cell);
  refinement_.emplace(splitting, merging,
                      RelaxOptions{scene_.sph.eta, scene_.gravity, split ? split->relax : merge->relax,
                                   scene_.sph.eta * std::pow(area, 1.0 / D)});
}

template <int D>
void ExplicitSph<D>::refine() {
  refinement_->adapt(
      particles_, [this] { return bind(); }, kind(), clusters_, neighbours_.view(), wall_view(), next_id_);
}

template void ExplicitSph<1>::build_refinement();
template void ExplicitSph<2>::build_refinement();
template void ExplicitSph<1>::refine();
template void ExplicitSph<2>::refine();

}  // namespace freshet::swe
