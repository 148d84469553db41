// SISPH between walls of mirror pairs: standing waves in a box, a box at 30 degrees to the lattice and a
// circle, over two periods, against the exact modes. What is asked of the scheme is its order; the bounds
// beside it, a prototype's numbers and a fifth more, hold what has been reached.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "tests/support/run/scenes.hpp"

using namespace freshet;
using test::Flow;

namespace {

constexpr double gravity = 9.81;  // m, m/s2; depth 1 m

struct Basin {
  Function mode;  // of the surface, 1 at its largest
  double k;       // 1/m, wave number
  std::vector<Point> line;
  double amplitude = 1e-3;  // m
};

Basin box() {
  return {[](double x, double) { return std::cos(pi * x); }, pi, {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}};
}

Basin turned_box() {
  const double c = std::cos(pi / 6), s = std::sin(pi / 6);
  Basin basin{[c, s](double x, double y) { return std::cos(pi * (c * x + s * y)); }, pi, {}};
  for (const Point& p : box().line) basin.line.push_back({c * p[0] - s * p[1], s * p[0] + c * p[1]});
  return basin;
}

// The first mode across: J1(k r) cos(angle), J1'(k R) = 0.
Basin circle() {
  constexpr double radius = 0.5, root = 1.8411837813406593,
                   top = 0.5818652242815963;  // J1 at its first maximum
  Basin basin{[](double x, double y) {
                const double r = std::hypot(x, y);
                return r > 0 ? std::cyl_bessel_j(1.0, root / radius * r) / top * x / r : 0.0;
              },
              root / radius,
              {}};
  for (int n = 0; n <= 400; ++n)
    basin.line.push_back(
        {radius * std::cos(2 * pi * (n % 400) / 400), radius * std::sin(2 * pi * (n % 400) / 400)});
  return basin;
}

Scene basin_scene(const Basin& basin, int n, double disorder) {
  Scene scene = test::bare_scene(2, {-0.6, -0.6}, {1.4, 1.4}, 1.0 / n);
  scene.method = "sisph";
  scene.sph.eta = scene.sisph.smoothing;
  scene.sisph.theta = 0.5;
  scene.walls = {Wall{basin.line}};
  scene.water.disorder = disorder;
  scene.water.depth = [mode = basin.mode, amplitude = basin.amplitude](double x, double y) {
    return 1 + amplitude * mode(x, y);
  };
  return scene;
}

struct Seiche {
  double frequency_error;  // relative
  double l2;               // of the surface after two periods, over the amplitude
  double mass_error;
  double highest;     // of the mode's amplitudes, over the first
  double iterations;  // a linear solve
};

// The frequency whose cosine fits the amplitudes best.
double fitted_frequency(const std::vector<double>& t, const std::vector<double>& a, double expected) {
  const auto misfit = [&](double omega) {
    double ac = 0, cc = 0, aa = 0;
    for (std::size_t k = 0; k < t.size(); ++k) {
      const double c = std::cos(omega * t[k]);
      ac += a[k] * c, cc += c * c, aa += a[k] * a[k];
    }
    return aa - ac * ac / cc;
  };
  double low = 0.85 * expected, high = 1.15 * expected;
  for (int n = 0; n < 100; ++n) {
    const double a1 = low + 0.382 * (high - low), a2 = low + 0.618 * (high - low);
    if (misfit(a1) < misfit(a2)) high = a2;
    else low = a1;
  }
  return 0.5 * (low + high);
}

Seiche run(const Basin& basin, int n, double disorder, double courant = 1) {
  Flow flow(basin_scene(basin, n, disorder));
  const double omega = basin.k * std::sqrt(gravity), period = 2 * pi / omega;  // shallow water
  const double dt = courant / n / std::sqrt(gravity);
  const int steps = static_cast<int>(std::ceil(2 * period / dt));
  const double mass = flow.method->totals().mass;
  std::vector<double> time, mode;
  const auto x = flow.real("x"), y = flow.real("y"), depth = flow.real("depth");
  for (int s = 0; s <= steps; ++s) {
    double value = 0, norm = 0;
    for (int i = 0; i < flow.size(); ++i) {
      const double phi = basin.mode(x(i), y(i));
      value += (depth(i) - 1) * phi, norm += phi * phi;
    }
    time.push_back(flow.t), mode.push_back(value / norm / basin.amplitude);
    if (s < steps) flow.step(2 * period / steps);
  }
  double square = 0;
  for (int i = 0; i < flow.size(); ++i)
    square += std::pow(depth(i) - 1 - basin.amplitude * basin.mode(x(i), y(i)), 2);
  return {fitted_frequency(time, mode, omega) / omega - 1, std::sqrt(square / flow.size()) / basin.amplitude,
          std::abs(flow.method->totals().mass / mass - 1), *std::max_element(mode.begin(), mode.end()),
          static_cast<double>(flow.method->report().iterations) /
              static_cast<double>(flow.method->report().solves)};
}

struct Bound {
  int n;
  double frequency, l2;
};

// order: from the coarsest to the finest. Of the surface at least the same: it is at its highest at the end,
// where an error of the phase counts with its square.
void check(const Basin& basin, double disorder, double order, const std::vector<Bound>& bounds) {
  std::vector<Seiche> seiches;
  for (const Bound& b : bounds) {
    const Seiche s = seiches.emplace_back(run(basin, b.n, disorder));
    CAPTURE(b.n, s.frequency_error, s.l2, s.mass_error);
    CHECK(std::abs(s.frequency_error) <= 1.2 * b.frequency);
    CHECK(s.l2 <= 1.2 * b.l2);
    CHECK(s.mass_error <= 1e-13);
  }
  const double doublings = std::log2(static_cast<double>(bounds.back().n) / bounds.front().n);
  const Seiche &coarse = seiches.front(), &fine = seiches.back();
  CHECK(std::log2(coarse.frequency_error / fine.frequency_error) / doublings >= order);
  CHECK(std::log2(coarse.l2 / fine.l2) / doublings >= order);
}

}  // namespace

