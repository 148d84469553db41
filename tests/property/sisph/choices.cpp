// Choices for SISPH that do nothing or cannot be are told, and scenes of the explicit method that ask for its
// fields still run.
#include <catch2/catch.hpp>

#include "src/methods/method.hpp"
#include "tests/support/run/run_case.hpp"

using namespace freshet;

TEST_CASE("sisph: a Courant number beside a fixed step is told") {
  CHECK(test::read_case("sisph_bump").notes.empty());
  const Scene scene = test::read_case("sisph_bump", {"sisph.courant=20"});
  REQUIRE(scene.notes.size() == 1);
  CHECK_THAT(scene.notes[0], Catch::Contains("sisph.courant") && Catch::Contains("0.0015"));
}

TEST_CASE("sisph: conservative pressure wants two passes and water everywhere") {
  CHECK_THROWS_WITH(test::read_case("sisph_dam_break", {"sisph.picard=1"}), Catch::Contains("without bound"));
  const Scene bowl =
      test::read_case("thacker", {"scene.method=sisph", "water.spacing=400", "sisph.momentum=conservative"});
  CHECK_THROWS_WITH(make_method(bowl),
                    Catch::Contains("conservative") && Catch::Contains("needs water everywhere"));
}

TEST_CASE("sisph: still water in a round basin, as the summary sees it") {
  const test::Results s =
      test::run_case("rest_circle", {"scene.method=sisph", "water.start=cells", "time.end=50"});
  CHECK(s.steady.max_speed_rel <= 1e-12);
}
