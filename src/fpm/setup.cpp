// From a scene to the solver's state: walls, points and their fields.
#include <cmath>
#include <cstdio>

#include "cellgrid/assign.hpp"
#include "cellgrid/launch.hpp"
#include "src/fpm/place.hpp"
#include "src/fpm/solver.hpp"
#include "src/scene/place.hpp"

namespace freshet::fpm {
namespace {

constexpr double touching = 0.25;  // x dx: points that start nearer than this to a wall stand on it

Period period_of(const Scene& scene) {
  const auto length = [&](std::size_t axis) { return scene.fpm->periodic[axis] ? scene.domain.high[axis] - scene.domain.low[axis] : 0.0; };
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
  return {fpm.density, fpm.viscosity, {fpm.force[0], fpm.force[1]}, fpm.scheme, fpm.slip, fpm.tolerance,
          fpm.implicit_viscosity && fpm.viscosity > 0};
}

}  // namespace

Solver::Solver(const Scene& scene)
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

Solver::~Solver() = default;

void Solver::make_fields() {
  for (const char* name : {"x", "y"}) points_.real(name, "m", Carry::state);
  for (const char* name : {"u", "v", "u_old", "v_old"}) points_.real(name, "m/s", Carry::state);
  for (const char* name : {"p", "phi"}) points_.real(name, "Pa", Carry::state);
  points_.real("h", "m", Carry::state);
  if (grading_) points_.real("dx", "m", Carry::state);
  points_.integer("id", "1", Carry::state);
  Points::make_fields(points_);
  for (const char* name : {"u_star", "v_star"}) points_.real(name, "m/s", Carry::no);
  for (const char* name : {"normal_x", "normal_y"}) points_.real(name, "1", Carry::no);
  for (const char* name : {"q", "given"}) points_.real(name, "Pa", Carry::no);
  points_.real("source", "Pa/m2", Carry::no);
  points_.real("flux", "Pa/m", Carry::no);
  points_.integer("row", "1", Carry::no);
}

Flow Solver::bind() const {
  const FieldSet& f = points_;
  const auto pair = [&f](const char* x, const char* y) { return VecField<double, 2>{f.real(x), f.real(y)}; };
  return {pair("x", "y"), pair("u", "v"), pair("u_old", "v_old"), f.real("p"), f.real("phi"), f.integer("kind"), f.integer("side"),
          f.integer("surface"), pair("u_star", "v_star"), pair("normal_x", "normal_y"), f.real("q"), f.real("source"),
          f.real("flux"), f.real("given"), f.integer("row"), f.size(), keeper_.expansion()};
}

void Solver::place() {
  const std::vector<StartPoint> start = place_points(scene_);
  points_ = FieldSet(static_cast<int>(start.size()));
  make_fields();
  const auto fill = [&](const char* name, const auto& value_of) {
    const auto field = points_.real(name);
    const auto host = Kokkos::create_mirror_view(field);
    for (std::size_t i = 0; i < start.size(); ++i) host(i) = value_of(start[i]);
    assign(field, host);
  };
  fill("x", [](const StartPoint& s) { return s.x[0]; });
  fill("y", [](const StartPoint& s) { return s.x[1]; });
  for (const char* name : {"u", "u_old"}) fill(name, [](const StartPoint& s) { return s.velocity[0]; });
  for (const char* name : {"v", "v_old"}) fill(name, [](const StartPoint& s) { return s.velocity[1]; });
  assign(points_.real("h"), scene_.fpm->support * scene_.water.spacing);
  if (grading_) grading_->size(points_);
  const Field<int> id = points_.integer("id");
  launch("fpm::number", Range(0, points_.size()), KOKKOS_LAMBDA(int i) { id(i) = i; });
  next_id_ = points_.size();
  seat_on_walls();
}

// Points near a wall stand on it, near a corner of two walls in it.
void Solver::seat_on_walls() {
  const VecField<double, 2> x{points_.real("x"), points_.real("y")};
  const Field<int> kind = points_.integer("kind"), side = points_.integer("side");
  const TankView tank = tank_.view();
  const double near = touching * scene_.water.spacing;  // where the spacing varies, that of the finest
  launch("fpm::seat", Range(0, points_.size()), KOKKOS_LAMBDA(int i) {
        const NearestPiece f = tank.nearest(at(x, i), near);
        kind(i) = in_fluid;
        side(i) = -1;
        if (f.piece < 0) return;
        const Side& s = tank.sides(f.piece);
        const bool at_a = f.foot.along < near && s.corner_a, at_b = f.foot.along > s.length - near && s.corner_b;
        kind(i) = at_a || at_b ? in_corner : on_wall;
        side(i) = at_a ? s.before : f.piece;
        put(x, i, at_a ? s.a : at_b ? s.b : tank.place(f.piece, clamp(f.foot.along, 0.0, s.length)));
      });
}

std::vector<std::string> Solver::features() const {
  std::vector<std::string> on{"incompressible flow, " + std::to_string(points_.size()) + " points at the start"};
  if (scene_.fpm->viscosity > 0) on.push_back(scene_.fpm->implicit_viscosity ? "implicit viscosity" : "viscosity");
  if (tank_.size() > 0) on.push_back(scene_.fpm->slip ? "walls: slip" : "walls: no slip");
  if (grading_) on.push_back("spacing by place");
  if (scene_.fpm->by_neighbours) on.push_back("supports by number of neighbours");
  if (scene_.fpm->periodic[0] || scene_.fpm->periodic[1]) on.push_back("periodic domain");
  return on;
}

ScalarState Solver::scalars() const {
  return {{"last_dt", {last_dt_}},
          {"next_id", {static_cast<double>(next_id_)}},
          {"counts", {static_cast<double>(counts_.inserted), static_cast<double>(counts_.merged), static_cast<double>(counts_.removed),
                      static_cast<double>(counts_.landed)}},
          {"limited", {static_cast<double>(limited_), static_cast<double>(moved_)}},
          {"area", keeper_.state()}};
}

std::vector<std::string> Solver::notes() const {
  std::vector<std::string> all = keeper_.notes();
  if (limited_ == 0) return all;
  char text[300];
  std::snprintf(text, sizeof text,
                "films, threads and shreds without inner points: %ld velocities (%.2g %% of points x steps) were held to the largest speed around",
                limited_, 100.0 * static_cast<double>(limited_) / static_cast<double>(moved_));
  all.emplace_back(text);
  return all;
}

void Solver::restore(const ScalarState& scalars) {
  last_dt_ = scalars.at("last_dt").at(0);
  next_id_ = static_cast<int>(std::lround(scalars.at("next_id").at(0)));
  const std::vector<double>& counts = scalars.at("counts");
  counts_ = {std::lround(counts.at(0)), std::lround(counts.at(1)), std::lround(counts.at(2)), std::lround(counts.at(3))};
  keeper_.restore(scalars.at("area"));
  limited_ = std::lround(scalars.at("limited").at(0)), moved_ = std::lround(scalars.at("limited").at(1));
  order_.sort(points_);
}

}  // namespace freshet::fpm
