// The spacing of a flow's points by place: fpm.grading times water.spacing, and the support that goes with
// it. In place of the thesis' (5.21)-(5.23), which find h from the number of neighbours: the points are kept
// at the spacing that is asked for, so that the number of neighbours in h = support x spacing stays what it
// is on a uniform cloud.
#pragma once
#include "cellgrid/particles/fields.hpp"
#include "kernels/ground/bed_spline.hpp"
#include "src/scene/scene.hpp"

namespace freshet::fpm {

class Grading {
 public:
  // Tabulates fpm.grading over the domain. Throws SceneError where it is not between 1 and 4.
  explicit Grading(const Scene& scene);

  // Writes dx and h [m] of all points, at their places.
  void size(FieldSet& points) const;

 private:
  BedSpline<2> factor_;
  double spacing_, support_;  // m, of factor 1; h / dx
};

}  // namespace freshet::fpm
