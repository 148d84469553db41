#include "src/methods/fpm/place.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "cellgrid/parallel/assign.hpp"
#include "cellgrid/parallel/launch.hpp"
#include "kernels/boundaries/walls/polyline.hpp"
#include "src/errors.hpp"
#include "src/methods/fpm/nodes.hpp"
#include "src/methods/fpm/solver.hpp"
#include "src/scene/place/random.hpp"

namespace freshet::fpm {
namespace {

constexpr double touching = 0.25;  // x dx: points that start nearer than this to a wall stand on it
// x dx: lattice points closer than this to a slanting outline are left out
constexpr double off_outline = 0.6;

// Places along one side of a box: from end to end, or the middles of cells where the box fills a periodic
// domain.
struct Ladder {
  std::vector<double> at;
  bool ends;
  Ladder(double low, double high, double spacing, bool periodic) : ends(!periodic) {
    const int n = std::max(1, static_cast<int>(std::lround((high - low) / spacing)));
    for (int k = 0; k < n + (ends ? 1 : 0); ++k)
      at.push_back(low + (high - low) * (k + (ends ? 0.0 : 0.5)) / n);
  }
  bool is_end(std::size_t k) const { return ends && (k == 0 || k + 1 == at.size()); }
};

std::vector<Seed> nodes_of_box(const Scene& scene, const Body& body) {
  const Point low = body.outline[0], high = body.outline[2];
  const auto ladder = [&](std::size_t axis) {
    const bool fills = low[axis] <= scene.domain.low[axis] && high[axis] >= scene.domain.high[axis];
    return Ladder(low[axis], high[axis], scene.water.spacing, scene.fpm->periodic[axis] && fills);
  };
  const Ladder x = ladder(0), y = ladder(1);
  std::vector<Seed> nodes;
  for (std::size_t j = 0; j < y.at.size(); ++j)
    for (std::size_t i = 0; i < x.at.size(); ++i)
      nodes.push_back({{x.at[i], y.at[j]}, !x.is_end(i) && !y.is_end(j)});
  return nodes;
}

// Rings one spacing apart, the outermost on the circle.
std::vector<Seed> nodes_of_circle(const Body& body, double spacing) {
  const int rings = std::max(1, static_cast<int>(std::lround(body.radius / spacing)));
  std::vector<Seed> nodes{{body.centre, true}};
  for (int k = 1; k <= rings; ++k) {
    const int n = static_cast<int>(std::lround(2 * pi * k));
    const double r = body.radius * k / rings,
                 turn = 2.399963229728653 * k;  // the golden angle: rings do not line up
    for (int i = 0; i < n; ++i) {
      const double a = 2 * pi * i / n + turn;
      nodes.push_back({{body.centre[0] + r * std::cos(a), body.centre[1] + r * std::sin(a)}, k < rings});
    }
  }
  return nodes;
}

void add_outline(const std::vector<Point>& outline, double spacing, std::vector<Seed>& nodes) {
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Point a = outline[k], b = outline[(k + 1) % outline.size()];
    const int parts =
        std::max(1, static_cast<int>(std::lround(std::hypot(b[0] - a[0], b[1] - a[1]) / spacing)));
    for (int i = 0; i < parts; ++i) {
      const double s = static_cast<double>(i) / parts;
      nodes.push_back({{a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])}, false});
    }
  }
}

std::vector<Seed> nodes_of_polygon(const Scene& scene, const Body& body) {
  const double dx = scene.water.spacing;
  std::vector<Seed> nodes;
  add_outline(body.outline, dx, nodes);
  const Box box = bounds_of(body.outline);
  Polyline closed = body.outline;
  closed.push_back(closed.front());
  for (double y = box.ylo; y < box.yhi; y += dx)
    for (double x = box.xlo; x < box.xhi; x += dx)
      if (encloses(closed, {x, y}) && distance({x, y}, closed) > off_outline * dx)
        nodes.push_back({{x, y}, true});
  return nodes;
}

