// What gauges show: the highest free surface above or below a point, the pressure of the flow there, how far the water reaches.
#include <algorithm>

#include "cellgrid/assign.hpp"
#include "kernels/fpm/surface_line.hpp"
#include "src/fpm/nodes.hpp"
#include "src/fpm/solver.hpp"

namespace freshet::fpm {
namespace {

constexpr double beyond = 0.5;  // x range of the values around: what is shown may lie so far outside it
constexpr double wet_within = 1.0;  // x dx: a place without a point so near is dry

struct Probe {
  double pressure = 0;  // Pa
  bool wet = false;
};

// dx [m]: there
Probe pressure_at(const Cloud& cloud, const Field<double>& p, const Point& at, double dx, double support) {
  const VecField<double, 2> place{Field<double>("fpm.gauge", 1), Field<double>("fpm.gauge", 1)};
  assign(place.x, at[0]);
  assign(place.y, at[1]);
  const Field<double> value("fpm.gauge", 1), h("fpm.gauge", 1), slack("fpm.gauge", 1);
  assign(h, support * dx);
  assign(slack, beyond);
  Transfer transfer;
  transfer.find(cloud.near, place, h, 1);
  transfer.apply(p, value, slack);
  const Near near = cloud.near;
  const double reach = wet_within * dx;
  int points = 0;
  Kokkos::parallel_reduce("fpm::gauge_wet", Range(0, 1),
      KOKKOS_LAMBDA(int, int& count) { near.for_each({at[0], at[1]}, reach, [&](int, const Vec<double, 2>&, double) { ++count; }); }, points);
  return {on_host(value)(0), points > 0};
}

}  // namespace

std::vector<PointState> Solver::gauge(const std::vector<Gauge>& gauges) const {
  const Cloud cloud = management_.cloud(points_, order_);
  const Field<int> surface = points_.integer("surface");
  const VoronoiRule& rule = management_.rule().voronoi;
  const bool press = std::any_of(gauges.begin(), gauges.end(), [](const Gauge& g) { return g.what == Gauge::What::pressure; });
  const Field<double> pressure = press ? flow_pressure() : Field<double>();
  std::vector<PointState> states;
  for (const Gauge& g : gauges) {
    PointState state;
    state.thin_is_dry = false;
    if (g.what == Gauge::What::pressure) {
      const Probe probe = pressure_at(cloud, pressure, g.at, spacing_at(scene_, g.at), scene_.fpm->support);
      state.reached = probe.wet, state.depth = probe.wet ? probe.pressure : 0;
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
