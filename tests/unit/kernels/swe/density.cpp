// The density Newton, alpha, d rho/dt and the velocity gradient against direct sums over all pairs.
#include "kernels/swe/density/density.hpp"

#include <catch2/catch.hpp>

#include "kernels/swe/density/lattice.hpp"
#include "tests/support/points/cloud.hpp"

using namespace freshet;
using test::Cloud;
using test::Grain;

namespace {

constexpr double dx = 0.1;  // m
constexpr double g = 9.81;  // m/s2

double distance(const Grain& a, const Grain& b) { return std::hypot(a.x[0] - b.x[0], a.x[1] - b.x[1]); }

// sum_j m_j W(r_ij, h)
double summed(int dimension, const std::vector<Grain>& grains, const Grain& at, double h) {
  double sum = 0;
  for (const Grain& other : grains) sum += other.m * test::printed_w(dimension, distance(at, other) / h);
  return sum / std::pow(h, dimension);
}

struct Root {
  double rho, h;
  int bound;  // -1: h at its floor, 1: at its cap
};

// sum m W(h) = rho with rho h^D = kh. F(h) = h^D sum m W grows with h, so that there is one root at most.
Root bisect(int dimension, const std::vector<Grain>& grains, const Grain& grain,
            const swe::LengthBounds& bounds) {
  const double kh = grain.rho0 * std::pow(grain.h0, dimension);
  double low = bounds.floor * grain.h0, high = bounds.cap * grain.h0;
  const auto excess = [&](double h) {
    return summed(dimension, grains, grain, h) * std::pow(h, dimension) - kh;
  };
  if (excess(low) > 0) return {summed(dimension, grains, grain, low), low, -1};
  if (excess(high) < 0) return {summed(dimension, grains, grain, high), high, 1};
  for (int n = 0; n < 100; ++n) (excess(0.5 * (low + high)) < 0 ? low : high) = 0.5 * (low + high);
  return {kh / std::pow(low, dimension), low, 0};
}

struct Deviation {
  double rho = 0, h = 0;
  int capped = 0, floored = 0;
};

template <int D>
Deviation against_bisection(const Cloud<D>& cloud, const std::vector<Grain>& grains,
                            const swe::LengthBounds& bounds) {
  Deviation worst;
  const auto rho = cloud.by_id("depth"), h = cloud.by_id("h");
  for (size_t i = 0; i < grains.size(); ++i) {
    const Root root = bisect(D, grains, grains[i], bounds);
    worst.rho = std::max(worst.rho, std::abs(rho[i] / root.rho - 1));
    worst.h = std::max(worst.h, std::abs(h[i] / root.h - 1));
    worst.capped += root.bound > 0;
    worst.floored += root.bound < 0;
  }
  return worst;
}

std::vector<Grain> with_guess(std::vector<Grain> grains, double factor) {
  for (Grain& grain : grains) grain.rho = factor * grain.rho0;
  return grains;
}

template <int D>
void check_root(double factor, double margin, unsigned seed) {
  CAPTURE(D, factor, seed);
  const auto grains = with_guess(test::random_water(D, 250, dx, seed), factor);
  Cloud<D> cloud(grains, dx);
  auto options = test::tight(D);
  options.margin = margin;
  const auto report = cloud.solve(options);
  const Deviation worst = against_bisection(cloud, grains, options.bounds);
  // The pair loops take 1/r to 1e-12; q w'(q) is of the order of w, so that the sum is as good.
  CHECK(worst.rho < 1e-11);
  CHECK(worst.h < 1e-11);
  CHECK(report.capped == worst.capped);
  CHECK(report.floored == worst.floored);
  CHECK(report.outgrown == 0);
  CHECK(cloud.lists <= 20);  // what the solver allows
}

}  // namespace

TEST_CASE("density: the root of rho = sum m W(h(rho)) from guesses far off") {
  const double factor = GENERATE(0.2, 0.5, 0.9, 1.0, 1.25, 2.0, 5.0, 20.0);
  for (const unsigned seed : {1u, 2u, 3u}) {
    check_root<1>(factor, 4.0, seed);
    check_root<2>(factor, 4.0, seed);
  }
}

TEST_CASE("density: the same root where h outgrows the list and the list is made again") {
  const double factor = GENERATE(0.5, 0.9, 1.0, 1.25, 2.0, 20.0);
  check_root<1>(factor, 0.05, 1);
  check_root<2>(factor, 0.05, 1);
}

TEST_CASE("density: a good guess needs few evaluations, and at the default tolerance the root is as good") {
  const auto grains = test::still_water(2, test::lattice(2, {0, 20, 0, 20}, dx), dx, 0.7, 1.2);
  Cloud<2> cloud(with_guess(grains, 1.001), dx);
  auto options = test::tight(2);
  options.tolerance = 1e-5;
  cloud.solve(options);
  cloud.solve(options);  // starts from the root
  const auto report = cloud.solve(options);
  CHECK(report.newton_mean == 1);
  CHECK(against_bisection(cloud, grains, options.bounds).rho < 1e-5);  // the tolerance
}

