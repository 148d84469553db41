// A wave draws back from a plane beach and runs up, against the hodograph solution (benchmark 1 of ISEC
// 2004).
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "src/reference/beach.hpp"
#include "tests/support/run/run_case.hpp"

using namespace freshet;

namespace {

const Beach beach{0.1, 5000, {{0.006, 0.4444, 4.1209}, {-0.018, 4.0, 1.6384}}};

// How far the outermost particle lies seawards of the exact shore [m].
double lag(const test::CaseRun& run) {
  const double innermost = *std::min_element(run.fluid.x.begin(), run.fluid.x.end());
  return innermost - beach_shore(beach, 9.81, run.summary.simulated).x;
}

}  // namespace

TEST_CASE("the shore draws back and comes in again as the exact solution says", "[long]") {
  // An exact run-up. 1 % of the depth within 800 m is 0.5 m rms beside 20 m of draw-down,
  // 0.5 m/s is 3 % of the fastest flow; the shore is a particle, at best within half a spacing: two are
  // allowed.
  const auto drawn = test::finish_case("beach_wave", {"time.end=175", "compare.times=[160, 175]"});
  const auto run_up = test::finish_case("beach_wave");
  REQUIRE(run_up.summary.errors_at.size() == 3);
  for (const auto& [t, errors] : run_up.summary.errors_at) {
    CAPTURE(t, errors.depth_linf);
    CHECK(errors.depth_l2_rel <= 0.01);
    CHECK(errors.velocity_l2 <= 0.5);
  }
  CHECK(std::abs(lag(drawn)) <= 20);
  CHECK(std::abs(lag(run_up)) <= 20);
  CHECK(run_up.summary.mass.relative_error <= 1e-12);
}

TEST_CASE("the wave on the beach converges", "[long]") {
  // First order at the moving shore would halve the errors. The landward part of the run-up is left out:
  // there one light particle that was overtaken by its neighbour makes nine tenths of the error at some
  // spacings and none at others.
  const auto run = [](const char* dx) {
    return test::run_case("beach_wave",
                          {std::string("water.spacing=") + dx, "compare.where=x > 0 && x < 800"});
  };
  const test::Results coarse = run("20"), fine = run("10");
  for (const std::size_t k : {0, 1, 2}) {
    CAPTURE(coarse.errors_at[k].t);
    CHECK(coarse.errors_at[k].errors.depth_l2_rel / fine.errors_at[k].errors.depth_l2_rel >= 1.5);
  }
}
