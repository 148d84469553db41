// Run-up of a non-breaking solitary wave on a beach in the laboratory (NTHMP BP04, H/d = 0.0185).
#include <catch2/catch.hpp>

#include "tests/support/run/data.hpp"
#include "tests/support/run/run_case.hpp"

using namespace freshet;

namespace {

constexpr double depth = 0.3;  // m

}  // namespace

TEST_CASE("a solitary wave runs up a laboratory beach as measured", "[bp04]") {
  if (!test::data_file("nthmp/BP04-JosephZ-Single_wave_on_simple_beach/profs/Case0_0185.t=30")) return;
  const test::Results s = test::run_case("bp04");
  // Measured run-up between H/d = 0.018 and 0.019: 0.074 to 0.078 d; NOAA asks for 10 % of laboratory run-up.
  REQUIRE(s.run_ups.size() == 1);
  CHECK(s.run_ups[0].highest == Approx(0.0758 * depth).epsilon(0.10));
  // Neighbouring measured points differ by +-0.004 d at t* = 60 and +-0.005 d in the thin sheet of t* = 70.
  const double scatter[] = {0.004, 0.004, 0.004, 0.004, 0.005};
  REQUIRE(s.transects.size() == 5);
  for (std::size_t k = 0; k < 5; ++k) {
    CAPTURE(s.transects[k].name);
    CHECK(s.transects[k].points >= 50);
    CHECK(s.transects[k].rmse <= scatter[k] * depth);
  }
  CHECK(s.mass.relative_error <= 1e-12);
}
