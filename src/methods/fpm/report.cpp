// What the run loop asks of the state: totals, gauges, features, restart scalars.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cellgrid/parallel/launch.hpp"
#include "kernels/fpm/cells/area.hpp"
#include "kernels/fpm/cells/surface_line.hpp"
#include "src/methods/fpm/solver.hpp"

namespace freshet::fpm {

Totals FinitePointset::totals() const {
  Totals totals;
  totals.mass = sum_of_values("fpm::area", points_.size(), cell_areas());
  return totals;
}

Mechanics FinitePointset::mechanics() const {
  const Flow flow = bind();
  const Field<double> area = cell_areas();
  const Vec<double, 2> force{scene_.fpm->force[0], scene_.fpm->force[1]};
  const auto sum = sum_of_particles<4>(
      "fpm::mechanics", flow.points, KOKKOS_LAMBDA(int i) {
        const Vec<double, 2> v = at(flow.v, i);
        const double a = area(i);
        return Addends<4>{{a * v.x, a * v.y, 0.5 * a * dot(v, v), -a * dot(force, at(flow.x, i))}};
      });
  return {{sum[0], sum[1]}, sum[2], sum[3]};
}

// Each point's part of the triangles between points that are closer together than the surface's empty circle:
// the parts of all points make up the water's area.
Field<double> FinitePointset::cell_areas() const {
  const Cloud cloud = management_.cloud(points_, order_);
  const int n = points_.size();
  if (area_.extent_int(0) < n) area_ = Field<double>("fpm.area", static_cast<std::size_t>(n + n / 2));
  const Field<double> area = area_;
  const VoronoiRule rule = management_.rule().voronoi;
  launch(
      "fpm::cell_areas", Range(0, n), KOKKOS_LAMBDA(int i) {
        const Radii radii(rule, cloud.spacing_at(i));
        area(i) = wet_area(cell_of(cloud, i, root(radii.open2)), cloud, i, radii);
      });
  return area;
}

// The highest free surface above or below a point, the pressure of the flow there, how far the water reaches.
std::vector<Reading> FinitePointset::read(const std::vector<Gauge>& gauges) const {
  const Cloud cloud = management_.cloud(points_, order_);
  const Field<int> surface = points_.integer("surface");
  const VoronoiRule& rule = management_.rule().voronoi;
  const bool press = std::any_of(gauges.begin(), gauges.end(),
                                 [](const Gauge& g) { return g.what == Gauge::What::pressure; });
  const Field<double> pressure = press ? flow_pressure() : Field<double>();
  const std::vector<Probe> probes = probes_.look(scene_, gauges, cloud.near, pressure);
  auto probe = probes.begin();
  const auto place = [](double where) { return where > no_water ? Reading{where, 0, true} : Reading{}; };
  std::vector<Reading> readings;
  for (const Gauge& g : gauges) {
    using What = Gauge::What;
    if (g.what == What::front) readings.push_back(place(farthest_x(cloud, surface, points_.size(), rule)));
    if (g.what == What::elevation)
      readings.push_back(place(highest_level(cloud, surface, points_.size(), rule, g.at[0])));
    if (g.what != What::pressure) continue;
    readings.push_back({probe->pressure, 0, probe->wet != 0});
    ++probe;
  }
  return readings;
}

// The solver's launches; those that fit and cut cells by their particles alone: what they compute hangs on
// the neighbours' places.
std::map<std::string, Work> FinitePointset::work() const {
  const double n = points_.size();
  std::map<std::string, Work> all{{"bicgstab::direction", work_of(linear::direction_cost, n)},
                                  {"bicgstab::step_along", work_of(linear::step_along_cost, n)},
                                  {"bicgstab::advance", work_of(linear::bicgstab_advance_cost, n)}};
  for (const char* label : {"fpm::voronoi", "fpm::stencils", "fpm::predict", "fpm::rows", "fpm::correct"})
    all[label] = work_of(Cost{}, n);
  if (last_dt_ > 0) all["linear::multiply"] = projection_.pressure_matrix().work();
  return all;
}

std::vector<std::string> FinitePointset::features() const {
  std::vector<std::string> on{"incompressible flow, " + std::to_string(points_.size()) +
                              " points at the start"};
  if (scene_.fpm->viscosity > 0)
    on.push_back(scene_.fpm->implicit_viscosity ? "implicit viscosity" : "viscosity");
  if (tank_.size() > 0) on.push_back(scene_.fpm->slip ? "walls: slip" : "walls: no slip");
  if (grading_) on.push_back("spacing by place");
  if (scene_.fpm->by_neighbours) on.push_back("supports by number of neighbours");
  if (scene_.fpm->periodic[0] || scene_.fpm->periodic[1]) on.push_back("periodic domain");
  return on;
}

std::vector<std::string> FinitePointset::notes() const {
  std::vector<std::string> all = keeper_.notes();
  if (limited_ == 0) return all;
  char text[300];
  std::snprintf(text, sizeof text,
                "films, threads and shreds without inner points: %ld velocities (%.2g %% of points x steps) "
                "were held to the largest speed around",
                limited_, 100.0 * static_cast<double>(limited_) / static_cast<double>(moved_));
  all.emplace_back(text);
  return all;
}

ScalarState FinitePointset::scalars() const {
  return {{"last_dt", {last_dt_}},
          {"next_id", {static_cast<double>(next_id_)}},
          {"counts",
           {static_cast<double>(counts_.inserted), static_cast<double>(counts_.merged),
            static_cast<double>(counts_.removed), static_cast<double>(counts_.landed)}},
          {"limited", {static_cast<double>(limited_), static_cast<double>(moved_)}},
          {"area", keeper_.state()}};
}

void FinitePointset::restore(const ScalarState& scalars) {
  last_dt_ = scalars.at("last_dt").at(0);
  next_id_ = static_cast<int>(std::lround(scalars.at("next_id").at(0)));
  const std::vector<double>& counts = scalars.at("counts");
  counts_ = {std::lround(counts.at(0)), std::lround(counts.at(1)), std::lround(counts.at(2)),
             std::lround(counts.at(3))};
  keeper_.restore(scalars.at("area"));
  limited_ = std::lround(scalars.at("limited").at(0)), moved_ = std::lround(scalars.at("limited").at(1));
  order_.sort(points_);
}

}  // namespace freshet::fpm