TEST_CASE("density: isolated particles end at the cap with alpha 1, light ones at the floor") {
  auto grains = test::still_water(2, test::lattice(2, {0, 20, 0, 20}, dx), dx, 0.7, 1.2);
  grains.push_back({{-3, 0.1}, {0, 0}, 0.7 * dx * dx, 0.7, 1.2 * dx});       // alone
  grains.push_back({{1.03, 1.02}, {0, 0}, 1e-6 * dx * dx, 1e-6, 1.2 * dx});  // a light one among heavy ones
  Cloud<2> cloud(grains, dx);
  const auto options = test::tight(2);
  const auto report = cloud.solve(options);
  const double high = 3 * 1.2 * dx, low = options.bounds.floor * 1.2 * dx;
  CHECK(report.capped >= 1);
  CHECK(report.floored >= 1);
  CHECK(cloud.of(400, "h") == Approx(high).epsilon(1e-15));
  CHECK(cloud.of(400, "depth") ==
        Approx(0.7 * dx * dx * test::printed_w(2, 0) / (high * high)).epsilon(1e-12));
  CHECK(cloud.of(400, "pressure") == Approx(0.5 * g).epsilon(1e-15));  // g/(2 alpha)
  CHECK(cloud.of(400, "depth_rate") == 0);
  CHECK(cloud.of(401, "h") == Approx(low).epsilon(1e-15));
  CHECK(cloud.of(401, "depth") == Approx(summed(2, grains, grains[401], low)).epsilon(1e-11));
  CHECK(cloud.of(401, "pressure") == Approx(0.5 * g).epsilon(1e-15));
}

namespace {

// d psi/d rho of psi = rho - sum m W(h(rho)) by central differences: at the root it is alpha (2.9).
template <int D>
void check_alpha() {
  CAPTURE(D);
  const auto grains = test::random_water(D, 250, dx, 7);
  Cloud<D> cloud(grains, dx);
  cloud.solve(test::tight(D));
  const auto rho = cloud.by_id("depth"), pressure = cloud.by_id("pressure");
  double worst = 0;
  for (size_t i = 0; i < grains.size(); ++i) {
    const double kh = grains[i].rho0 * std::pow(grains[i].h0, D);
    const auto psi = [&](double r) { return r - summed(D, grains, grains[i], std::pow(kh / r, 1.0 / D)); };
    const double s = 1e-5 * rho[i], difference = (psi(rho[i] + s) - psi(rho[i] - s)) / (2 * s);
    const bool bounded = bisect(D, grains, grains[i], test::tight(D).bounds).bound != 0;
    worst = std::max(worst, std::abs(0.5 * g / pressure[i] - (bounded ? 1.0 : difference)));
  }
  // Truncation s^2 times a third derivative of order one, where the spline's third derivative jumps s times
  // one; rounding 1e-16 / 1e-5.
  CHECK(worst < 1e-9);
}

template <int D>
std::vector<double> roots_after(std::vector<Grain> grains, double time) {
  for (Grain& grain : grains)
    for (size_t k = 0; k < 2; ++k) grain.x[k] += time * grain.v[k];
  Cloud<D> cloud(grains, dx);
  cloud.solve(test::tight(D));
  return cloud.by_id("depth");
}

// d rho/dt, docs/formulas/swe.md (S12), against the roots a moment later and earlier, along a random motion
// of all particles.
template <int D>
void check_rate() {
  CAPTURE(D);
  const auto grains = test::random_water(D, 250, dx, 8);
  Cloud<D> cloud(grains, dx);
  cloud.settle(test::tight(D));
  constexpr double s = 1e-6;  // s; velocities are of order 1 m/s: 1e-5 dx
  const auto later = roots_after<D>(grains, s), earlier = roots_after<D>(grains, -s);
  const auto rate = cloud.by_id("depth_rate");
  double worst = 0;
  for (size_t i = 0; i < grains.size(); ++i)
    worst = std::max(worst, std::abs(rate[i] - (later[i] - earlier[i]) / (2 * s)));
  // The roots are good to 1e-13 of a depth of order 1 m: 1e-13 / 1e-6 = 1e-7 m/s against rates of 10 m/s.
  CHECK(worst < 1e-6 * test::largest_size(rate));
  CHECK(test::largest_size(rate) > 1);
}

}  // namespace

TEST_CASE("density: alpha is the derivative of the residual") {
  check_alpha<1>();
  check_alpha<2>();
}

TEST_CASE("density: the rate is the root's derivative along the motion") {
  check_rate<1>();
  check_rate<2>();
}

TEST_CASE("density: growth extrapolates the rate to the middle of the next step") {
  const auto grains = test::random_water(2, 100, dx, 12);
  Cloud<2> cloud(grains, dx);
  cloud.settle(test::tight(2));
  const auto earlier = cloud.by_id("depth_rate");
  const swe::Particles<2> p = cloud.bind();
  for (int i = 0; i < cloud.fields.size(); ++i)
    p.rate(i) *= 0.5;  // as if it had been half as large a step ago
  auto options = test::tight(2);
  options.ahead = 0.5;
  swe::solve_density<2>(cloud.kernel, cloud.clusters, cloud.neighbours.view(), cloud.wall_view(), p, {},
                        options);
  const auto rate = cloud.by_id("depth_rate"), growth = cloud.by_id("depth_growth");
  for (size_t i = 0; i < grains.size(); ++i) {
    CHECK(rate[i] == Approx(earlier[i]).epsilon(1e-9));  // the root again
    CHECK(growth[i] == Approx(1.25 * rate[i]).epsilon(1e-9));
  }
}

