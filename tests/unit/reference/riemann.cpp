// Exact solutions against the shallow-water equations themselves, by central differences.
#include "src/reference/eddy.hpp"
#include "src/reference/exact.hpp"
#include "src/reference/ritter.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <vector>

using namespace freshet;

namespace {

constexpr double g = 9.81;

struct Residual {
  double mass, momentum_x, momentum_y;  // each relative to the largest of its terms
};

// Where every term vanishes by symmetry, 1e-4 m/s (m/s2) stands for them: terms elsewhere are a hundred times
// larger.
double relative(std::initializer_list<double> terms) {
  double sum = 0, largest = 1e-4;
  for (const double term : terms) {
    sum += term;
    largest = std::max(largest, std::abs(term));
  }
  return std::abs(sum) / largest;
}

// d_t + (d u)_x + (d v)_y and u_t + u u_x + v u_y + g (d + b)_x (the same for v), step `s` in space, `tau` in
// time.
Residual residual(const Exact& exact, const std::function<double(double, double)>& bed,
                  const std::array<double, 3>& at, double s, double tau) {
  const auto [x, y, t] = at;
  using Quantity = std::function<double(double, double, double)>;
  const auto depth = [&](double a, double b, double c) { return exact.at(a, b, c).depth; };
  const auto u = [&](double a, double b, double c) { return exact.at(a, b, c).u; };
  const auto v = [&](double a, double b, double c) { return exact.at(a, b, c).v; };
  const auto dx = [&, x = x, y = y, t = t](const Quantity& q) {
    return (q(x + s, y, t) - q(x - s, y, t)) / (2 * s);
  };
  const auto dy = [&, x = x, y = y, t = t](const Quantity& q) {
    return (q(x, y + s, t) - q(x, y - s, t)) / (2 * s);
  };
  const auto dt = [&, x = x, y = y, t = t](const Quantity& q) {
    return (q(x, y, t + tau) - q(x, y, t - tau)) / (2 * tau);
  };
  const Quantity flux_x = [&](double a, double b, double c) { return depth(a, b, c) * u(a, b, c); };
  const Quantity flux_y = [&](double a, double b, double c) { return depth(a, b, c) * v(a, b, c); };
  const Quantity surface = [&](double a, double b, double c) { return depth(a, b, c) + bed(a, b); };
  const FlowState here = exact.at(x, y, t);
  return {relative({dt(depth), dx(flux_x), dy(flux_y)}),
          relative({dt(u), here.u * dx(u), here.v * dy(u), g * dx(surface)}),
          relative({dt(v), here.u * dx(v), here.v * dy(v), g * dy(surface)})};
}

double flat(double, double) { return 0; }
double bowl(double x, double y) { return 10 * ((x * x + y * y) / 9e6 - 1); }

}  // namespace

TEST_CASE("Stoker: middle state and shock of the 10 m | 5 m dam") {
  const StokerMiddle middle = stoker_middle(10, 5, g);
  // The reference values are given to four decimals.
  CHECK(middle.depth == Approx(7.2692).margin(5e-5));
  CHECK(middle.u == Approx(2.9199).margin(5e-5));
  CHECK(middle.shock == Approx(9.3538).margin(5e-5));
}

TEST_CASE("Stoker: mass and momentum are conserved across the shock") {
  for (const double right : {0.01, 1.0, 5.0, 9.9}) {
    const StokerMiddle m = stoker_middle(10, right, g);
    // Rankine-Hugoniot; the bisection ends at the last bits of the depth, hence 1e-9.
    CHECK(m.depth * (m.u - m.shock) == Approx(-right * m.shock).epsilon(1e-9));
    CHECK(m.depth * m.u * (m.u - m.shock) + 0.5 * g * m.depth * m.depth ==
          Approx(0.5 * g * right * right).epsilon(1e-9));
    CHECK(m.u + 2 * std::sqrt(g * m.depth) == Approx(2 * std::sqrt(g * 10)).epsilon(1e-9));
  }
}

