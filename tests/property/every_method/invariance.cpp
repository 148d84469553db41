// What must not matter does not: the datum, the origin, the axes, the numbering.
#include <catch2/catch.hpp>

#include "tests/support/run/scenes.hpp"

using namespace freshet;
using test::Flow;

namespace {

constexpr int nx = 30, ny = 20;
constexpr double dx = 0.04;  // m
constexpr int steps = 50;

// A basin with walls, a rough bed with a hump off its middle and an inclined surface: everything that a
// closed scene has.
struct Basin {
  double x0 = 0, y0 = 0;  // m, its corner
  double datum = 0;       // m
  bool turned = false;    // by 90 degrees: (x, y) -> (-y, x)

  double bed(double x, double y) const {
    const double a = x - 0.5, b = y - 0.45;
    return datum + 0.1 * std::exp(-20 * (a * a + b * b));
  }
  double surface(double x, double y) const { return datum + 0.5 + 0.06 * x + 0.04 * y; }
  // Of scene coordinates, back to those of the basin as it was.
  Function seen(double (Basin::*f)(double, double) const) const {
    return [*this, f](double x, double y) {
      const double a = x - x0, b = y - y0;
      return turned ? (this->*f)(b, -a) : (this->*f)(a, b);
    };
  }
  Scene scene() const {
    const double w = nx * dx, h = ny * dx;
    Scene s = turned ? test::bare_scene(2, {x0 - h, y0}, {x0, y0 + w}, dx)
                     : test::bare_scene(2, {x0, y0}, {x0 + w, y0 + h}, dx);
    s.bed.elevation = seen(&Basin::bed);
    s.water.surface = seen(&Basin::surface);
    s.manning = 0.03;
    // a cluster iterates together: at 1e-5 its members would show in the sixth digit
    s.sph.newton_tolerance = 1e-22;
    test::close_box(s);
    return s;
  }
};

struct State {
  std::vector<double> x, y, u, v, depth;
  double t;
};

// Positions relative to the basin's corner.
State state_after(Flow& flow, const Basin& basin) {
  flow.many_steps(steps);
  State s{flow.by_id("x"), flow.by_id("y"), flow.by_id("u"), flow.by_id("v"), flow.by_id("depth"), flow.t};
  for (double& x : s.x) x -= basin.x0;
  for (double& y : s.y) y -= basin.y0;
  return s;
}
State state_after(const Basin& basin) {
  Flow flow(basin.scene());
  return state_after(flow, basin);
}

void require_same(const State& a, const State& b, double position, double velocity) {
  CHECK(test::largest_difference(a.x, b.x) < position);
  CHECK(test::largest_difference(a.y, b.y) < position);
  CHECK(test::largest_difference(a.u, b.u) < velocity);
  CHECK(test::largest_difference(a.v, b.v) < velocity);
  CHECK(test::largest_difference(a.depth, b.depth) < velocity);
}

const State& reference() {
  static const State state = state_after(Basin{});
  return state;
}

}  // namespace

TEST_CASE("invariance: the basin of these tests does move") {
  Flow flow(Basin{}.scene());
  flow.many_steps(steps);
  CHECK(flow.largest_speed() > 0.05);
  CHECK(flow.t > 0.2);
}

// The bounds below are some ten times a rounding of the input, as far as fifty steps near walls magnify it:
// an error e of a position changes the depth by d e/dx and the acceleration by g d e/dx^2, that is 3e3 1/s^2
// e over 0.35 s.

TEST_CASE("invariance: bed and surface raised by 100 m") {
  // Levels round by 1.4e-14 m, slopes by that over dx: 4e-13, times g t.
  require_same(reference(), state_after(Basin{0, 0, 100}), 1e-11, 1e-10);
}

TEST_CASE("invariance: moved by (1e5, 2e5) m") {
  // Positions round by 3e-11 m in every step.
  require_same(reference(), state_after(Basin{1e5, 2e5}), 1e-7, 1e-6);
}