// Second order in space and, with a step that goes with the spacing, in time. Low enough that the wave's own
// nonlinearity does not show at n = 80.
TEST_CASE("sisph seiche: a box on the lattice") {
  Basin low = box();
  low.amplitude = 1e-4;
  check(low, 0, 1.9, {{20, 1.07e-2, 1.2e-2}, {40, 2.7e-3, 9.7e-4}, {80, 6.7e-4, 8.9e-5}});
}

// On disorder slopes are exact for linear fields and no further (docs/formulas/sisph.md (I4)): first order.
TEST_CASE("sisph seiche: a box on disorder") {
  check(box(), 0.2, 1, {{20, 1.2e-2, 1.6e-2}, {40, 3.4e-3, 2.1e-3}, {80, 1.5e-3, 6.7e-4}});
}

TEST_CASE("sisph seiche: a turned box on disorder") {
  check(turned_box(), 0.2, 1, {{20, 1.6e-2, 2.4e-2}, {40, 6.9e-3, 5.7e-3}, {80, 2.5e-3, 1.3e-3}});
}

TEST_CASE("sisph seiche: a circle on disorder") {
  check(circle(), 0.2, 1, {{20, 1.6e-2, 2.2e-2}, {40, 6.9e-3, 5.6e-3}, {80, 3.3e-3, 1.8e-3}});
}

TEST_CASE("sisph seiche: still water between walls stays exactly still") {
  const int shape = GENERATE(0, 1, 2);
  const Basin basin = shape == 0 ? box() : shape == 1 ? turned_box() : circle();
  Scene scene = basin_scene(basin, 20, 0.2);
  scene.water.depth = [](double, double) { return 1.0; };
  Flow flow(scene);
  for (int n = 0; n < 100; ++n) flow.step(0.02);
  CHECK(flow.largest_speed() == 0);
}

// Frequency: that of the trapezoidal rule in time, 2 / dt atan(omega dt / 2), is the reference for each step.
TEST_CASE("sisph seiche: large steps", "[long]") {
  const int n = 160;
  for (const double courant : {5.0, 10.0, 20.0, 50.0}) {
    const Basin basin = box();
    const Seiche s = run(basin, n, 0.2, courant);
    const double omega = basin.k * std::sqrt(gravity), period = 2 * pi / omega,
                 wanted = courant / n / std::sqrt(gravity);
    const double dt = 2 * period / std::ceil(2 * period / wanted),
                 rule = 2 / dt * std::atan(0.5 * omega * dt) / omega - 1;
    CAPTURE(courant, s.frequency_error, rule, s.l2, s.highest, s.mass_error, s.iterations);
    CHECK(std::abs(s.frequency_error - rule) <= 2e-3);
    CHECK(s.highest <= 1.01);  // stable
    CHECK(s.mass_error <= 1e-12);
    CHECK(s.iterations <= 15);
  }
}
