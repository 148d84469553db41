// The exterior states of open boundaries against the characteristic relations, docs/formulas/swe.md (S36) to
// (S40).
#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include "kernels/boundaries/open/states.hpp"

using namespace freshet;

namespace {

constexpr double g = 9.81;                 // m/s2
const OpenStrip flat{g, 0, 1, 0.5};        // bed 0, still water 1 m deep, half a share
const OpenStrip raised{g, 0.4, 0.6, 0.5};  // the same over a bed at 0.4 m

double c(double depth) { return std::sqrt(g * depth); }
double froude(const ExteriorState& s) { return s.inward / c(s.depth); }
// What leaves the domain is kept: R = -u + 2 c.
double leaving(double depth, double inward) { return 2 * c(depth) - inward; }
double leaving(const ExteriorState& s) { return leaving(s.depth, s.inward); }

std::vector<double> shares(const std::vector<Portion>& rows, bool by_width) {
  const auto portion = [&](int r) { return rows[static_cast<std::size_t>(r)]; };
  const DischargeShares by(static_cast<int>(rows.size()), portion, by_width);
  std::vector<double> all;
  for (const Portion& row : rows) all.push_back(by.of(row));
  return all;
}

}  // namespace

TEST_CASE("an imposed level keeps the invariant that leaves") {
  for (const double level : {0.9, 1.0, 1.098}) {
    const InnerState inner{1 - 0.4, 0.2};
    const ExteriorState s = ImposedLevel{level}(inner, raised);
    CHECK(s.depth == Approx(level - 0.4));
    CHECK(s.inward == Approx(0.2 + 2 * (c(level - 0.4) - c(0.6))));  // (4.2)
  }
}

TEST_CASE("an imposed level below the critical one is a free fall") {
  const InnerState inner{1, -0.5};
  for (const double level : {-1.0, 0.0, 0.1}) {
    const ExteriorState s = ImposedLevel{level}(inner, flat);
    CHECK(froude(s) == Approx(-1));
    CHECK(leaving(s) == Approx(leaving(1, -0.5)));
  }
}

TEST_CASE("an imposed velocity raises the level as a bore does") {
  const ExteriorState s = ImposedVelocity{0.3}({1, 0}, flat);
  CHECK(s.inward == 0.3);
  CHECK(s.depth == Approx(1.0981).margin(5e-5));  // docs/formulas/swe.md (S38); the exact bore: 1.0980
  CHECK(leaving(s) == Approx(leaving(1, 0)));
  const ExteriorState out = ImposedVelocity{-0.3}({1, 0}, flat);
  CHECK(out.inward == -0.3);
  CHECK(out.depth < 1);
  CHECK(leaving(out) == Approx(leaving(1, 0)));
}

TEST_CASE("an imposed velocity beyond the critical one comes with its critical depth") {
  CHECK(froude(ImposedVelocity{2.0}({}, flat)) == Approx(1));
  CHECK(froude(ImposedVelocity{4.0}({0.01, 1}, flat)) == Approx(1));
  const ExteriorState out = ImposedVelocity{-4.0}({1, 0}, flat);
  CHECK(froude(out) == Approx(-1));
  CHECK(leaving(out) == Approx(leaving(1, 0)));
}

TEST_CASE("no velocity and no discharge are walls, before dry land and before a bore") {
  for (const double inward : {0.3, 0.0, -0.5, -6.0})
    for (const ExteriorState& s :
         {ImposedVelocity{0}({1, inward}, flat), ImposedDischarge{0, false}({1, inward}, flat)}) {
      CHECK(s.closed);
      CHECK(s.inward == 0);
      CHECK(leaving(s) == Approx(leaving(1, inward)));
    }
  CHECK(ImposedDischarge{0, false}({}, flat).depth == 0);
}

TEST_CASE("an imposed discharge enters whole and keeps the invariant") {
  for (const double total : {1e-6, 0.2, 1.0, 3.0}) {
    const ExteriorState s = ImposedDischarge{total, false}({1, 0.1}, flat);
    CHECK(s.depth * s.inward == Approx(0.5 * total));  // half a share per metre
    CHECK(leaving(s) == Approx(leaving(1, 0.1)));
    CHECK(froude(s) < 1);
  }
}

TEST_CASE("an imposed discharge is critical on dry land and before supercritical water") {
  for (const InnerState inner : {InnerState{}, InnerState{0.1, 4}, InnerState{1e-4, 0.5}}) {
    const ExteriorState s = ImposedDischarge{2, false}(inner, flat);
    CHECK(s.depth * s.inward == Approx(1));
    CHECK(froude(s) == Approx(1));
  }
}

