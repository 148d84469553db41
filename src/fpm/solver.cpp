#include "src/fpm/solver.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cellgrid/launch.hpp"
#include "kernels/fpm/cells/area.hpp"
#include "kernels/fpm/cells/supports.hpp"
#include "src/errors.hpp"

namespace freshet::fpm {
namespace {

constexpr double fastest_growth = 2;  // of the time step: backward differences of second order stand less than 1 + sqrt 2

std::string unsolved(const linear::BiCgStabReport& solve, double tolerance) {
  char text[300];
  std::snprintf(text, sizeof text,
                "the pressure equation was not solved: residual %.2g of the right side after %d iterations; limit: fpm.tolerance = %.2g\n"
                "  help: a smaller time.cfl, or look at the start for bodies that overlap",
                solve.residual, solve.iterations, tolerance);
  return text;
}

}  // namespace

// Moved points are managed and sorted; lists, cells and stencils are those of the new places.
void Solver::step(double, double dt) {
  const double ratio = last_dt_ > 0 ? dt / last_dt_ : 0;
  if (keeper_.is_due()) keeper_.look(totals().mass, dt);
  advect(bind(), period_, dt, ratio);
  {
    const Region region("fpm::points");
    if (grading_) grading_->size(points_);
    const PointReport managed = management_.manage(points_, order_, next_id_);
    counts_.inserted += managed.step.inserted;
    counts_.merged += managed.step.merged;
    counts_.removed += managed.step.removed;
    counts_.landed += managed.step.landed;
    if (grading_) grading_->size(points_);
    size_supports();
  }
  const Flow flow = bind();
  const Neighbourhood<2>& around = finder_.find(order_.rows(), flow.x, points_.real("h"), flow.points, period_);
  const ProjectionReport projected = projection_.advance(around, order_.rows(), flow, Backward(dt, ratio));
  pressure_ = projected.poisson;
  viscosity_ = projected.viscosity;
  limited_ += projected.limited;
  moved_ += flow.points;
  if (scene_.fpm->implicit_viscosity && !viscosity_.converged && scene_.fpm->viscosity > 0)
    throw Diverged("the implicit viscosity was not solved in " + std::to_string(viscosity_.iterations) +
                   " iterations\n  help: a smaller time.cfl, or fpm.diffusion = \"explicit\"");
  if (!pressure_.solve.converged)
    throw Diverged(unsolved(pressure_.solve, scene_.fpm->tolerance));
  report_.pressure_iterations = pressure_.solve.iterations;
  last_dt_ = dt;
  keeper_.pass(dt);
}

void Solver::size_supports() {
  SupportRule rule;
  rule.support = scene_.fpm->support;
  if (scene_.fpm->by_neighbours) fit_supports(management_.cloud(points_, order_), points_.size(), points_.real("h"), rule);
}

// docs/formulas/fpm.md (F32): a point moves by a part of its support, viscosity spreads over one, and from
// rest.
double Solver::stable_dt() const {
  const double h = scene_.fpm->support * scene_.water.spacing, speed = fastest(bind());
  const double force = std::hypot(scene_.fpm->force[0], scene_.fpm->force[1]);
  double dt = scene_.end_time;
  if (speed > 0) dt = std::min(dt, scene_.cfl * h / speed);
  if (force > 0) dt = std::min(dt, 0.04 * std::sqrt(h / force));
  if (scene_.fpm->viscosity > 0 && !scene_.fpm->implicit_viscosity) dt = std::min(dt, 0.125 * h * h / scene_.fpm->viscosity);
  if (last_dt_ > 0) dt = std::min(dt, fastest_growth * last_dt_);
  return std::isfinite(speed) ? dt : speed;
}

Field<double> Solver::flow_pressure() const {
  const Flow flow = bind();
  if (!projection_.knows(flow)) return flow.p;
  const auto room = static_cast<std::size_t>(flow.points + flow.points / 2 + lanes);
  if (flow_pressure_.extent_int(0) < flow.points + lanes) flow_pressure_ = Field<double>("fpm.flow_pressure", room);
  const PoissonReport report = projection_.pressure_of_flow(flow, flow_pressure_);
  if (!report.solve.converged) throw Diverged(unsolved(report.solve, scene_.fpm->tolerance));
  return flow_pressure_;
}

Mechanics Solver::mechanics() const {
  const Flow flow = bind();
  const Field<double> area = cell_areas();
  const Vec<double, 2> force{scene_.fpm->force[0], scene_.fpm->force[1]};
  const auto sum = sum_of_particles<4>("fpm::mechanics", flow.points, KOKKOS_LAMBDA(int i) {
    const Vec<double, 2> v = at(flow.v, i);
    const double a = area(i);
    return Addends<4>{{a * v.x, a * v.y, 0.5 * a * dot(v, v), -a * dot(force, at(flow.x, i))}};
  });
  return {{sum[0], sum[1]}, sum[2], sum[3]};
}

Totals Solver::totals() const {
  Totals totals;
  totals.mass = sum_of_values("fpm::area", points_.size(), cell_areas());
  return totals;
}

// Each point's part of the triangles between points that are closer together than the surface's empty circle: the parts of all
// points make up the water's area.
Field<double> Solver::cell_areas() const {
  const Cloud cloud = management_.cloud(points_, order_);
  const int n = points_.size();
  if (area_.extent_int(0) < n) area_ = Field<double>("fpm.area", static_cast<std::size_t>(n + n / 2));
  const Field<double> area = area_;
  const VoronoiRule rule = management_.rule().voronoi;
  launch("fpm::cell_areas", Range(0, n), KOKKOS_LAMBDA(int i) {
        const Radii radii(rule, cloud.spacing_at(i));
        area(i) = wet_area(cell_of(cloud, i, root(radii.open2)), cloud, i, radii);
      });
  return area;
}

}  // namespace freshet::fpm
