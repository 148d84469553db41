// The exact steady flow over a bump: energy, momentum across the jump, the numbers known from the literature.
#include <catch2/catch.hpp>

#include <cmath>

#include "src/reference/bump.hpp"

using namespace freshet;

namespace {

constexpr double g = 9.81;   // m/s2
const Bump bump{0.2, 5, 2};  // thesis (4.6)

double head(const FlowState& s, double x) { return s.depth + s.u * s.u / (2 * g) + bump.level(x); }
double momentum(double depth, double q) { return q * q / (g * depth) + 0.5 * depth * depth; }
double froude(const FlowState& s) { return s.u / std::sqrt(g * s.depth); }

}  // namespace

TEST_CASE("bump: transcritical flow keeps discharge and energy and is critical on the crest") {
  const SteadyBumpFlow exact(bump, {0.435, {}, {}}, g);
  CHECK(exact.discharge() ==
        Approx(0.18).epsilon(1e-3));  // what 0.435 m/s stand for (Goutal and Maurel 1997)
  CHECK(exact.at(0, 0, 0).u == Approx(0.435));
  CHECK_FALSE(exact.jump());
  for (double x = 0; x < 10; x += 0.37) {
    const FlowState s = exact.at(x, 0, 0);
    CHECK(s.depth * s.u == Approx(exact.discharge()));
    CHECK(head(s, x) == Approx(head(exact.at(0, 0, 0), 0)));
    CHECK((froude(s) > 1) == (x > 5));
  }
  CHECK(froude(exact.at(5, 0, 0)) == Approx(1).margin(1e-5));  // the square root of the rounding there
}

TEST_CASE("bump: the jump keeps the momentum and reaches the depth at the end") {
  const SteadyBumpFlow exact(bump, {0.435, {}, 0.33}, g);
  REQUIRE(exact.jump());
  CHECK(*exact.jump() > 6);
  CHECK(*exact.jump() < 7);
  CHECK(momentum(exact.depth_before(), exact.discharge()) ==
        Approx(momentum(exact.depth_behind(), exact.discharge())));
  CHECK(exact.depth_before() < exact.depth_behind());
  CHECK(exact.at(10, 0, 0).depth == Approx(0.33));
  CHECK(head(exact.at(10, 0, 0), 10) < head(exact.at(0, 0, 0), 0));  // a jump loses energy
  CHECK(exact.at(*exact.jump() - 1e-9, 0, 0).depth == Approx(exact.depth_before()));
  CHECK(exact.at(*exact.jump() + 1e-9, 0, 0).depth == Approx(exact.depth_behind()));
}

TEST_CASE("bump: an end too shallow or too deep for a jump on the bump has none") {
  CHECK_FALSE(SteadyBumpFlow(bump, {0.435, {}, 0.1}, g).jump());
  CHECK_FALSE(SteadyBumpFlow(bump, {0.435, {}, 0.6}, g).jump());
}

TEST_CASE("bump: supercritical flow is deepest on the crest") {
  const SteadyBumpFlow exact(bump, {4, 0.1, {}}, g);
  CHECK(exact.discharge() == Approx(0.4));
  CHECK(exact.at(0, 0, 0).depth == Approx(0.1));
  CHECK(exact.at(5, 0, 0).depth > 0.1);
  for (double x = 0; x < 10; x += 0.37) {
    CHECK(head(exact.at(x, 0, 0), x) == Approx(head(exact.at(0, 0, 0), 0)));
    CHECK(froude(exact.at(x, 0, 0)) > 1);
  }
}
