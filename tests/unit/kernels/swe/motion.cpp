// Kick, drift, friction and the acceleration over a bed.
#include "kernels/swe/motion.hpp"

#include <catch2/catch.hpp>

#include "tests/support/points/cloud.hpp"

using namespace freshet;
using test::Cloud;
using test::Grain;

namespace {

constexpr double g = 9.81;  // m/s2

using Level = std::function<double(double, double)>;

// Particles of given depth without pair forces (t = 0), over a bed.
template <int D>
struct Flow {
  Cloud<D> cloud;
  swe::MotionOptions<D> options;

  explicit Flow(const std::vector<Grain>& grains) : cloud(grains, 1), options{g, {0.6, 3}, {}, {}, {}, {}} {
    const swe::Particles<D> p = cloud.bind();
    for (int i = 0; i < cloud.fields.size(); ++i) p.h(i) = p.h0(i), p.celerity(i) = 1;
  }
  void lay_bed(const Level& level, double half, double spacing, bool variational) {
    options.bed = swe::BedTerm<D>{BedSpline<D>(level, {{-half, -half}, {half, half}, spacing, 0}),
                                  variational, cloud.fields.real("bed", "m", Carry::no)};
  }
  void roughen(double manning) {
    options.friction = swe::Friction{g, manning};
    options.drag = cloud.fields.real("drag", "1/m", Carry::no);
  }
  void start() { swe::accelerate_and_kick<D>(cloud.bind(), options, cloud.fields.size(), 0); }
  void step(double dt) {
    swe::kick_and_drift<D>(cloud.bind(), options, cloud.fields.size(), dt);
    swe::accelerate_and_kick<D>(cloud.bind(), options, cloud.fields.size(), 0.5 * dt);
  }
};

Grain particle(double depth, Point x = {0, 0}, Point v = {0, 0}) { return {x, v, depth, depth, 1.2}; }

// Speed that a depth reaches on a slope of 1:100 with n = 0.03.
template <int D>
double terminal_speed(double depth, double dt, int steps) {
  Flow<D> flow({particle(depth)});
  flow.lay_bed([](double x, double) { return -0.01 * x; }, 200, 10, false);
  flow.roughen(0.03);
  flow.start();
  for (int n = 0; n < steps; ++n) flow.step(dt);
  return flow.cloud.of(0, "u");
}

}  // namespace

TEST_CASE("motion: friction has the exact steady state at any step") {
  // sqrt(S) d^(2/3) / n, where docs/formulas/swe.md (S27) stands still, and its digits. The runs last 75
  // times the relaxation time v/(2 g S); what is left is the error of d^(-1/3), 2e-13.
  const double deep = std::sqrt(0.01) * std::pow(1e-2, 2.0 / 3) / 0.03,
               shallow = std::sqrt(0.01) * std::pow(1e-4, 2.0 / 3) / 0.03;
  CHECK(deep == Approx(0.1547).margin(0.5e-4));
  CHECK(shallow == Approx(7.18e-3).margin(0.5e-5));
  CHECK(terminal_speed<1>(1e-2, 1.0, 60) == Approx(deep).epsilon(1e-11));
  CHECK(terminal_speed<2>(1e-2, 1.0, 60) == Approx(deep).epsilon(1e-11));
  CHECK(terminal_speed<2>(1e-4, 0.01, 300) == Approx(shallow).epsilon(1e-11));
}

TEST_CASE("motion: friction slows and never turns round") {
  test::Random random(1);
  for (int n = 0; n < 1000; ++n) {
    const Vec<double, 2> v{random(-5, 5), random(-5, 5)};
    const double drag = std::pow(10, random(-10, 15)), dt = std::pow(10, random(-6, 3));
    const Vec<double, 2> slower = swe::slowed<2>(v, drag, dt);
    const double speed = std::sqrt(dot(v, v)), after = std::sqrt(dot(slower, slower));
    CHECK(dot(slower, v) >= 0);
    CHECK(after <= speed);
    CHECK(std::abs(slower.x * v.y - slower.y * v.x) <= 1e-15 * speed * speed);  // the same direction
    // Backward Euler's own equation: v - v_new = dt K |v_new| v_new; the root cancels where friction is
    // strong.
    CHECK(after * (1 + dt * drag * after) == Approx(speed).epsilon(1e-13));
  }
}

