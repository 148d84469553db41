// Paths of moving SISPH particles: the order of each rule along a path whose velocity is known.
#include <catch2/catch.hpp>

#include <cmath>
#include <functional>

#include "kernels/sisph/moving/paths.hpp"

using namespace freshet::sisph;

namespace {

using Rule = std::function<PathWeights(double dt, double last)>;

// Where a particle that starts at 0 with the velocity cos t is at t = 2 (exactly sin 2), in steps of 2/n and 3/n by turns.
double arrival(const Rule& rule, int n) {
  double x = 0, t = 0, last = 0;
  for (int k = 0; k < n; ++k) {
    const double dt = (k % 2 == 0 ? 1.6 : 2.4) / n;
    const PathWeights w = rule(dt, last);
    x += dt * (w.before * std::cos(t - last) + w.start * std::cos(t) + w.end * std::cos(t + dt));
    t += dt, last = dt;
  }
  return x;
}

double order(const Rule& rule) {
  const auto error = [&](int n) { return std::abs(arrival(rule, n) - std::sin(2.0)); };
  return std::log2(error(64) / error(128));
}

}  // namespace

TEST_CASE("sisph paths: each rule has its order, with steps of changing length", "[sisph]") {
  CHECK(order([](double, double) { return euler_path(); }) == Approx(1).margin(0.1));
  CHECK(order([](double, double) { return theta_path(0.6); }) == Approx(1).margin(0.1));
  CHECK(order([](double, double) { return theta_path(0.5); }) == Approx(2).margin(0.1));
  CHECK(order([](double, double) { return rk2_path(); }) == Approx(2).margin(0.1));
  CHECK(order([](double, double) { return leap_frog_path(); }) == Approx(2).margin(0.1));
  CHECK(order([](double dt, double last) { return rk3_path(dt, last); }) == Approx(3).margin(0.15));
}

TEST_CASE("sisph paths: water in uniform motion is carried exactly", "[sisph]") {
  for (const PathWeights& w : {euler_path(), theta_path(0.7), rk2_path(), leap_frog_path(), rk3_path(0.1, 0), rk3_path(0.1, 0.3)}) {
    CHECK(w.before + w.start + w.end == Approx(1).epsilon(1e-15));
    CHECK(w.half_start + w.half_end == Approx(1).epsilon(1e-15));
  }
  const PathWeights first = rk3_path(0.1, 0);  // nothing is known before: the velocity is taken to be linear
  CHECK(first.before == 0);
  CHECK(first.start == Approx(0.5));
}