TEST_CASE("Stoker: the rarefaction satisfies the equations, the states around it are constant") {
  const auto exact = stoker(10, 5, 1000, g);
  for (const double x : {600.0, 700.0, 750.0}) {
    // Central differences of a profile that is quadratic in x/t: truncation (0.1 m / 300 m)^2 of its terms.
    const Residual r = residual(*exact, flat, {x, 0, 50}, 0.1, 0.001);
    CHECK(r.mass < 1e-6);
    CHECK(r.momentum_x < 1e-6);
  }
  CHECK(exact->at(100, 0, 50).depth == 10);
  CHECK(exact->at(1300, 0, 50).depth == Approx(7.2692).margin(5e-5));
  CHECK(exact->at(1000 + 9.3538 * 50 - 0.1, 0, 50).depth == Approx(7.2692).margin(5e-5));
  CHECK(exact->at(1000 + 9.3538 * 50 + 0.1, 0, 50).depth == 5);
  CHECK(exact->at(999, 0, 0).depth == 10);
  CHECK(exact->at(1001, 0, 0).depth == 5);
  CHECK(exact->period() == 0);
}

TEST_CASE("Stoker: the flow is continuous where rarefaction and constant states meet") {
  const auto exact = stoker(10, 5, 1000, g);
  const StokerMiddle m = stoker_middle(10, 5, g);
  for (const double speed : {-std::sqrt(g * 10), m.u - std::sqrt(g * m.depth)}) {
    const FlowState a = exact->at(1000 + 50 * speed - 1e-6, 0, 50),
                    b = exact->at(1000 + 50 * speed + 1e-6, 0, 50);
    CHECK(a.depth ==
          Approx(b.depth).epsilon(1e-7));  // slope 1/40 times the 2e-6 m between the points, and room
    CHECK(a.u == Approx(b.u).margin(1e-6));
  }
}

TEST_CASE("Thacker's planar and radial motions satisfy the equations wherever it is wet") {
  const Bowl shape{10, 3000, 0, 0};
  const auto planar = thacker_planar(shape, 1500, g);
  const auto radial = thacker_radial(shape, 0.5, g);
  int wet = 0;
  for (const Exact* exact : {planar.get(), radial.get()}) {
    for (const double t : {0.0, 100.0, 333.0, 555.0, 1000.0}) {
      for (const std::array<double, 2>& p : std::vector<std::array<double, 2>>{
               {100, 50}, {-900, 400}, {700, 1200}, {-300, -1900}, {1800, 100}, {0.5, 0.25}}) {
        if (exact->at(p[0], p[1], t).depth < 0.5) continue;
        ++wet;
        // Fields are quadratic in x and smooth in t with w = 0.0047 and 0.0093 1/s: the time step of 0.05 s
        // truncates at (w tau)^2 = 2e-7, differences of fluxes (cubic in x) at (s/L)^2 = 1e-8, and rounding
        // adds 1e-8.
        const Residual r = residual(*exact, bowl, {p[0], p[1], t}, 0.5, 0.05);
        CHECK(r.mass < 2e-6);
        CHECK(r.momentum_x < 2e-6);
        CHECK(r.momentum_y < 2e-6);
      }
    }
  }
  CHECK(wet > 30);
}

TEST_CASE("A steady eddy satisfies the equations and turns fastest at its radius") {
  const auto exact = eddy({1, 1.5, 2, 10, -3}, g);  // Froude number 0.5
  for (const std::array<double, 2>& p :
       std::vector<std::array<double, 2>>{{11, -3}, {10.5, -2}, {8.5, -4.5}, {12, -3.1}}) {
    // truncates at (s / radius)^2 = 2.5e-7
    const Residual r = residual(*exact, flat, {p[0], p[1], 0}, 1e-3, 0.1);
    CHECK(r.mass < 2e-6);
    CHECK(r.momentum_x < 2e-6);
    CHECK(r.momentum_y < 2e-6);
  }
  CHECK(exact->at(12, -3, 0).v == Approx(1.5));
  CHECK(exact->at(12, -3, 0).u == 0);
  CHECK(exact->at(12.1, -3, 0).v < 1.5);
  CHECK(exact->at(11.9, -3, 0).v < 1.5);
  CHECK(exact->at(10, -3, 7).depth == Approx(1 - 1.5 * 1.5 / (2 * g) * std::exp(1.0)));
}

