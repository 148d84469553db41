#include "src/methods/fpm/solver.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "kernels/fpm/cells/supports.hpp"
#include "src/errors.hpp"
#include "src/scene/place/place.hpp"

namespace freshet::fpm {
namespace {

// of the time step: backward differences of second order stand less than 1 + sqrt 2
constexpr double fastest_growth = 2;

std::string unsolved(const linear::BiCgStabReport& solve, double tolerance) {
  char text[300];
  std::snprintf(text, sizeof text,
                "the pressure equation was not solved: residual %.2g of the right side after %d iterations; "
                "limit: fpm.tolerance = %.2g\n"
                "  help: a smaller time.cfl, or look at the start for bodies that overlap",
                solve.residual, solve.iterations, tolerance);
  return text;
}

Period period_of(const Scene& scene) {
  const auto length = [&](std::size_t axis) {
    return scene.fpm->periodic[axis] ? scene.domain.high[axis] - scene.domain.low[axis] : 0.0;
  };
  return {{scene.domain.low[0], scene.domain.low[1]}, {length(0), length(1)}};
}

std::vector<Polyline> lines_of(const std::vector<Wall>& walls) {
  std::vector<Polyline> lines;
  for (const Wall& wall : walls) lines.push_back(wall.line);
  return lines;
}

PointRule point_rule(const Scene& scene) {
  PointRule rule;
  rule.spacing = scene.water.spacing;
  rule.support = scene.fpm->support * scene.water.spacing;
  rule.slip = scene.fpm->slip;
  rule.voronoi.hole = scene.fpm->hole;
  return rule;
}

FlowRule flow_rule(const Fpm& fpm) {
  return {fpm.density,
          fpm.viscosity,
          {fpm.force[0], fpm.force[1]},
          fpm.scheme,
          fpm.slip,
          fpm.tolerance,
          fpm.implicit_viscosity && fpm.viscosity > 0};
}

}  // namespace

FinitePointset::FinitePointset(const Scene& scene)
    : scene_(scene), order_(2, scene.water.spacing, sorted_box(scene)), period_(period_of(scene)),
      tank_(lines_of(scene.walls), 4 * scene.water.spacing),
      management_(point_rule(scene), tank_, period_, {{{"u", "v"}, {"u_old", "v_old"}}, {"p"}}),
      projection_(flow_rule(*scene.fpm), tank_.view()) {
  if (scene.fpm->grading) grading_.emplace(scene);
  place();
  order_.sort(points_);
  management_.flag(points_, order_);
  management_.hold_velocities(points_);
  keeper_.start(totals().mass);
}

// Moved points are managed and sorted; lists, cells and stencils are those of the new places.
void FinitePointset::step(double, double dt) {
  const double ratio = last_dt_ > 0 ? dt / last_dt_ : 0;
  if (keeper_.is_due()) keeper_.look(totals().mass, dt);
  advect(bind(), period_, dt, ratio);
  manage_points();
  const Flow flow = bind();
  const Neighbourhood<2>& around =
      finder_.find(order_.rows(), flow.x, points_.real("h"), flow.points, period_);
  require_solved(projection_.advance(around, order_.rows(), flow, Backward(dt, ratio)));
  last_dt_ = dt;
  keeper_.pass(dt);
}

void FinitePointset::manage_points() {
  const TimedRegion region("fpm::points");
  if (grading_) grading_->size(points_);
  const PointReport managed = management_.manage(points_, order_, next_id_);
  counts_.inserted += managed.step.inserted;
  counts_.merged += managed.step.merged;
  counts_.removed += managed.step.removed;
  counts_.landed += managed.step.landed;
  if (grading_) grading_->size(points_);
  size_supports();
}

void FinitePointset::require_solved(const ProjectionReport& projected) {
  pressure_ = projected.poisson;
  viscosity_ = projected.viscosity;
  limited_ += projected.limited;
  moved_ += points_.size();
  if (scene_.fpm->implicit_viscosity && !viscosity_.converged && scene_.fpm->viscosity > 0)
    throw Diverged("the implicit viscosity was not solved in " + std::to_string(viscosity_.iterations) +
                   " iterations\n  help: a smaller time.cfl, or fpm.diffusion = \"explicit\"");
  if (!pressure_.solve.converged) throw Diverged(unsolved(pressure_.solve, scene_.fpm->tolerance));
  report_.pressure_iterations = pressure_.solve.iterations;
}

void FinitePointset::size_supports() {
  SupportRule rule;
  rule.support = scene_.fpm->support;
  if (scene_.fpm->by_neighbours)
    fit_supports(management_.cloud(points_, order_), points_.size(), points_.real("h"), rule);
}

// (5.24)-(5.26): a point moves by a part of its support, viscosity spreads over one, and from rest.
double FinitePointset::stable_dt() const {
  const double h = scene_.fpm->support * scene_.water.spacing, speed = fastest(bind());
  const double force = std::hypot(scene_.fpm->force[0], scene_.fpm->force[1]);
  double dt = scene_.end_time;
  if (speed > 0) dt = std::min(dt, scene_.cfl * h / speed);
  if (force > 0) dt = std::min(dt, 0.04 * std::sqrt(h / force));
  if (scene_.fpm->viscosity > 0 && !scene_.fpm->implicit_viscosity)
    dt = std::min(dt, 0.125 * h * h / scene_.fpm->viscosity);
  if (last_dt_ > 0) dt = std::min(dt, fastest_growth * last_dt_);
  return std::isfinite(speed) ? dt : speed;
}

Field<double> FinitePointset::flow_pressure() const {
  const Flow flow = bind();
  if (!projection_.knows(flow)) return flow.p;
  const auto room = static_cast<std::size_t>(flow.points + flow.points / 2 + lanes);
  if (flow_pressure_.extent_int(0) < flow.points + lanes)
    flow_pressure_ = Field<double>("fpm.flow_pressure", room);
  const PoissonReport report = projection_.pressure_of_flow(flow, flow_pressure_);
  if (!report.solve.converged) throw Diverged(unsolved(report.solve, scene_.fpm->tolerance));
  return flow_pressure_;
}

}  // namespace freshet::fpm