TEST_CASE("motion: no roughness is no friction to the bit") {
  test::Random random(2);
  for (int n = 0; n < 100; ++n) {
    const Vec<double, 2> v{random(-5, 5), random(-5, 5)}, same = swe::slowed<2>(v, 0.0, random(0, 1));
    CHECK((same.x == v.x && same.y == v.y));
  }
  CHECK(swe::Friction{g, 0.0}.drag(1e-4) == 0);
  Flow<2> plain({particle(0.1, {0, 0}, {1.1, -0.3})}), smooth({particle(0.1, {0, 0}, {1.1, -0.3})});
  smooth.roughen(0);
  for (Flow<2>* flow : {&plain, &smooth}) {
    flow->lay_bed([](double x, double y) { return 0.01 * x * x - 0.02 * y; }, 20, 1, true);
    flow->start();
    for (int n = 0; n < 20; ++n) flow->step(0.05);
  }
  for (const char* name : {"x", "y", "u", "v"}) CHECK(plain.cloud.of(0, name) == smooth.cloud.of(0, name));
}

namespace {

// Largest error of the energy of a point mass in an elliptic bowl of slopes about 1 over 10 s, relative to
// the start.
double bowl_error(double dt, bool variational) {
  const auto level = [](double x, double y) { return 0.2 * x * x + 0.35 * y * y; };
  Flow<2> flow({particle(0.1, {2.0, 0.5}, {0.5, 1.0})});
  flow.lay_bed(level, 8, 0.5, variational);
  flow.start();
  const auto energy = [&] {
    const double x = flow.cloud.of(0, "x"), y = flow.cloud.of(0, "y"), u = flow.cloud.of(0, "u"),
                 v = flow.cloud.of(0, "v");
    const double w = 0.4 * x * u + 0.7 * y * v;  // v . grad b: it follows the bed
    return 0.5 * (u * u + v * v + w * w) + g * level(x, y);
  };
  const double start = energy();
  double worst = 0;
  for (double t = 0; t < 10; t += dt) {
    flow.step(dt);
    worst = std::max(worst, std::abs(energy() - start));
  }
  return worst / start;
}

}  // namespace

TEST_CASE("motion: the variational acceleration keeps a point mass' energy, of second order in dt") {
  const double coarse = bowl_error(0.02, true), fine = bowl_error(0.01, true),
               finer = bowl_error(0.005, true);
  CHECK(finer < 1e-3);
  CHECK(coarse / fine == Approx(4).margin(1));
  CHECK(fine / finer == Approx(4).margin(0.6));
  CHECK(bowl_error(0.005, false) > 0.1);  // the classical one misses the vertical motion
}

TEST_CASE("motion: still water accelerates nowhere: t = -g B gives a = 0") {
  test::Random random(3);
  std::vector<Grain> grains;
  for (const auto& x : test::random_points(2, 50, 5, 4)) grains.push_back(particle(0.3, x));
  for (const bool variational : {true, false}) {
    Flow<2> flow(grains);
    flow.lay_bed([](double x, double y) { return std::sin(0.7 * x) * std::cos(0.5 * y); }, 6, 0.5,
                 variational);
    const swe::Particles<2> p = flow.cloud.bind();
    for (int i = 0; i < flow.cloud.fields.size(); ++i)
      put(p.t, i, -g * flow.options.bed->spline.at(at(p.x, i)).slope);
    flow.start();
    CHECK(test::largest_size(flow.cloud.by_id("ax")) < 1e-14 * g);  // three roundings of g B, B < 1
    CHECK(test::largest_size(flow.cloud.by_id("ay")) < 1e-14 * g);
  }
}