std::vector<Seed> nodes_of(const Scene& scene, const Body& body) {
  if (scene.fpm->grading && body.radius > 0)
    throw SceneError("fpm.grading does not know body.circle; help: a polygon in its place");
  if (scene.fpm->grading) return graded_nodes(scene, body.outline);
  if (body.radius > 0) return nodes_of_circle(body, scene.water.spacing);
  return body.lattice ? nodes_of_box(scene, body) : nodes_of_polygon(scene, body);
}

Point velocity_at(const Body& body, const Point& x) {
  const auto component = [&](const Function& f) { return f ? f(x[0], x[1]) : 0.0; };
  const Point v{component(body.velocity[0]), component(body.velocity[1])};
  if (!std::isfinite(v[0] + v[1]))
    throw SceneError("body.velocity is not a finite number at (" + std::to_string(x[0]) + ", " +
                     std::to_string(x[1]) + ") m; check its expressions there");
  return v;
}

}  // namespace

std::vector<StartPoint> place_points(const Scene& scene) {
  std::vector<StartPoint> points;
  std::uint64_t counter = 0;
  for (const Body& body : scene.fpm->bodies) {
    for (const Seed& node : nodes_of(scene, body)) {
      const double off = node.inside ? scene.water.disorder * spacing_at(scene, node.x) : 0;
      const double dx = off * random_offset(scene.water.seed, counter),
                   dy = off * random_offset(scene.water.seed, counter + 1);
      counter += 2;
      const Point x{node.x[0] + dx, node.x[1] + dy};
      points.push_back({x, velocity_at(body, x)});
    }
  }
  return points;
}

void FinitePointset::place() {
  const std::vector<StartPoint> start = place_points(scene_);
  points_ = FieldSet(static_cast<int>(start.size()));
  make_fields();
  const auto fill = [&](const char* name, const auto& value_of) {
    upload(points_.real(name), start.size(), [&](std::size_t i) { return value_of(start[i]); });
  };
  fill("x", [](const StartPoint& s) { return s.x[0]; });
  fill("y", [](const StartPoint& s) { return s.x[1]; });
  for (const char* name : {"u", "u_old"}) fill(name, [](const StartPoint& s) { return s.velocity[0]; });
  for (const char* name : {"v", "v_old"}) fill(name, [](const StartPoint& s) { return s.velocity[1]; });
  assign(points_.real("h"), scene_.fpm->support * scene_.water.spacing);
  if (grading_) grading_->size(points_);
  upload(points_.integer("id"), start.size(), [](std::size_t i) { return static_cast<int>(i); });
  next_id_ = points_.size();
  seat_on_walls();
}

// Points near a wall stand on it, near a corner of two walls in it.
void FinitePointset::seat_on_walls() {
  const VecField<double, 2> x{points_.real("x"), points_.real("y")};
  const Field<int> kind = points_.integer("kind"), side = points_.integer("side");
  const TankView tank = tank_.view();
  const double near = touching * scene_.water.spacing;  // where the spacing varies, that of the finest
  launch(
      "fpm::seat", Range(0, points_.size()), KOKKOS_LAMBDA(int i) {
        const NearestPiece f = tank.nearest(at(x, i), near);
        kind(i) = in_fluid;
        side(i) = -1;
        if (f.piece < 0) return;
        const Side& s = tank.sides(f.piece);
        const bool at_a = f.foot.along < near && s.corner_a,
                   at_b = f.foot.along > s.length - near && s.corner_b;
        kind(i) = at_a || at_b ? in_corner : on_wall;
        side(i) = at_a ? s.before : f.piece;
        put(x, i, at_a ? s.a : at_b ? s.b : tank.place(f.piece, clamp(f.foot.along, 0.0, s.length)));
      });
}

}  // namespace freshet::fpm
