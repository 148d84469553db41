// Where the semi-implicit method pays: an eddy at a Froude number of 0.01, steady, so that all change is
// error (docs/howto/choose_a_method.md).
#include <catch2/catch.hpp>

#include <cmath>

#include "tests/support/run/run_case.hpp"

using namespace freshet;

namespace {

struct Result {
  double velocity_rms;  // m/s
  long steps;
};

Result run(double spacing, std::vector<std::string> keys = {}) {
  keys.push_back("water.spacing=" + std::to_string(spacing));
  keys.push_back("output.every=0");
  const test::Results summary = test::run_case("slow_eddy", keys);
  CHECK(summary.mass.relative_error < 1e-12);
  return {summary.errors.velocity_l2, summary.steps};
}

}  // namespace

TEST_CASE("sisph: a slow eddy goes on turning at a celerity Courant number of 20", "[sisph]") {
  const double bound[] = {1.4e-3, 2.1e-4,
                          3.0e-5};  // measured 1.26e-3, 1.91e-4, 2.65e-5; the water's own rms is 3.6e-2
  double before = 0;
  int k = 0;
  for (const double spacing : {0.4, 0.2, 0.1}) {
    const Result r = run(spacing);
    CAPTURE(spacing, r.velocity_rms, r.steps);
    CHECK(r.velocity_rms <= bound[k++]);
    if (before > 0) CHECK(std::log2(before / r.velocity_rms) >= 2);
    before = r.velocity_rms;
  }
}

TEST_CASE(
    "sisph: a slow eddy needs a fiftieth of the explicit method's steps and has a tenth of its error on "
    "twice its spacing",
    "[sisph]") {
  const Result semi_implicit = run(0.4), explicit_method = run(0.2, {"scene.method=sph-swe"});
  CAPTURE(semi_implicit.velocity_rms, semi_implicit.steps, explicit_method.velocity_rms,
          explicit_method.steps);
  CHECK(semi_implicit.velocity_rms < 0.1 * explicit_method.velocity_rms);
  CHECK(50 * semi_implicit.steps < explicit_method.steps);
}

TEST_CASE("sisph: a slow eddy is stable at celerity Courant numbers of 5 and 50", "[sisph][slow]") {
  CHECK(run(0.1, {"sisph.courant=5"}).velocity_rms < 2e-5);   // measured 1.4e-5
  CHECK(run(0.1, {"sisph.courant=50"}).velocity_rms < 8e-5);  // measured 6.0e-5, in 40 steps
}
