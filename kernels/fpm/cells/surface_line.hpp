// The free surface as a line: the Delaunay edges one of whose empty circles is as large as the surface's.
// Where it is met by an upright line, and how far the water reaches. Only water that holds a triangle counts,
// so that lone drops do not.
#pragma once
#include "kernels/fpm/cells/voronoi.hpp"

namespace freshet::fpm {

constexpr double no_water = -1e300;  // m

// Highest level [m] at which the surface crosses the upright line at x [m]. rule: the one that the surface
// was found by.
double highest_level(const Cloud& cloud, const Field<int>& surface, int n, const VoronoiRule& rule, double x);

// Largest x [m] of the water.
double farthest_x(const Cloud& cloud, const Field<int>& surface, int n, const VoronoiRule& rule);

}  // namespace freshet::fpm
