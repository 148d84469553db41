// Area that geometry changes is given back slowly, and said.
#include <catch2/catch.hpp>

#include <cmath>

#include "src/methods/fpm/area_keeper.hpp"

using freshet::fpm::AreaKeeper;

namespace {

constexpr double dt = 0.01;  // s

// The area after some steps in which the divergence does what is asked of it.
double after(AreaKeeper& keeper, double area, int steps) {
  for (int k = 0; k < steps; ++k) {
    if (keeper.is_due()) keeper.look(area, dt);
    area *= 1 + keeper.expansion() * dt;
    keeper.pass(dt);
  }
  return area;
}

}  // namespace

TEST_CASE("fpm area: what is within the band is left alone") {
  AreaKeeper keeper;
  keeper.start(2);
  for (const double area : {2.0, 2 * 1.0049, 2 * 0.9951}) CHECK(after(keeper, area, 30) == area);
  CHECK(keeper.notes().empty());
}

TEST_CASE("fpm area: too much or too little water comes back to the band in some fifty steps") {
  for (const double sign : {1.0, -1.0}) {
    AreaKeeper keeper;
    keeper.start(2);
    const double off = 0.04;
    const double left = after(keeper, 2 * (1 + sign * off), 50) / 2 - 1;
    // A look every ten steps takes 0.4 of what is beyond the band: 0.6^5 of it is left; divergence acts on
    // the area at hand (4 %).
    CHECK(sign * left ==
          Approx(AreaKeeper::band + std::pow(0.6, 5) * (off - AreaKeeper::band)).epsilon(0.05));
    REQUIRE(keeper.notes().size() == 1);
    CHECK(keeper.notes()[0].find("first at t = 0 s") != std::string::npos);
    CHECK(keeper.notes()[0].find(sign > 0 ? " 0 % put on" : "0 % of its area was taken off") !=
          std::string::npos);
  }
}

TEST_CASE("fpm area: a keeper goes on from its state") {
  AreaKeeper straight, first, second;
  straight.start(2), first.start(2);
  double a = after(straight, 2.1, 37), b = after(first, 2.1, 12);
  second.restore(first.state());
  b = after(second, b, 25);
  CHECK(a == b);
  CHECK(straight.state() == second.state());
}
