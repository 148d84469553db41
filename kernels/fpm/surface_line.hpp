// The free surface as a line: the Delaunay edges one of whose empty circles is as large as the surface's. Where it is met
// by an upright line, and how far the water reaches. Only water that holds a triangle counts, so that lone drops do not.
#pragma once
#include "kernels/fpm/voronoi.hpp"

namespace freshet::fpm {

constexpr double no_water = -1e300;  // m

// Highest level [m] at which the surface crosses the upright line at x [m]. radius: of the empty circle, x spacing.
double highest_level(const Cloud& cloud, const Field<int>& surface, int n, double radius, double x);

// Largest x [m] of the water.
double farthest_x(const Cloud& cloud, const Field<int>& surface, int n, double radius);

}  // namespace freshet::fpm
