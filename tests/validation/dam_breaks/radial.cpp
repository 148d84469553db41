// Circular dam breaks against the radial finite-volume reference (Vacondio 2010, sections 2.7 and 3.4.1).
#include <catch2/catch.hpp>

#include <cmath>
#include <map>

#include "src/reference/radial.hpp"
#include "tests/support/run/run_case.hpp"

using namespace freshet;

namespace {

constexpr double g = 9.81;

struct Bound {
  double t, depth, velocity;  // s, thesis (2.58), thesis (2.59)
};

// Rms difference [m] between a particle's depth error and the mean of its ring of width `ring` [m]: what
// depends on the direction alone. Over the particles within `rim` [m].
double asymmetry(const Fluid& fluid, const RadialProfile& reference, double ring, double rim) {
  struct Sum {
    double error = 0, count = 0;
  };
  std::map<int, Sum> rings;
  const auto radius = [&](std::size_t k) { return std::hypot(fluid.x[k], fluid.y[k]); };
  const auto error = [&](std::size_t k) {
    return fluid.depth[k] - reference.at(fluid.x[k], fluid.y[k]).depth;
  };
  for (std::size_t k = 0; k < fluid.size(); ++k) {
    Sum& sum = rings[static_cast<int>(radius(k) / ring)];
    sum.error += error(k);
    ++sum.count;
  }
  double squares = 0, count = 0;
  for (std::size_t k = 0; k < fluid.size(); ++k) {
    if (radius(k) > rim) continue;
    const Sum& sum = rings[static_cast<int>(radius(k) / ring)];
    squares += std::pow(error(k) - sum.error / sum.count, 2);
    ++count;
  }
  return std::sqrt(squares / count);
}

double outermost(const Fluid& fluid) {
  double most = 0;
  for (std::size_t k = 0; k < fluid.size(); ++k) most = std::max(most, std::hypot(fluid.x[k], fluid.y[k]));
  return most;
}

}  // namespace

TEST_CASE("the circular dam break on wet ground is as accurate as the best known of the scheme", "[slow]") {
  // The thesis prints (Table 2.2, Lax-Friedrichs with MUSCL) 0.014/0.007, 0.015/0.009, 0.016/0.011, here with
  // half of its last digit; the first depth is held to what has been reached.
  constexpr Bound bounds[] = {{10, 0.013, 0.0075}, {30, 0.015, 0.0095}, {50, 0.0165, 0.0115}};
  const test::CaseRun run = test::finish_case("dam_break_radial");
  const test::Results& summary = run.summary;
  const Fluid& fluid = run.fluid;
  REQUIRE(summary.errors_at.size() == 3);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& [t, errors] = summary.errors_at[k];
    CAPTURE(t);
    CHECK(t == bounds[k].t);
    CHECK(errors.depth_l2_mean_rel <= bounds[k].depth);
    CHECK(errors.velocity_l2_x <= bounds[k].velocity);
    CHECK(errors.velocity_l2_y <= bounds[k].velocity);
  }
  // The square lattice must not show: 0.5 % of the inner depth is below the error in depth itself.
  const double direction = asymmetry(fluid, radial_dam_profile({10, 5, 100}, 50, g), 5.5, 640);
  CAPTURE(direction);
  CHECK(direction <= 0.05);
}

TEST_CASE("the circular dam break on dry ground converges, its front behind the exact one") {
  const test::CaseRun run = test::finish_case("dam_break_radial_dry");
  const test::Results& summary = run.summary;
  const Fluid& fluid = run.fluid;
  CHECK(summary.initial_particles == 5024);
  REQUIRE(summary.errors_at.size() == 3);
  // As an independent prototype, which had 0.0214 and, with a quarter of the spacing in area (20,108
  // particles), 0.0132. A scheme of first order rounds the corners of a rarefaction over the root of the
  // spacing, by as much: 3/4 in L2 in the limit; 0.69 was found, as in the prototype (0.70).
  const test::CaseRun finer = test::finish_case("dam_break_radial_dry", {"water.spacing=12.5"});
  const double coarse = summary.errors_at[2].errors.depth_l2_rel, fine = finer.summary.errors.depth_l2_rel;
  CAPTURE(coarse, fine);
  CHECK(coarse <= 0.022);
  CHECK(fine <= 0.014);
  CHECK(std::log2(coarse / fine) >= 0.6);
  const RadialProfile reference = radial_dam_profile({10, 0, 1000}, 50, g);
  const double direction = asymmetry(fluid, reference, 25, 2000);
  CAPTURE(direction);
  CHECK(direction <= 0.05);
  // Without splitting the outermost ring has no neighbours ahead and its particles drift apart: it lags,
  // by 10.3 spacings in a prototype, behind the place where the reference is 1 cm deep. It must not run
  // ahead, and comes nearer with the spacing.
  const double lag = (reference.front(0.01) - outermost(fluid)) / 25,
               finer_lag = (reference.front(0.01) - outermost(finer.fluid)) / 25;
  CAPTURE(lag, finer_lag);
  CHECK(lag >= 0);
  CHECK(lag <= 11);
  CHECK(finer_lag >= 0);
  CHECK(finer_lag < lag);
}
