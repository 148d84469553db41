// Where a scene's particles start.
#pragma once
#include <vector>

#include "cellgrid/simd/box.hpp"
#include "src/scene/scene.hpp"

namespace freshet {

struct Placed {
  Point x;         // m
  double depth;    // m
  double area;     // m2 (1-D: m), mass = depth x area
  double h0;       // m, eta x sqrt(area) (1-D: eta x spacing)
  Point velocity;  // m/s
};

Point velocity_at(const Scene& scene, double x, double y);  // m/s, at t = 0
double cell_width(const Scene& scene, int axis);            // m, of the lattice below
void require_finite(double depth, const Point& x);          // SceneError

// Cell-centred lattice whose cells fill the domain's box exactly (so dx and dy may differ by a little), or in
// 1-D particles of equal mass. depth(x, y) [m]; places where depth > scene.water.wet_above and 1e-9 of the
// deepest. Throws SceneError if nothing is wet or a depth is not finite.
std::vector<Placed> place(const Scene& scene, const Function& depth);

// Where particles are looked for [m]: the domain and what buffers and walls have outside it; along a period
// just the domain.
Box sorted_box(const Scene& scene);

}  // namespace freshet