TEST_CASE(
    "density: a linear velocity field has its exact strain, also at the edge and among unequal particles") {
  auto grains = test::random_water(2, 400, dx, 9);
  for (Grain& grain : grains)
    grain.v = {3 + 0.5 * grain.x[0] - 2.0 * grain.x[1], -1 + 0.7 * grain.x[0] + 1.5 * grain.x[1]};
  Cloud<2> cloud(grains, dx);
  cloud.solve(test::tight(2));
  const auto xx = cloud.by_id("strain_xx"), xy = cloud.by_id("strain_xy"), yy = cloud.by_id("strain_yy");
  int exact = 0, none = 0;
  for (size_t i = 0; i < grains.size(); ++i) {
    // Velocities of 10 m/s round by 1e-15 m/s, distances are 0.01 m and more, 1/r is known to 1e-12 on both
    // sides.
    exact += std::abs(xx[i] - 0.5) < 1e-9 && std::abs(xy[i] + 0.65) < 1e-9 && std::abs(yy[i] - 1.5) < 1e-9;
    none += xx[i] == 0 && xy[i] == 0 && yy[i] == 0;
  }
  CHECK(exact + none == 400);
  CHECK(none < 20);  // neighbours nearly on one line
}

TEST_CASE("density: the strain in one dimension, and none where the neighbours lie on a line") {
  auto grains = test::random_water(1, 100, dx, 10);
  for (Grain& grain : grains) grain.v = {2 - 0.8 * grain.x[0], 0};
  Cloud<1> line(grains, dx);
  line.settle(test::tight(1));  // with the first guess of h some have no neighbour
  for (const double s : line.by_id("strain_xx")) CHECK(s == Approx(-0.8).epsilon(1e-9));

  auto row = test::still_water(2, test::lattice(2, {0, 50, 0, 1}, dx), dx, 0.7, 1.2);
  for (Grain& grain : row) grain.v = {grain.x[0], grain.x[0]};
  Cloud<2> plane(row, dx);
  plane.solve(test::tight(2));
  for (const char* name : {"strain_xx", "strain_xy", "strain_yy"})
    CHECK(test::largest_size(plane.by_id(name)) == 0);
}

namespace {

template <int D>
void check_shuffled() {
  CAPTURE(D);
  const auto grains = test::random_water(D, 300, dx, 11);
  const auto ids = test::shuffled(test::numbers(300), 5);
  std::vector<Grain> moved;
  for (const int id : ids) moved.push_back(grains[static_cast<size_t>(id)]);
  Cloud<D> straight(grains, dx), other(moved, dx);
  for (int i = 0; i < 300; ++i) other.fields.integer("id")(i) = ids[static_cast<size_t>(i)];
  straight.settle(test::tight(D));
  other.settle(test::tight(D));
  for (const char* name : {"depth", "h", "depth_rate", "pressure", "strain_xx"}) {
    CAPTURE(name);
    CHECK((straight.by_id(name) == other.by_id(name)));  // to the bit: the order is by place and id
  }
}

}  // namespace

TEST_CASE("density: does not depend on the order of the input") {
  check_shuffled<1>();
  check_shuffled<2>();
}

TEST_CASE("density: the lattice's bias") {
  // docs/formulas/swe.md (S6), half a unit of the last digit. The digits are of sums at fixed h; h following
  // the density changes them by the bias squared.
  CHECK(swe::lattice_sums<1>(1.0).density == Approx(1).epsilon(1e-12));
  CHECK(swe::lattice_sums<1>(1.0).alpha == Approx(1).epsilon(1e-12));
  CHECK(swe::lattice_sums<1>(1.2).density - 1 == Approx(1.8e-3).margin(0.5e-4));
  CHECK(swe::lattice_sums<1>(1.2).alpha == Approx(1.0204).margin(5e-4));
  CHECK(swe::lattice_sums<2>(1.2).density - 1 == Approx(-2.4e-4).margin(0.05e-4));
  CHECK(swe::lattice_sums<2>(1.0).density - 1 == Approx(8.6e-4).margin(0.5e-4));
  const auto grains = test::still_water(2, test::lattice(2, {0, 20, 0, 20}, dx), dx, 0.7, 1.2);
  Cloud<2> cloud(grains, dx);
  cloud.solve(test::tight(2));
  CHECK(swe::lattice_sums<2>(1.2).density == Approx(cloud.of(10 * 20 + 10, "depth") / 0.7).epsilon(1e-11));
  CHECK(swe::lattice_sums<2>(1.2).alpha ==
        Approx(0.5 * g / cloud.of(10 * 20 + 10, "pressure")).epsilon(1e-11));
}
