// A flood of Thamesmead's size over synthetic terrain: the hydrograph's water to 0.5 %, mass to round-off.
#include <catch2/catch.hpp>

#include "tests/support/run/run_case.hpp"

using namespace freshet;

namespace {

void check_breach(const std::vector<std::string>& overrides) {
  const test::Results s = test::run_case("breach", overrides);
  // m3: up in 30 min, constant for 2 h, down in 1 h
  const double hydrograph = 100 * (1800 / 2.0 + 7200 + 3600 / 2.0);
  CHECK(s.simulated == 21600);
  // Water enters in whole particles, and what stands across the line is known to a part of them.
  CHECK(s.mass.inflow - s.mass.outflow == Approx(hydrograph).epsilon(5e-3));
  CHECK(s.mass.final == Approx(s.mass.inflow - s.mass.outflow).epsilon(1e-10));
  CHECK(s.mass.relative_error < 1e-10);
}

}  // namespace

TEST_CASE("breach: twice the spacing floods six hours and keeps the hydrograph's water", "[slow]") {
  check_breach({"water.spacing=30", "raster.maxima=false"});
}

TEST_CASE("breach: the flood of six hours keeps the hydrograph's water", "[long]") { check_breach({}); }
