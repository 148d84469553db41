// SISPH against exact and finely resolved solutions: Bankole (2016), ch. 7. What is asked of the scheme are
// orders; the bounds beside them hold what the corrected scheme has reached.
#include <catch2/catch.hpp>

#include <cmath>

#include "tests/support/run/sisph_cases.hpp"

using namespace freshet;

using test::at;
using test::Keys;
using Result = test::CaseError;

namespace {

Result run(const std::string& name, const Keys& keys) { return test::case_error(name, keys); }

}  // namespace

TEST_CASE("sisph: a smooth hump converges at second order", "[sisph]") {
  double before = 0;
  for (const int n : {200, 400, 800}) {
    const Result r = run("sisph_hump", at(n, 0.01 * 200 / n));
    CAPTURE(n, r.depth_l2);
    if (n == 200) CHECK(r.depth_l2 <= 2.0e-3);
    if (n > 200) CHECK(std::log2(before / r.depth_l2) >= 1.8);
    CHECK(r.summary.mass.relative_error < 1e-12);
    before = r.depth_l2;
  }
}

TEST_CASE("sisph: the thesis' hump about to break (7.1.1)", "[sisph]") {
  test::check_breaking_hump(run, {2.1e-2, 1.2e-2, 6.4e-3});
}

// A scheme of first order rounds the corners of a rarefaction over the root of the spacing, by as much: 3/4
// in L2 in the limit; 0.77 and 0.79 were found.
TEST_CASE("sisph: two rarefactions (7.1.2)", "[sisph]") {
  const double bound[] = {2.0e-2, 1.2e-2, 6.8e-3};
  double before = 0;
  int k = 0;
  for (const int n : {200, 400, 800}) {
    const Result r = run("sisph_rarefactions", at(n, 0.01 * 200 / n));
    CAPTURE(n, r.depth_l2);
    CHECK(r.depth_l2 <= bound[k++]);
    if (n > 200) CHECK(std::log2(before / r.depth_l2) >= 0.7);
    before = r.depth_l2;
    CHECK(r.summary.mass.relative_error < 1e-12);
    CHECK(r.summary.mass.outflow == Approx(0.3).epsilon(1e-3));  // two ends, 1 m deep, 1 m/s, 0.15 s
  }
}

TEST_CASE("sisph: the lake in a basin (7.1.3)", "[sisph]") {
  for (const auto& [theta, bound] : {std::pair{0.5, 3.2e-4}, {0.55, 1.0e-3}}) {
    const std::string with = "sisph.theta=" + std::to_string(theta);
    const Result r = run("sisph_lake", {with}),
                 coarse = run("sisph_lake", {with, "water.spacing=0.05", "time.dt=0.02"});
    CAPTURE(theta, coarse.depth_l2, r.depth_l2);
    CHECK(r.depth_l2 <= bound);
    // The step goes with the spacing: with theta 0.55 first order in time, with 0.5 it is not less.
    CHECK(std::log2(coarse.depth_l2 / r.depth_l2) >= 1);
    CHECK(r.summary.mass.relative_error < 1e-13);
    CHECK(r.report.unsettled == 0);
  }
}

TEST_CASE("sisph: a hump in two dimensions on lattice and disorder", "[sisph]") {
  double before = 0;
  for (const int n : {50, 100}) {
    const Result r =
        run("sisph_bump", at(n, 0.15 * 50 / (12.0 * n), {"sisph.theta=0.55", "water.disorder=0.2"}));
    CAPTURE(n, r.depth_l2);
    CHECK(r.depth_l2 <= (n == 50 ? 3.3e-3 : 1.3e-3));
    if (n == 100) CHECK(std::log2(before / r.depth_l2) >= 1);
    CHECK(r.summary.mass.relative_error < 1e-12);
    before = r.depth_l2;
  }
}
