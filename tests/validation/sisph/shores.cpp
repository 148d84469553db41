// SISPH with moving shores in 2-D: Thacker's bowl, 128 x 128 cells, theta 0.5, celerity Courant number 1, one
// period; relative L2 of the depth over all particles, dry ones too. The bounds are those of a prototype of
// the corrected scheme.
#include <catch2/catch.hpp>

#include "tests/support/run/run_case.hpp"

using namespace freshet;

namespace {

using Keys = std::vector<std::string>;

test::CaseRun bowl(const std::string& name, const Keys& more = {}) {
  Keys keys{"scene.method=sisph", "sisph.theta=0.5", "water.spacing=78.125", "output.every=0"};
  keys.insert(keys.end(), more.begin(), more.end());
  return test::finish_case(name, keys);
}

// What holds on the way, however large the error: the mass, depths, and passes that settle in a few solves.
// Films too thin for the tolerance of CG once flipped between wet and dry until the cap of 60 solves.
void check_ways(const test::CaseRun& run) {
  const StepReport report = run.method->report();
  CHECK(report.unsettled == 0);
  CHECK(report.newton_max <= 6);
  CHECK(report.solves <= 4 * report.passes);
  CHECK(run.summary.mass.relative_error < 1e-12);
  for (const double depth : run.fluid.depth) REQUIRE(depth >= 0);
}

}  // namespace

TEST_CASE("sisph: water circling in a bowl, lattice and disorder", "[sisph][slow]") {
  const bool lattice = GENERATE(true, false);
  const test::CaseRun run = bowl("thacker", {lattice ? "water.disorder=0" : "water.disorder=0.2"});
  CAPTURE(lattice, run.summary.errors.depth_l2_rel);
  CHECK(run.summary.errors.depth_l2_rel <= (lattice ? 0.65e-2 : 1.2e-2));
  check_ways(run);
}

TEST_CASE("sisph: water bulging in a bowl, lattice and disorder", "[sisph]") {
  const bool lattice = GENERATE(true, false);
  const test::CaseRun run = bowl("thacker_radial", {lattice ? "water.disorder=0" : "water.disorder=0.2"});
  CAPTURE(lattice, run.summary.errors.depth_l2_rel);
  CHECK(run.summary.errors.depth_l2_rel <= (lattice ? 0.5e-2 : 1.2e-2));
  check_ways(run);
}

TEST_CASE("sisph: the error in the bowl falls with the spacing", "[sisph]") {
  double before = 0;
  for (const double spacing : {156.25, 78.125}) {
    const test::CaseRun run = bowl("thacker_radial", {"water.spacing=" + std::to_string(spacing)});
    CAPTURE(spacing, run.summary.errors.depth_l2_rel);
    if (before > 0) CHECK(run.summary.errors.depth_l2_rel < 0.5 * before);  // first order at least: shores
    before = run.summary.errors.depth_l2_rel;
  }
}

TEST_CASE("sisph: a landslide's wave on a beach at a celerity Courant number of 5", "[sisph][slow]") {
  const Keys keys{"scene.method=sisph", "water.start=cells", "sisph.theta=0.5", "sisph.courant=5",
                  "output.every=0"};
  const test::Results summary = test::run_case("beach_wave", keys);
  REQUIRE(summary.errors_at.size() == 3);
  // The case's bound; measured 0.07, 0.38, 0.13 %.
  for (const auto& [t, errors] : summary.errors_at) {
    CAPTURE(t);
    CHECK(errors.depth_l2_rel <= 0.01);
  }
  CHECK(summary.steps < 700);  // the explicit method takes 7700
  CHECK(summary.mass.relative_error < 1e-12);
}
