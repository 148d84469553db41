// Supports by the number of neighbours: what the iteration settles at, and flows that use it.
#include <catch2/catch.hpp>

#include "kernels/fpm/cells/supports.hpp"
#include "kernels/fpm/stencils/mls.hpp"
#include "tests/support/points/fpm_points.hpp"
#include "tests/support/run/flow.hpp"

using namespace freshet;
using test::FlowPoints;

namespace {

constexpr double dx = 0.1;  // m

// A lattice whose spacing along x is `stretch` times that along y, `jitter` x dx off.
std::vector<Point> lattice(double stretch, double jitter) {
  std::vector<Point> all;
  for (int i = 0; i < 25; ++i)
    for (int j = 0; j < 25; ++j) all.push_back({stretch * i * dx, j * dx});
  return test::jittered(all, jitter * dx, 5);
}

struct Sized {
  FlowPoints set;
  Field<double> h;
  int unsettled;
  Sized(double stretch, double jitter)
      : set(lattice(stretch, jitter), dx), h("h", static_cast<std::size_t>(set.size())) {
    unsettled = fpm::fit_supports(set.cloud(), set.size(), h, {}).unsettled;
  }
  // Brute force: the weighted number of points around point i.
  double count(int i) const {
    double sum = 0;
    for (int j = 0; j < set.size(); ++j)
      sum += fpm::weight(test::squared(set.at(i), set.at(j)) / (h(i) * h(i)));
    return sum;
  }
  // Points a wide support from the lattice's sides.
  template <class See>
  void for_each_inner(double stretch, const See& see) const {
    for (int i = 0; i < set.size(); ++i) {
      const Point p = set.at(i);
      if (p[0] > 5 * dx * stretch && p[0] < 19 * dx * stretch && p[1] > 5 * dx && p[1] < 19 * dx) see(i);
    }
  }
};

}  // namespace

TEST_CASE("fpm supports: every inner point has the neighbours asked for, by brute force") {
  const double wanted = fpm::neighbours_wanted(3.2);
  for (const double stretch : {1.0, 1.5, 0.7})
    for (const double jitter : {0.0, 0.3}) {
      const Sized s(stretch, jitter);
      CAPTURE(stretch, jitter);
      CHECK(s.unsettled == 0);
      int inner = 0;
      s.for_each_inner(stretch, [&](int i) {
        if (s.h(i) < 0.8001 * 3.2 * dx || s.h(i) > 1.4999 * 3.2 * dx) return;  // held at its bounds
        ++inner;
        // Newton's steps end below 1e-3 of h, the next would be of its square; points at r = h count 2e-4 of
        // the sum, or nothing.
        CHECK(s.count(i) == Approx(wanted).epsilon(1e-3));
      });
      REQUIRE(inner > 100);
    }
}

TEST_CASE(
    "fpm supports: on a lattice they are the given ones, at its sides wider, and as wide as the fewer "
    "neighbours ask for") {
  const Sized s(1, 0), wide(1.5, 0);
  s.for_each_inner(
      1, [&](int i) { CHECK(s.h(i) == Approx(3.2 * dx).epsilon(1e-3)); });  // sums of a lattice for integrals
  wide.for_each_inner(1.5,
                      [&](int i) { CHECK(wide.h(i) == Approx(3.2 * dx * std::sqrt(1.5)).epsilon(0.02)); });
  for (int i = 0; i < s.set.size(); ++i) {
    const Point p = s.set.at(i);
    const bool side = p[0] < 0.01 * dx, corner = side && p[1] < 0.01 * dx;
    if (corner) CHECK(s.h(i) == Approx(1.5 * 3.2 * dx));
    // Half a plane and half of the line on its edge: pi a^2 / 14 + a root(pi / 28) = pi 3.2^2 / 7 at a
    // = 3.840.
    else if (side && p[1] > 6 * dx && p[1] < 18 * dx) CHECK(s.h(i) == Approx(3.84 * dx).epsilon(1e-3));
  }
}

TEST_CASE("fpm supports: eddies keep their accuracy with supports by the number of neighbours") {
  const auto error = [](const std::vector<std::string>& overrides) {
    std::vector<std::string> all{"water.spacing=0.05", "time.end=0.5"};
    all.insert(all.end(), overrides.begin(), overrides.end());
    test::FlowRun run("fpm_taylor_green", all);
    run.run_to(0.5);
    const double w = 2 * pi, decay = std::exp(-2 * w * w * run.scene.fpm->viscosity * 0.5);
    const auto& velocity = run.scene.fpm->bodies[0].velocity;
    double sum = 0, count = 0;
    for (const auto& p : run.points()) {
      const Point v{velocity[0](p.x, p.y), velocity[1](p.x, p.y)};
      sum += (p.u - decay * v[0]) * (p.u - decay * v[0]) + (p.v - decay * v[1]) * (p.v - decay * v[1]),
          count += 2;
    }
    return std::sqrt(sum / count);
  };
  const double given = error({}), counted = error({"fpm.support_by=neighbours"});
  CAPTURE(given, counted);
  CHECK(counted < 1.5 * given);
}