TEST_CASE("a withdrawal takes what is asked, at most what critical flow carries") {
  const ExteriorState s = ImposedDischarge{-1, false}({1, 0}, flat);
  CHECK(s.depth * s.inward == Approx(-0.5));
  CHECK(leaving(s) == Approx(leaving(1, 0)));
  CHECK(-froude(s) < 1);
  const ExteriorState most = ImposedDischarge{-10, false}({1, 0}, flat);  // critical: (2/3)^3 c d = 0.93 m2/s
  CHECK(froude(most) == Approx(-1));
  CHECK(leaving(most) == Approx(leaving(1, 0)));
  CHECK(ImposedDischarge{-1, false}({}, flat).closed);
}

TEST_CASE("what leaves supercritically is copied by every kind that does not push inwards") {
  const InnerState inner{0.2, -3};
  for (const OpenLaw law :
       {OpenLaw{ImposedLevel{1}}, OpenLaw{IncomingWave{1}}, OpenLaw{ImposedVelocity{-0.1}},
        OpenLaw{ImposedDischarge{-1, true}}, OpenLaw{ImposedState{1, false, 0.1}}, OpenLaw{Transmissive{}}}) {
    const ExteriorState s = exterior_state(law, inner, flat);
    CAPTURE(law.index());
    CHECK(s.depth == 0.2);
    CHECK(s.inward == -3);
  }
}

TEST_CASE("an imposed state that the water inside has already changes nothing") {
  for (const double u : {-1.0, 0.0, 0.5, 5.0}) {
    const ExteriorState s = ImposedState{0.6, true, u}({0.6, u}, raised);
    CHECK(s.depth == Approx(0.6));
    CHECK(s.inward == Approx(u).margin(1e-14));
    CHECK(ImposedState{1.0, false, u}({0.6, u}, raised).depth == Approx(0.6));  // the same, as a level
  }
}

TEST_CASE("an imposed supercritical state enters whole, still water outside pours critically on dry land") {
  const ExteriorState fast = ImposedState{0.1, true, 4}({0.3, 1}, flat);
  CHECK(fast.depth == Approx(0.1));
  CHECK(fast.inward == 4);
  // Ritter: depth 4/9, Froude number 1 at the dam
  const ExteriorState dam = ImposedState{1, true, 0}({}, flat);
  CHECK(dam.depth == Approx(4.0 / 9));
  CHECK(froude(dam) == Approx(1));
}

TEST_CASE("waves enter by their invariant and leave by theirs") {
  const ExteriorState calm = IncomingWave{1}({0.6, 0}, raised);
  CHECK(calm.depth == Approx(0.6));
  CHECK(calm.inward == Approx(0).margin(1e-15));
  const double outgoing = -2 * (c(0.7) - c(0.6));  // a simple wave that leaves: u + 2 c as in still water
  const ExteriorState wave = IncomingWave{1}({0.7, outgoing}, raised);
  CHECK(wave.depth == Approx(0.7));
  CHECK(wave.inward == Approx(outgoing));
  // transmissive with a level
  const ExteriorState against = ImposedState{1, false, 0}({0.7, outgoing}, raised);
  CHECK(against.depth == Approx(0.7));
  CHECK(against.inward == Approx(outgoing));
}

TEST_CASE("no kind that imposes one value makes supercritical inflow or a negative depth") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> depth(0, 2), speed(-8, 8), value(-3, 3);
  for (int n = 0; n < 2000; ++n) {
    const InnerState inner{depth(random), speed(random)};
    const double imposed = value(random);
    for (const OpenLaw law :
         {OpenLaw{ImposedLevel{imposed}}, OpenLaw{IncomingWave{imposed}}, OpenLaw{ImposedVelocity{imposed}},
          OpenLaw{ImposedDischarge{imposed, true}}, OpenLaw{ImposedState{imposed, false, 0}}}) {
      const ExteriorState s = exterior_state(law, inner, flat);
      CAPTURE(law.index(), inner.depth, inner.inward, imposed);
      REQUIRE(s.depth >= 0);
      REQUIRE(s.inward <= c(s.depth) * (1 + 1e-12));
    }
  }
}

TEST_CASE("a discharge is shared by conveyance under the mean level, or by width") {
  const std::vector<Portion> rows{{1.0, 0.0, 2, true}, {1.2, 0.6, 1, true}, {9.0, 2.0, 1, false}};
  const double level = (2 * 1.0 + 1 * 1.2) / 3, first = std::pow(level, 5.0 / 3),
               second = std::pow(level - 0.6, 5.0 / 3);
  const std::vector<double> share = shares(rows, false);
  CHECK(2 * share[0] + share[1] + share[2] == Approx(1));
  CHECK(share[0] / share[1] == Approx(first / second));
  CHECK(share[2] == 0);  // its bed stands above the water
  for (const double s : shares(rows, true)) CHECK(s == Approx(0.25));
  for (const double s : shares({{0, 0, 3, false}, {0, 1, 1, false}}, false)) CHECK(s == Approx(0.25));  // dry
}
