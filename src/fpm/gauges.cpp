// What gauges show: the highest free surface above or below a point, the pressure of the flow there, how far the water reaches.
#include <algorithm>

#include "cellgrid/assign.hpp"
#include "kernels/fpm/cells/surface_line.hpp"
#include "src/fpm/solver.hpp"

namespace freshet::fpm {

std::vector<PointState> Solver::gauge(const std::vector<Gauge>& gauges) const {
  const Cloud cloud = management_.cloud(points_, order_);
  const Field<int> surface = points_.integer("surface");
  const VoronoiRule& rule = management_.rule().voronoi;
  const bool press = std::any_of(gauges.begin(), gauges.end(), [](const Gauge& g) { return g.what == Gauge::What::pressure; });
  const Field<double> pressure = press ? flow_pressure() : Field<double>();
  const std::vector<Probe> probes = probes_.look(scene_, gauges, cloud.near, pressure);
  auto probe = probes.begin();
  std::vector<PointState> states;
  for (const Gauge& g : gauges) {
    PointState state;
    state.thin_is_dry = false;
    if (g.what == Gauge::What::pressure) {
      state.reached = probe->wet != 0, state.depth = probe->pressure;
      ++probe;
    } else {
      const bool front = g.what == Gauge::What::front;
      const double place = front ? farthest_x(cloud, surface, points_.size(), rule) : highest_level(cloud, surface, points_.size(), rule, g.at[0]);
      state.reached = place > no_water, state.depth = state.reached ? place : 0;
    }
    states.push_back(state);
  }
  return states;
}

}  // namespace freshet::fpm
