// Points of an incompressible flow for tests, made without a scene: sorted, with kinds, ids and a tank.
#pragma once
#include <cmath>

#include "kernels/fpm/cells/voronoi.hpp"
#include "tests/support/points/cloud.hpp"

namespace freshet::test {

struct FlowPoints {
  FieldSet fields;
  RowOrder order;
  fpm::Tank tank;
  Period period;
  double spacing;  // m

  FlowPoints(const std::vector<Point>& points, double dx, const std::vector<Polyline>& walls = {})
      : fields(point_fields(2, points)), order(2, dx, wide(dx)), tank(walls), spacing(dx) {
    fields.integer("kind", "1", Carry::sort);
    fields.integer("surface", "1", Carry::sort);
    order.sort(fields);
  }

  fpm::Cloud cloud() const {
    return {{order.rows(), {fields.real("x"), fields.real("y")}, period},
            fields.integer("id"),
            fields.integer("kind"),
            tank.view(),
            spacing};
  }
  Point at(int i) const { return {fields.real("x")(i), fields.real("y")(i)}; }
  int size() const { return fields.size(); }

  std::vector<bool> flags(const fpm::VoronoiRule& rule = {}) {
    fpm::Voronoi voronoi(rule);
    const auto surface = fields.integer("surface");
    voronoi.find(cloud(), size(), surface);
    std::vector<bool> flagged;
    for (int i = 0; i < size(); ++i) flagged.push_back(surface(i) == 1);
    return flagged;
  }
};

inline std::vector<Point> jittered(std::vector<Point> points, double most, unsigned seed) {
  Random random(seed);
  for (Point& p : points) p = {p[0] + random(-most, most), p[1] + random(-most, most)};
  return points;
}

inline double squared(const Point& a, const Point& b) {
  return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]);
}

}  // namespace freshet::test
