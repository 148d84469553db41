// Implicit viscosity: shear flows decay as they should at steps far beyond the explicit limit, to second
// order in time, between walls that hold or slip and below a free surface.
#include <catch2/catch.hpp>

#include <functional>

#include "src/errors.hpp"
#include "tests/support/run/flow.hpp"

using namespace freshet;

namespace {

// Periodic along x, of unit height and 1 m2/s. wall: "slip", "no-slip" or "" for periodic along y too.
Scene shear(double spacing, const std::string& profile, const std::string& wall,
            const std::string& diffusion) {
  const std::string walls =
      wall.empty() ? "" : "[[wall]]\nline = [[0, 0], [1, 0]]\n[[wall]]\nline = [[1, 1], [0, 1]]\n";
  return read_scene_text(
      "[scene]\nname = \"shear\"\nmethod = \"fpm\"\n[domain]\nbox = [0, 0, 1, 1]\nperiodic = " +
          std::string(wall.empty() ? "[\"x\", \"y\"]" : "[\"x\"]") +
          "\n[fluid]\ndensity = 1\nviscosity = 1\nforce = [0, 0]\n[fpm]\ndiffusion = \"" + diffusion +
          "\"\nwalls = \"" + (wall == "no-slip" ? "no-slip" : "slip") +
          "\"\n[water]\ndisorder = 0.2\nspacing = " + std::to_string(spacing) +
          "\n[[body]]\nbox = [0, 0, 1, 1]\nvelocity = [\"0.01*" + profile + "\", \"0\"]\n" + walls +
          "[time]\nend = 1\n[output]\nevery = 1\n",
      "shear.toml");
}

// The part of the profile in u, over its start.
double amplitude(const test::FlowRun& run, const std::function<double(double)>& profile) {
  double sum = 0, square = 0;
  for (const auto& q : run.points()) {
    sum += q.u * profile(q.y);
    square += profile(q.y) * profile(q.y);
  }
  return sum / (0.01 * square);
}

double after(const Scene& scene, int steps, double dt, const std::function<double(double)>& profile) {
  test::FlowRun run(scene);
  run.steps(steps, dt);
  return amplitude(run, profile);
}

double whole_wave(double y) { return std::sin(2 * pi * y); }
double half_wave(double y) { return std::sin(pi * y); }
double half_cosine(double y) { return std::cos(pi * y); }

}  // namespace

TEST_CASE(
    "A shear layer decays implicitly at sixteen times the explicit step, where the explicit form is lost") {
  // dx = 1/40: explicit limit 0.125 h^2 / nu = 8e-4 s (the step's tau is 2/3 of it: 1.2e-3 s); decay exp(-4
  // pi^2 t).
  const double dt = 0.0125, exact = std::exp(-4 * pi * pi * 4 * dt);
  const double implicit = after(shear(0.025, "sin(2*pi*y)", "", "implicit"), 4, dt, whole_wave);
  CAPTURE(implicit, exact);
  // Backward differences of four steps of 0.49 decay times: a tenth of the start at most.
  CHECK(std::abs(implicit - exact) < 0.1);
  CHECK(implicit > 0);
  double explicitly = 0;
  try {
    // Short waves grow tenfold a step and drag the long one along; a run would stop here, its next stable
    // step being next to nothing.
    explicitly = after(shear(0.025, "sin(2*pi*y)", "", "explicit"), 10, dt, whole_wave);
  } catch (const Diverged&) { explicitly = 1e300; }
  CHECK_FALSE(std::abs(explicitly) < 10);
}

TEST_CASE("Implicit viscosity is second order in time") {
  const auto run = [](int steps) {
    return after(shear(0.025, "sin(2*pi*y)", "", "implicit"), steps, 0.02 / steps, whole_wave);
  };
  const double coarse = run(4), middle = run(8), fine = run(16), exact = std::exp(-4 * pi * pi * 0.02);
  CAPTURE(coarse, middle, fine, exact);
  // Differences of successive halvings on the same points; 4 is order 2, the first step's backward Euler
  // leaves less than a third.
  CHECK((coarse - middle) / (middle - fine) > 3);
  // What is left is the stencils' error at dx = 1/40.
  CHECK(std::abs(fine / exact - 1) < 0.02);
}

TEST_CASE("Implicit viscosity between walls that hold and walls that slip: both decay with pi^2 nu") {
  // 20 steps of 0.005 s, 6 times the explicit limit; backward differences at 0.05 decay times are 0.2 % off,
  // stencils at walls the rest.
  const double exact = std::exp(-pi * pi * 0.1);
  const double held = after(shear(0.025, "sin(pi*y)", "no-slip", "implicit"), 20, 0.005, half_wave);
  const double slipping = after(shear(0.025, "cos(pi*y)", "slip", "implicit"), 20, 0.005, half_cosine);
  CAPTURE(held, slipping, exact);
  CHECK(held / exact == Approx(1).margin(0.02));
  CHECK(slipping / exact == Approx(1).margin(0.02));
}

TEST_CASE("A film runs down a slope with the parabolic profile under implicit viscosity") {
  // u = f / nu (H y - y^2 / 2), H = 0.5 m: 0.125 m/s on the surface; decay of the start 9.9 1/s, 0.8 s leave
  // 4e-4.
  test::FlowRun run(read_scene_text(R"([scene]
name = "film"
method = "fpm"
[domain]
box = [0, 0, 1, 1]
periodic = ["x"]
[fluid]
viscosity = 1
force = [1, -9.81]
[fpm]
diffusion = "implicit"
[water]
spacing = 0.05
[[body]]
box = [0, 0, 1, 0.5]
[[wall]]
line = [[0, 0], [1, 0]]
[time]
end = 0.8
[output]
every = 0.8
)",
                                    "film.toml"));
  run.run_to(0.8);
  double worst = 0;
  for (const auto& q : run.points())
    worst = std::max(worst, std::hypot(q.u - (0.5 * q.y - 0.5 * q.y * q.y), q.v));
  CAPTURE(worst, run.clock.step);
  CHECK(worst < 0.01 * 0.125);  // the quadratic basis holds the profile exactly: what is left is the start
}

TEST_CASE("Still water stays still under implicit viscosity") {
  test::FlowRun run("fpm_still_box", {"fluid.viscosity=1", "fpm.diffusion=implicit"});
  run.run_to(3);
  double fastest = 0, off = 0;
  for (const auto& q : run.points()) {
    fastest = std::max(fastest, std::hypot(q.u, q.v));
    off = std::max(off, std::abs(q.p - 9810 * (1 - q.y)) / 9810);
  }
  CAPTURE(fastest, off);
  CHECK(fastest <= 1e-8);
  CHECK(off <= 1e-9);
}

// Two columns let go at a Reynolds number of 8: most of the energy goes into shear below the surfaces.
TEST_CASE("Explicit viscosity below free surfaces takes as much energy as the implicit one does") {
  const auto kinetic = [](const std::string& diffusion) {
    test::FlowRun run("stress/fpm_fronts",
                      {"fluid.viscosity=0.1", "time.end=0.2", "fpm.diffusion=" + diffusion});
    run.run_to(0.2);
    return run.solver.mechanics().kinetic;
  };
  const double explicitly = kinetic("explicit"), implicitly = kinetic("implicit");
  CAPTURE(explicitly, implicitly);
  CHECK(
      explicitly ==
      Approx(implicitly).epsilon(0.05));  // first order in time both: 1.5 %; with a one-sided Laplacian 220 %
}