TEST_CASE("Thacker's motions return after a period, and their bowl may lie elsewhere") {
  const auto centred = thacker_planar({10, 3000, 0, 0}, 1500, g),
             moved = thacker_planar({10, 3000, 700, -200}, 1500, g);
  CHECK(centred->period() == Approx(1345.710).epsilon(1e-6));
  CHECK(centred->at(1000, 300, 40 + centred->period()).depth == Approx(centred->at(1000, 300, 40).depth));
  CHECK(moved->at(1700, 100, 40).depth == Approx(centred->at(1000, 300, 40).depth));
  const auto radial = thacker_radial({10, 3000, 0, 0}, 0.5, g);
  CHECK(radial->period() == Approx(centred->period() / 2));
  CHECK(radial->at(500, 0, 10 + radial->period()).u == Approx(radial->at(500, 0, 10).u));
  CHECK(centred->at(4900, 0, 0).depth == 0);
}

TEST_CASE("Radial Thacker keeps its volume") {
  const auto exact = thacker_radial({10, 3000, 0, 0}, 0.5, g);
  const auto volume = [&](double t) {
    double sum = 0;
    for (int k = 0; k < 5000; ++k) sum += exact->at(k + 0.5, 0, t).depth * (k + 0.5);
    return sum;
  };
  // Midpoint rule with 1 m rings over a paraboloid that ends in a slope of 0.01: relative error about 1e-7.
  CHECK(volume(200) == Approx(volume(0)).epsilon(1e-6));
}

TEST_CASE("Still water lies level over its bed") {
  const auto exact = still_water(0.5, [](double x, double) { return x; });
  CHECK(exact->at(0.2, 0, 7).depth == Approx(0.3));
  CHECK(exact->at(0.2, 0, 7).u == 0);
  CHECK(exact->at(0.8, 0, 7).depth == 0);
  CHECK(still_water(0.5, {})->at(3, 3, 0).depth == 0.5);
}

TEST_CASE("Ritter: mass is conserved, the equations hold, the tip is dry") {
  const auto exact = ritter(10, 100, 9.81);
  const double t = 7, c = std::sqrt(98.1);
  double mass = 0;
  for (int k = 0; k < 40000; ++k) mass += 0.01 * exact->at((k + 0.5) * 0.01, 0, t).depth;
  CHECK(mass == Approx(1000).epsilon(1e-6));
  CHECK(exact->at(100, 0, t).depth == Approx(4.0 / 9 * 10));
  CHECK(exact->at(100, 0, t).u == Approx(2.0 / 3 * c));
  CHECK(exact->at(100 + 2.01 * c * t, 0, t).depth == 0);
  CHECK(exact->at(99 - c * t, 0, t).depth == 10);
  CHECK(exact->at(99, 0, 0).depth == 10);
  CHECK(exact->at(101, 0, 0).depth == 0);
  const double x = 130, e = 1e-4;
  const auto at = [&](double dx, double dt) { return exact->at(x + dx, 0, t + dt); };
  const double d_t = (at(0, e).depth - at(0, -e).depth) / (2 * e), u_t = (at(0, e).u - at(0, -e).u) / (2 * e);
  const auto flux = [&](double dx) { return at(dx, 0).depth * at(dx, 0).u; };
  CHECK(d_t + (flux(e) - flux(-e)) / (2 * e) == Approx(0).margin(1e-6));
  const double slope = (at(e, 0).depth - at(-e, 0).depth) / (2 * e),
               shear = (at(e, 0).u - at(-e, 0).u) / (2 * e);
  CHECK(u_t + at(0, 0).u * shear + 9.81 * slope == Approx(0).margin(1e-6));
}
