// Still water among curved and slanting walls (Vacondio 2010, section 1.6.2).
#include <catch2/catch.hpp>

#include "tests/support/run/run_case.hpp"

using namespace freshet;

namespace {

struct Rest {
  const char* name;
  double bound;  // of sqrt(g d_max): the thesis' at the end of the run, here for all times
};

}  // namespace

TEST_CASE("still water among curved and slanting walls stays still at all times", "[slow]") {
  const Rest rest =
      GENERATE(Rest{"rest_circle", 0.004}, Rest{"rest_corner_300", 0.008}, Rest{"rest_corner_345", 0.008});
  CAPTURE(rest.name);
  const test::Results s = test::run_case(rest.name);
  CHECK(s.steady.max_speed_rel < rest.bound);
  CHECK(s.mass.relative_error <= 1e-12);  // no particle is made or lost
}

TEST_CASE("a relaxed start is what keeps water still along slanting walls") {
  // From cut cells the first rows are pushed about: the test must be able to tell.
  CHECK(test::run_case("rest_corner_300", {"water.start=cells"}).steady.max_speed_rel > 0.02);
}