TEST_CASE("invariance: turned by 90 degrees") {
  const Basin turned{0, 0, 0, true};
  State s = state_after(turned);
  // The cell (i, j) of the basin is the cell (ny - 1 - j, i) of the turned one.
  State back = s;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const auto here = static_cast<size_t>(j * nx + i), there = static_cast<size_t>(i * ny + ny - 1 - j);
      back.x[here] = s.y[there], back.y[here] = -s.x[there];
      back.u[here] = s.v[there], back.v[here] = -s.u[there];
      back.depth[here] = s.depth[there];
    }
  require_same(reference(), back, 1e-12, 1e-11);  // positions and sums round by 1e-16
}

TEST_CASE("invariance: ids dealt out anew") {
  Flow flow(Basin{}.scene());
  const auto id = std::as_const(*flow.method).fields().integer("id");
  std::vector<int> old(static_cast<size_t>(flow.size()));
  for (int i = 0; i < flow.size(); ++i) {
    const int fresh = (id(i) * 379 + 71) % flow.size();  // 379 and 600 have no common divisor
    old[static_cast<size_t>(fresh)] = id(i);
    id(i) = fresh;
  }
  const State s = state_after(flow, Basin{});
  State back = s;
  for (size_t k = 0; k < old.size(); ++k) {
    const auto there = static_cast<size_t>(old[k]);
    back.x[there] = s.x[k], back.y[there] = s.y[k], back.u[there] = s.u[k], back.v[there] = s.v[k];
    back.depth[there] = s.depth[k];
  }
  require_same(reference(), back, 1e-12, 1e-11);  // positions and sums round by 1e-16
}

namespace {

void copy_saved(const Flow& from, Flow& to) {
  const FieldSet& source = std::as_const(*from.method).fields();
  FieldSet& target = to.method->fields();
  target.resize(source.size());
  const auto copy = [&](const auto& fields, const auto& get) {
    for (const auto& f : fields)
      if (is_saved(f.carry))
        for (int i = 0; i < source.size(); ++i) get(f.name)(i) = f.data(i);
  };
  copy(source.reals(), [&](const std::string& name) { return target.real(name); });
  copy(source.integers(), [&](const std::string& name) { return target.integer(name); });
  to.method->restore(from.method->scalars());
  to.t = from.t;
}

// A drop in the middle of a walled box, moving down.
Scene falling_drop() {
  Scene scene = test::bare_scene(2, {0, 0}, {1.2, 1.2}, dx);
  scene.water.depth = [](double x, double y) { return std::hypot(x - 0.6, y - 0.6) < 0.3 ? 0.3 : 0.0; };
  scene.water.velocity = {[](double, double) { return 0.1; }, [](double, double) { return -1.0; }};
  test::close_box(scene);
  return scene;
}

}  // namespace

TEST_CASE("invariance: going on from a saved state, also where a wall is crossed in the first step") {
  Flow straight(falling_drop()), resumed(falling_drop());
  const auto y = straight.real("y");
  double lowest = 1e9;
  for (int i = 0; i < straight.size(); ++i) lowest = std::min(lowest, y(i));
  const double dt = straight.method->stable_dt();
  for (int i = 0; i < straight.size(); ++i) y(i) -= lowest - 1.02 * dt;  // nearly at the wall after one step
  straight.step(dt);
  copy_saved(straight, resumed);
  int crossing = 0;
  for (int i = 0; i < straight.size(); ++i)
    crossing += straight.real("y")(i) + dt * straight.real("v")(i) < 0;
  REQUIRE(crossing > 0);
  double worst = 0;
  for (int n = 0; n < 10; ++n) {
    straight.step(dt), resumed.step(dt);
    for (const char* name : {"x", "y", "u", "v", "depth"})
      worst = std::max(worst, test::largest_difference(straight.by_id(name), resumed.by_id(name)));
  }
  CHECK(worst == 0);
}
