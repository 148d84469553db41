// Open boundaries: waves leave, imposed levels and waves enter, still water stays still, and the books
// balance.
#include <catch2/catch.hpp>

#include "tests/support/run/scenes.hpp"

using namespace freshet;
using test::Flow;

namespace {

constexpr double g = 9.81;                 // m/s2
constexpr double dx = 0.1;                 // m
constexpr double amplitude = 0.02;         // m, of pulses: 2 % of the depth of 1 m
constexpr double start = 12;               // m, where they start
const double celerity = std::sqrt(g * 1);  // m/s

// 40 m, 1 m deep, open on the left, a wall on the right.
Scene channel(int dimension, const OpenLaw& law, const Series& level) {
  Scene scene = test::bare_scene(dimension, {0, 0}, {40, dimension == 2 ? 0.4 : 0.0}, dx);
  scene.water.depth = [](double, double) { return 1.0; };
  test::open_left(scene, law, level);
  return scene;
}

// With a pulse of 2 m width that runs to the left: u = -2 (c - c0).
Scene with_pulse(Scene scene) {
  const auto depth = [](double x, double) { return 1 + amplitude * std::exp(-std::pow((x - start) / 2, 2)); };
  scene.water.depth = depth;
  scene.water.velocity[0] = [depth](double x, double y) {
    return -2 * (std::sqrt(g * depth(x, y)) - celerity);
  };
  return scene;
}

// Means over pieces of half a metre from x = 2 to 30 m.
struct Profile {
  std::vector<double> u, depth;
};
Profile profile(const Flow& flow) {
  constexpr int pieces = 56;
  std::vector<double> u(pieces), depth(pieces), count(pieces);
  for (int i = 0; i < flow.size(); ++i) {
    const auto k = static_cast<size_t>(std::max(0.0, std::floor((flow.real("x")(i) - 2) / 0.5)));
    if (flow.real("x")(i) < 2 || k >= pieces) continue;
    u[k] += flow.real("u")(i), depth[k] += flow.real("depth")(i), count[k] += 1;
  }
  for (size_t k = 0; k < pieces; ++k) u[k] /= count[k], depth[k] /= count[k];
  return {u, depth};
}

// What the pulse adds to a channel without one: least and largest of depth [m] and of u c/g [m].
struct Added {
  double lowest = 1e9, highest = -1e9, left_going = 1e9, right_going = -1e9;
};
Added added(const Flow& pulse, const Flow& still) {
  const Profile a = profile(pulse), b = profile(still);
  Added s;
  for (size_t k = 0; k < a.u.size(); ++k) {
    const double u = (a.u[k] - b.u[k]) * celerity / g, depth = a.depth[k] - b.depth[k];
    s.lowest = std::min(s.lowest, depth), s.highest = std::max(s.highest, depth);
    s.left_going = std::min(s.left_going, u), s.right_going = std::max(s.right_going, u);
  }
  return s;
}

struct Reflection {
  Added before, after;
};
Reflection reflection(int dimension, const OpenLaw& law) {
  const Scene scene = channel(dimension, law, {{0}, {1}});
  Flow pulse(with_pulse(scene)), still(scene);
  Reflection r;
  pulse.run(2), still.run(2);  // 6 m on its way
  r.before = added(pulse, still);
  pulse.run(8), still.run(8);  // the pulse has left at 4 s, what came back stands where it started
  r.after = added(pulse, still);
  return r;
}

}  // namespace

TEST_CASE("open boundary: a pulse leaves through a wave boundary, less than 3 % of it come back") {
  const int dimension = GENERATE(1, 2);
  CAPTURE(dimension);
  const Reflection r = reflection(dimension, IncomingWave{});
  CHECK(r.before.highest > 0.9 * amplitude);
  // Measured by the velocity of what runs to the right: the depth also keeps, at rest, what the stretched
  // lattice's kernel sum is off (0.1 % of it in 2-D).
  CHECK(std::abs(r.after.right_going) < 0.03 * amplitude);
  CHECK(std::abs(r.after.left_going) < 0.03 * amplitude);
  CHECK(std::max(r.after.highest, -r.after.lowest) < 0.06 * amplitude);
}

TEST_CASE("open boundary: an imposed level sends a pulse back upside down") {
  const int dimension = GENERATE(1, 2);
  CAPTURE(dimension);
  const Reflection r = reflection(dimension, ImposedLevel{});
  // The exact solution of a fixed level is -100 %; the scheme's own dissipation takes 1 % in the first two
  // seconds.
  CHECK(-r.after.lowest / r.before.highest == Approx(1).margin(0.1));
  CHECK(r.after.highest < 0.03 * amplitude);
  CHECK(r.after.left_going / r.before.left_going ==
        Approx(1).margin(0.1));  // u < 0 still: it runs right, upside down
}

namespace {

Series sine(double level, double size, double period, double end) {
  Series s;
  for (double t = 0; t <= end; t += period / 64) {
    s.t.push_back(t);
    s.value.push_back(level + size * std::sin(2 * pi * t / period));
  }
  return s;
}

double surface_at(const Flow& flow, double x) {
  return flow.method->sample({{x, flow.method->dimension() == 2 ? 0.2 : 0.0}})[0].depth;
}

}  // namespace