TEST_CASE("motion: one step against the formulas") {
  // docs/formulas/swe.md (S23), (S27) and (S28) with curvature, friction and a pressure force, written out.
  const auto level = [](double x, double y) { return 0.1 * x * x - 0.2 * x * y + 0.05 * y * y; };
  Flow<2> flow({particle(0.4, {1, 2}, {0.3, -0.8})});
  flow.lay_bed(level, 8, 0.5, true);
  flow.roughen(0.02);
  const swe::Particles<2> p = flow.cloud.bind();
  put(p.t, 0, {0.7, -0.2});
  const auto acceleration = [&](const Vec<double, 2>& x, const Vec<double, 2>& v) {
    const Vec<double, 2> slope{0.2 * x.x - 0.2 * x.y, -0.2 * x.x + 0.1 * x.y}, t{0.7, -0.2};
    const double curved = 0.2 * v.x * v.x - 0.4 * v.x * v.y + 0.1 * v.y * v.y;
    return -1.0 * t - (g + curved - dot(t, slope)) / (1 + dot(slope, slope)) * slope;
  };
  constexpr double dt = 0.01;
  const double drag = g * 0.02 * 0.02 / std::pow(0.4, 4.0 / 3);
  Vec<double, 2> x{1, 2}, v{0.3, -0.8};
  const Vec<double, 2> before = acceleration(x, v);
  v = swe::slowed<2>(v + 0.5 * dt * before, drag, 0.5 * dt);
  x += dt * v;
  const Vec<double, 2> predicted = swe::slowed<2>(v + 0.5 * dt * before, drag, 0.5 * dt);
  v = swe::slowed<2>(v + 0.5 * dt * acceleration(x, predicted), drag, 0.5 * dt);
  flow.start();
  flow.step(dt);
  // The bed is a polynomial that the spline has to 1e-11 (bed_spline.cpp); cube roots are good to 2e-13.
  CHECK(flow.cloud.of(0, "x") == Approx(x.x).epsilon(1e-10));
  CHECK(flow.cloud.of(0, "y") == Approx(x.y).epsilon(1e-10));
  CHECK(flow.cloud.of(0, "u") == Approx(v.x).epsilon(1e-9));
  CHECK(flow.cloud.of(0, "v") == Approx(v.y).epsilon(1e-9));
  CHECK(flow.cloud.of(0, "bed") == Approx(level(x.x, x.y)).epsilon(1e-10));
}

TEST_CASE("motion: the depth is predicted to second order and stays positive, h within its bounds") {
  Flow<1> flow({particle(0.4), particle(0.4), particle(0.4), particle(0.4)});
  const swe::Particles<1> p = flow.cloud.bind();
  p.growth(0) = 0.04, p.growth(1) = -400, p.growth(2) = 400, p.growth(3) = 0;
  swe::kick_and_drift<1>(p, flow.options, 4, 0.1);
  CHECK(p.rho(0) == Approx(0.4 * std::exp(0.01)).epsilon(1e-7));  // the next term of exp: z^3/12
  CHECK(p.rho(1) == Approx(0.4 * 0.6));  // (1 - 1/4)/(1 + 1/4): growth is held within a half
  CHECK(p.rho(2) == Approx(0.4 / 0.6));
  CHECK(p.rho(3) == 0.4);
  CHECK(p.h(0) == Approx(1.2 * 0.4 / p.rho(0)));  // rho h = kh
  CHECK(p.h(2) == Approx(0.6 * 1.2));
}

TEST_CASE("motion: imposed particles keep their velocity, with and without friction") {
  for (const bool rough : {false, true}) {
    Flow<2> flow({particle(0.4, {0, 0}, {0.5, 0.25}), particle(0.4, {1, 0}, {0.5, 0.25})});
    const auto kind = flow.cloud.fields.integer("kind", "1", Carry::no);
    kind(1) = 1;
    flow.options.imposed = {kind};
    flow.lay_bed([](double x, double) { return 0.1 * x; }, 20, 1, true);
    if (rough) flow.roughen(0.05);
    flow.start();
    for (int n = 0; n < 10; ++n) flow.step(0.1);
    CHECK(flow.cloud.of(1, "u") == 0.5);
    CHECK(flow.cloud.of(1, "v") == 0.25);
    CHECK(flow.cloud.of(1, "x") == Approx(1.5).epsilon(1e-14));
    CHECK(flow.cloud.of(0, "u") < 0.5);
  }
}

TEST_CASE("motion: the crossing time is the least h / (c + signal)") {
  std::vector<Grain> grains(37, particle(0.4));  // the last block is not full
  Flow<2> flow(grains);
  const swe::Particles<2> p = flow.cloud.bind();
  test::Random random(5);
  double least = 1e300;
  for (int i = 0; i < 37; ++i) {
    p.h(i) = random(0.5, 2), p.celerity(i) = random(1, 3), p.signal(i) = random(0, 4);
    least = std::min(least, p.h(i) / (p.celerity(i) + p.signal(i)));
  }
  CHECK(swe::accelerate_and_kick<2>(p, flow.options, 37, 0) == Approx(least).epsilon(1e-15));
  p.h(36) = 1e-3;
  CHECK(swe::accelerate_and_kick<2>(p, flow.options, 37, 0) ==
        Approx(1e-3 / (p.celerity(36) + p.signal(36))).epsilon(1e-15));
}
