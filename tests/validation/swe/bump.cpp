// Steady flow over a bump against the exact solution (Vacondio 2010, section 4.3): jump, transcritical,
// supercritical.
#include <catch2/catch.hpp>

#include <cmath>

#include "src/reference/bump.hpp"
#include "tests/support/run/run_case.hpp"

using namespace freshet;

namespace {

constexpr double cell = 0.05;  // m, dx
constexpr int cells = 200;

// Means of the particles that passed each cell of the channel: what stands still of a flow whose particles
// move.
struct Profile {
  std::vector<double> depth = std::vector<double>(cells), discharge = depth, count = depth;

  void add(const Method& method) {
    const auto x = on_host(method.fields().real("x")), u = on_host(method.fields().real("u"));
    const auto d = on_host(method.fields().real("depth"));
    const auto kind = on_host(method.fields().integer("kind"));
    for (int i = 0; i < method.fields().size(); ++i) {
      const auto k = static_cast<std::size_t>(std::max(0.0, x(i) / cell));
      if (kind(i) != 0 || k >= cells) continue;
      depth[k] += d(i), discharge[k] += d(i) * u(i), count[k] += 1;
    }
  }
  double depth_in(std::size_t k) const { return depth[k] / count[k]; }
  double discharge_in(std::size_t k) const { return discharge[k] / count[k]; }
};
double middle(std::size_t k) { return (static_cast<double>(k) + 0.5) * cell; }

// The last two spans of a run.
struct Steady {
  Profile before, last;
  double span;  // s

  // rms over the channel of the relative depth change per second.
  double change() const {
    double sum = 0;
    for (std::size_t k = 0; k < cells; ++k)
      sum += std::pow((last.depth_in(k) / before.depth_in(k) - 1) / span, 2);
    return std::sqrt(sum / cells);
  }
  // Largest relative error of the discharge farther than `blur` from `jump`.
  double discharge_error(double exact, double jump = -1e9, double blur = 0) const {
    double most = 0;
    for (std::size_t k = 0; k < cells; ++k)
      if (std::abs(middle(k) - jump) > blur)
        most = std::max(most, std::abs(last.discharge_in(k) / exact - 1));
    return most;
  }
  // Where the depth passes a value on its way up, behind the crest.
  double rises_to(double depth) const {
    for (std::size_t k = cells / 2; k + 1 < cells; ++k) {
      const double a = last.depth_in(k), b = last.depth_in(k + 1);
      if (a < depth && b >= depth) return middle(k) + cell * (depth - a) / (b - a);
    }
    return 1e9;
  }
};

Steady run_to_steady(const Scene& scene, double span) {
  const auto method = make_method(scene);
  Steady s{{}, {}, span};
  for (double t = 0; t < scene.end_time;) {
    const double dt = method->stable_dt();
    method->step(t, dt);
    t += dt;
    if (t > scene.end_time - span) s.last.add(*method);
    else if (t > scene.end_time - 2 * span) s.before.add(*method);
  }
  return s;
}

const SteadyBumpFlow& exact_of(const Scene& scene) {
  return dynamic_cast<const SteadyBumpFlow&>(*scene.compare.exact);
}

}  // namespace

// Bounds of the project's list of cases: steady below 1e-4 1/s, the discharge within 1 % outside the jump,
// the jump within 2 dx.

TEST_CASE("flow over a bump with a jump: steady, its discharge, its jump", "[long]") {
  const Scene scene = test::read_case("bump_i");
  const SteadyBumpFlow& exact = exact_of(scene);
  REQUIRE(exact.jump());
  const double jump = *exact.jump();
  // The water before the jump is stretched: its kernels blur the jump by 2 h on both sides.
  const double inflow = exact.at(0, 0, 0).depth,
               blur = 2 * scene.sph.eta * scene.boundaries[0].spacing * inflow / exact.depth_before();
  const Steady s = run_to_steady(scene, 20);
  CHECK(s.change() < 1e-4);
  CHECK(s.discharge_error(exact.discharge(), jump, blur) < 0.01);
  CHECK(s.rises_to(0.5 * (exact.depth_before() + exact.depth_behind())) == Approx(jump).margin(2 * cell));
}

TEST_CASE("transcritical flow over a bump: steady, its discharge", "[long]") {
  const Scene scene = test::read_case("bump_ii");
  const Steady s = run_to_steady(scene, 20);
  CHECK(s.change() < 1e-4);
  CHECK(s.discharge_error(exact_of(scene).discharge()) < 0.01);
}

TEST_CASE("supercritical flow over a bump: steady, its discharge", "[slow]") {
  const Scene scene = test::read_case("bump_iii");
  const Steady s = run_to_steady(scene, 5);
  CHECK(s.change() < 1e-4);
  CHECK(s.discharge_error(exact_of(scene).discharge()) < 0.01);
}