TEST_CASE("open boundary: a wave comes in with its own height") {
  const int dimension = GENERATE(1, 2);
  const OpenLaw law = GENERATE(as<OpenLaw>{}, IncomingWave{}, ImposedLevel{});
  CAPTURE(dimension, name_of(law));
  constexpr double period = 4, x = 5;
  Flow flow(channel(dimension, law, sine(1, amplitude, period, 20)));
  double mean = 0, in_phase = 0, beside = 0;
  for (int k = 0; k < 128;
       ++k) {  // two periods from 6 s on; the far wall answers after (40 + 35) m / c = 24 s
    flow.run(6 + 2 * period * k / 128);
    const double level = surface_at(flow, x), phase = 2 * pi * (flow.t - x / celerity) / period;
    mean += level / 128, in_phase += level * std::sin(phase) / 64, beside += level * std::cos(phase) / 64;
  }
  CHECK(in_phase ==
        Approx(amplitude).epsilon(0.05));  // the scheme's dissipation over 0.4 wavelengths is below 1 %
  // The inner state is a mean over 2h = 0.24 m of fluid: the answer to it may be late by 0.08 s on both ways,
  // 0.2 rad.
  CHECK(std::abs(beside) < 0.2 * amplitude);
  // The bias of the kernel sum at the seam: 0.1 to 0.2 % (docs/formulas/swe.md (S6)).
  CHECK(mean == Approx(1).margin(2e-3));
}

TEST_CASE("open boundary: the raised level of a bore makes its speed") {
  // Still water 1 m deep: u = 0.3 m/s and a bore of 1.0980 m belong together; the simple wave of
  // docs/formulas/swe.md (S37) gives 0.2998 m/s at 1.098 m.
  Flow flow(channel(1, ImposedLevel{}, {{0, 0.05}, {1, 1.098}}));
  flow.run(6);  // the bore is at 20 m
  const Profile p = profile(flow);
  for (size_t k = 0; k < 24; ++k) {  // from 2 to 14 m
    CHECK(p.u[k] == Approx(0.3).margin(0.003));
    CHECK(p.depth[k] == Approx(1.098).margin(0.003));
  }
}

namespace {

double largest_boundary_speed(const Flow& flow) {
  const auto kind = std::as_const(*flow.method).fields().integer("kind");
  double most = 0;
  int count = 0;
  for (int i = 0; i < flow.size(); ++i) {
    if (kind(i) == 0) continue;
    ++count;
    most = std::max(most, std::hypot(flow.real("u")(i), flow.real("v")(i)));
  }
  return count > 0 ? most : 1e9;
}

}  // namespace

TEST_CASE("open boundary: still water over a sloping bed stays still") {
  // Okushiri's boundary: 0.135 m deep, dx = 0.01875 m, here with a slope of 1:20 at the line itself.
  const OpenLaw law = GENERATE(as<OpenLaw>{}, IncomingWave{}, ImposedLevel{});
  CAPTURE(name_of(law));
  Scene scene = test::bare_scene(2, {0, 0}, {1.5, 0.15}, 0.01875);
  scene.bed.elevation = [](double x, double) { return -0.135 + x / 20; };
  scene.water.surface = [](double, double) { return 0.0; };
  test::open_left(scene, law, {{0}, {0}});
  Flow flow(scene);
  double fastest = 0;
  flow.run(5, [&] { fastest = std::max(fastest, largest_boundary_speed(flow)); });
  CHECK(fastest < 1e-3);
}

namespace {

// Books of a run with waves in and out.
void check_books(const Scene& scene, double end) {
  Flow flow(scene);
  const double initial = flow.method->totals().mass;
  flow.run(end);
  const Totals t = flow.method->totals();
  // Masses are added in chunks of 512: round-off of some thousand additions.
  CHECK(std::abs(t.mass - initial - t.inflow + t.outflow) < 1e-12 * initial);
  CHECK(t.inflow > 0.01 * initial);
  CHECK(t.outflow > 0.01 * initial);
  // The acceptance. What straddles the line is known to a quarter of a particle per row, so that the run must
  // be long.
  CHECK(std::abs(t.inflow - t.outflow - t.straddle - t.flux) < 5e-3 * t.flux_gross);
}

}  // namespace

TEST_CASE("open boundary: counted water is the water that flowed", "[slow]") {
  const int dimension = GENERATE(1, 2);
  const OpenLaw law = GENERATE(as<OpenLaw>{}, IncomingWave{}, ImposedLevel{});
  CAPTURE(dimension, name_of(law));
  Scene scene = channel(dimension, law, sine(1, 0.1, 5, 40));
  scene.domain.high[0] = 10;
  test::open_left(scene, law, scene.boundaries[0].imposed.at(0).series);
  check_books(scene, dimension == 2 ? 20 : 40);
}

TEST_CASE("open boundary: boundary particles keep their footprint and their buffer stays filled") {
  const int dimension = GENERATE(1, 2);
  CAPTURE(dimension);
  Flow flow(
      channel(dimension, ImposedLevel{}, {{0, 2}, {1, 1.1}}));  // inflow only: none of them has been fluid
  const auto footprint = dimension == 2 ? dx * dx : dx;
  double smallest = 9, largest = 0;
  int fewest = 1000, most = 0;
  flow.run(8, [&] {
    const auto kind = std::as_const(*flow.method).fields().integer("kind");
    int count = 0;
    for (int i = 0; i < flow.size(); ++i) {
      if (kind(i) == 0) continue;
      ++count;
      const double area = flow.real("mass")(i) / flow.real("depth")(i) / footprint;
      smallest = std::min(smallest, area), largest = std::max(largest, area);
    }
    fewest = std::min(fewest, count), most = std::max(most, count);
  });
  CHECK(flow.method->totals().inflow > 0.5 * (dimension == 2 ? 0.4 : 1));
  CHECK(largest / smallest - 1 < 1e-12);     // mass and depth change together: one rounding per step
  CHECK(largest == Approx(1).margin(3e-3));  // the depth may hold the bias of the lattice's kernel sum
  const int rows = dimension == 2 ? 4 : 1;
  CHECK(fewest >= 5 * rows);  // five columns, which are 2h at eta 1.2 and half a spacing more
  CHECK(most <= 6 * rows);
}
