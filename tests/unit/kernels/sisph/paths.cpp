// Paths of moving SISPH particles: the order of each rule along a path whose velocity is known.
#include <catch2/catch.hpp>

#include <cmath>

#include "kernels/sisph/moving/paths.hpp"

using namespace freshet::sisph;

namespace {

using Rule = PathWeights (*)(const PathStep&);

// Where a particle that starts at 0 with the velocity cos t is at t = 2 (exactly sin 2), in steps of 2/n and
// 3/n by turns.
double arrival(Rule rule, double theta, int n) {
  double x = 0, t = 0, last = 0;
  for (int k = 0; k < n; ++k) {
    const double dt = (k % 2 == 0 ? 1.6 : 2.4) / n;
    const PathWeights w = rule({theta, dt, last});
    x += dt * (w.before * std::cos(t - last) + w.start * std::cos(t) + w.end * std::cos(t + dt));
    t += dt, last = dt;
  }
  return x;
}

double order(Rule rule, double theta = 0) {
  const auto error = [&](int n) { return std::abs(arrival(rule, theta, n) - std::sin(2.0)); };
  return std::log2(error(64) / error(128));
}

}  // namespace

TEST_CASE("sisph paths: each rule has its order, with steps of changing length", "[sisph]") {
  CHECK(order(euler_path) == Approx(1).margin(0.1));
  CHECK(order(theta_path, 0.6) == Approx(1).margin(0.1));
  CHECK(order(theta_path, 0.5) == Approx(2).margin(0.1));
  CHECK(order(rk2_path) == Approx(2).margin(0.1));
  CHECK(order(leap_frog_path) == Approx(2).margin(0.1));
  CHECK(order(rk3_path) == Approx(3).margin(0.15));
}

TEST_CASE("sisph paths: water in uniform motion is carried exactly", "[sisph]") {
  for (const PathWeights& w : {euler_path({}), theta_path({0.7, 0, 0}), rk2_path({}), leap_frog_path({}),
                               rk3_path({0, 0.1, 0}), rk3_path({0, 0.1, 0.3})}) {
    CHECK(w.before + w.start + w.end == Approx(1).epsilon(1e-15));
    CHECK(w.half_start + w.half_end == Approx(1).epsilon(1e-15));
  }
  // nothing is known before: the velocity is taken to be linear
  const PathWeights first = rk3_path({0, 0.1, 0});
  CHECK(first.before == 0);
  CHECK(first.start == Approx(0.5));
}
