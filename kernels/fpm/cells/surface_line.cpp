#include "kernels/fpm/cells/surface_line.hpp"

namespace freshet::fpm {
namespace {

KOKKOS_INLINE_FUNCTION bool holds_triangle(const PointCell& c, const Cloud& cloud, int i,
                                           const Radii& radii) {
  bool found = false;
  for_each_triangle(c, root(radii.open2),
                    [&](int, int, double, int k) { found = found || !is_air(c, cloud, i, k, radii); });
  return found;
}

// Highest level of the point's surface edges at the distance `across` to its right, from the point.
KOKKOS_INLINE_FUNCTION double level_of_edges(const PointCell& c, const Cloud& cloud, int i,
                                             const Radii& radii, double across) {
  double level = no_water;
  for (int k = 0; k < c.cell.size; ++k) {
    const int number = c.cell.edge[k];
    if (number < 0 || c.around.r2[number] >= 4 * radii.open2) continue;
    if (!is_air(c, cloud, i, k, radii) && !is_air(c, cloud, i, c.cell.after(k), radii)) continue;
    const double dx = c.around.x[number], part = dx != 0 ? across / dx : -1;
    if (part >= 0 && part <= 1) level = larger(level, part * c.around.y[number]);
  }
  return level;
}

}  // namespace

double highest_level(const Cloud& cloud, const Field<int>& surface, int n, const VoronoiRule& rule,
                     double x) {
  double highest = no_water;
  const VecField<double, 2> place = cloud.near.x;
  const double same = 1e-6 * cloud.spacing;
  Kokkos::parallel_reduce(
      "fpm::surface_level", Range(0, n),
      KOKKOS_LAMBDA(int i, double& high) {
        const double across = x - place.x(i), r = rule.surface * cloud.spacing_at(i);
        if (surface(i) == 0 || across * across > 4 * r * r) return;
        const PointCell c = cell_of(cloud, i, r);
        const Radii radii(rule, cloud.spacing_at(i));
        if (!holds_triangle(c, cloud, i, radii)) return;
        const double edges = level_of_edges(c, cloud, i, radii, across),
                     level = across * across < same * same ? larger(0.0, edges) : edges;
        if (level > no_water) high = larger(high, place.y(i) + level);
      },
      Kokkos::Max<double>(highest));
  return larger(highest, no_water);  // Kokkos starts from a lower one
}

double farthest_x(const Cloud& cloud, const Field<int>& surface, int n, const VoronoiRule& rule) {
  double farthest = no_water;
  const VecField<double, 2> place = cloud.near.x;
  Kokkos::parallel_reduce(
      "fpm::front", Range(0, n),
      KOKKOS_LAMBDA(int i, double& far) {
        if (surface(i) == 0 && cloud.kind(i) == in_fluid) return;
        const Radii radii(rule, cloud.spacing_at(i));
        if (place.x(i) > far && holds_triangle(cell_of(cloud, i, root(radii.open2)), cloud, i, radii))
          far = place.x(i);
      },
      Kokkos::Max<double>(farthest));
  return larger(farthest, no_water);
}

}  // namespace freshet::fpm
