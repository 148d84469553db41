// The radial finite-volume reference: against an exact solution, itself, conservation and two published
// curves.
#include "src/reference/radial.hpp"

#include <catch2/catch.hpp>

#include <cmath>

#include "tests/support/run/data.hpp"

using namespace freshet;

namespace {

constexpr double g = 9.81;

// Mean of |d - exact| over that of the exact depth, per area.
template <class Depth>
double l1(const RadialProfile& p, const Depth& exact) {
  double difference = 0, sum = 0;
  for (std::size_t k = 0; k < p.depth.size(); ++k) {
    const double r = (static_cast<double>(k) + 0.5) * p.ring, d = exact(r);
    difference += std::abs(p.depth[k] - d) * r;
    sum += d * r;
  }
  return difference / sum;
}

double volume(const RadialProfile& p) {
  double sum = 0;
  for (std::size_t k = 0; k < p.depth.size(); ++k) sum += p.depth[k] * (static_cast<double>(k) + 0.5);
  return sum;
}

// A paraboloid of water spreads over a dry plane as d = d0/s (1 - r^2/(s L^2)), u = r s'/(2 s), s = 1 + 2 g
// d0 t^2/L^2: put into the equations it satisfies them exactly, dry front included.
double spreading_error(int rings) {
  const double length = 1000, d0 = 10, t = 100, s = 1 + 2 * g * d0 * t * t / (length * length);
  const auto exact = [=](double r, double stretch) {
    return std::max(0.0, d0 / stretch * (1 - r * r / (stretch * length * length)));
  };
  const auto flow =
      radial_flow([&](double r) { return exact(r, 1); }, 1.1 * length * std::sqrt(s), t, rings, g);
  return l1(flow, [&](double r) { return exact(r, s); });
}

double distance(const RadialDam& dam, double t, int coarse, int fine) {
  const RadialProfile reference = radial_dam_profile(dam, t, g, fine);
  return l1(radial_dam_profile(dam, t, g, coarse), [&](double r) { return reference.at(r, 0).depth; });
}

}  // namespace

TEST_CASE("radial reference: a spreading paraboloid is met with nearly second order") {
  const double coarse = spreading_error(200), fine = spreading_error(1600);
  CHECK(std::log2(coarse / fine) / 3 >=
        1.5);  // the limiter at the crest and the dry front take the rest of 2
  CHECK(fine <= 2e-5);
}

TEST_CASE("radial reference: the default's error is a hundredth of what it is used to measure") {
  // Shock and dry front are of first order; halving from 1000 to 4000 rings must show it.
  const RadialDam wet{10, 5, 100}, dry{10, 0, 1000};
  for (const RadialDam& dam : {wet, dry}) {
    CAPTURE(dam.outer);
    const double coarse = distance(dam, 50, 1000, 2000), fine = distance(dam, 50, 2000, 4000);
    CHECK(coarse / fine >= 1.6);
    CHECK(fine <= 1e-3);  // what is left at 4000 rings is about as much again; particles are some 1e-2 away
  }
}

TEST_CASE("radial reference: no water is lost and still water stays still") {
  const auto dam = [](double r) { return r < 500 ? 10.0 : 0.0; };
  const double before = volume(radial_flow(dam, 2000, 0, 1000, g)),
               after = volume(radial_flow(dam, 2000, 50, 1000, g));
  CHECK(after == Approx(before).epsilon(1e-12));  // rounding of 2000 steps: no depth was ever clipped at zero
  const RadialProfile still = radial_flow([](double) { return 3.0; }, 100, 20, 200, g);
  for (std::size_t k = 0; k < still.depth.size(); ++k) {
    CHECK(still.depth[k] == Approx(3).epsilon(1e-12));
    CHECK(std::abs(still.speed[k]) <= 1e-10);
  }
}

TEST_CASE("radial reference: as an exact solution it starts from the dam and points outwards") {
  const auto exact = radial_dam_break({10, 5, 100, 30, -20}, g, 500);
  CHECK(exact->at(30 + 99, -20, 0).depth == 10);
  CHECK(exact->at(30, -20 + 101, 0).depth == 5);
  const FlowState east = exact->at(30 + 150, -20, 10), north = exact->at(30, -20 + 150, 10),
                  far = exact->at(900, -20, 10);
  CHECK(east.u > 1);
  CHECK(east.v == Approx(0).margin(1e-12));
  CHECK(north.v == Approx(east.u));
  CHECK(north.depth == Approx(east.depth));
  CHECK(far.depth == Approx(5).epsilon(1e-12));
  CHECK(exact->at(30, -20, 10).u == 0);
  // another time makes another profile
  const auto again = radial_dam_profile({10, 5, 100, 30, -20}, 20, g, 500);
  CHECK(exact->at(30 + 150, -20, 20).depth == again.at(150, 0).depth);
}

TEST_CASE("radial reference: a published radial solution at t = 2 s") {
  for (const bool dry : {true, false}) {
    const auto file =
        test::data_file(dry ? "radial_dam_break/radial_dry_t2.csv" : "radial_dam_break/radial_wet_t2.csv");
    if (!file) return;
    const RadialProfile ours = radial_dam_profile({10, dry ? 0.0 : 1.0, 50}, 2, 9.8);  // its g is 9.8
    double difference = 0, depth = 0, flux_difference = 0, flux = 0;
    for (const auto& row : test::number_rows(*file)) {  // r, stage, momentum, bed, depth, velocity
      const FlowState state = ours.at(row[0], 0);
      difference += std::abs(state.depth - row[4]);
      depth += row[4];
      flux_difference += std::abs(state.depth * state.u - row[2]);
      flux += std::abs(row[2]);
    }
    // Its cells are 0.1 m wide: a shock of 3 m smeared over three of them is 0.2 % of the water in 100 m.
    CHECK(difference / depth <= 5e-3);
    CHECK(flux_difference / flux <= 1e-2);
  }
}

TEST_CASE("radial reference: the finite-volume curves of the splitting paper") {
  // Read off a figure of the paper: a sanity check, not truth. The dam of these curves is 1000 m across and
  // centred at x = 1500 m: the initial depth 10 m still stands over 1250 ... 1700 m at 10 s. On slopes of 1
  // in 40, 10 m of the figure's width are 0.25 m of depth: 0.2 m on average is what such curves can tell.
  for (int k = 1; k <= 3; ++k) {
    const auto file = test::data_file("cyl_dam_vacondio/cyl_dam_split_t0" + std::to_string(k) + ".csv");
    if (!file) return;
    const RadialProfile ours = radial_dam_profile({10, 0, 500}, 20.0 * k - 10, g);
    double sum = 0;
    const auto rows = test::number_rows(*file);
    for (const auto& row : rows) sum += std::abs(ours.at(row[0] - 1500, 0).depth - row[1]);
    REQUIRE(rows.size() > 50);
    CHECK(sum / static_cast<double>(rows.size()) <= 0.2);
  }
}
