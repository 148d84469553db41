// The alarm for runs that go on with garbage.
#include <catch2/catch.hpp>

#include "src/run/strain.hpp"

using namespace freshet;

namespace {

// So many steps of 0.01 s from step `from` on, each with these iterations and so many lists made again per step.
void steps(Strain& strain, StepReport& report, long from, long count, double iterations, double rebuilds) {
  for (long n = 1; n <= count; ++n) {
    report.newton_mean = iterations;
    report.rebuilds = static_cast<long>(rebuilds * static_cast<double>(from + n));
    strain.record(report, {0.01 * static_cast<double>(from + n), from + n});
  }
}

}  // namespace

TEST_CASE("strain: a run at ease has no warning") {
  Strain strain;
  StepReport report;
  steps(strain, report, 0, 1000, 1.3, 0.05);
  CHECK(strain.warnings().empty());
}

TEST_CASE("strain: iterations above three, and lists outgrown in a tenth of the steps, are named with when and how much") {
  Strain strain;
  StepReport report;
  steps(strain, report, 0, 300, 1.2, 0);
  steps(strain, report, 300, 100, 3.5, 0);
  steps(strain, report, 400, 100, 1.2, 0);
  REQUIRE(strain.warnings().size() == 1);
  CHECK_THAT(strain.warnings()[0], Catch::Contains("the density iteration laboured in 1 of 5 spans of 100 steps, first after t = 3 s: "
                                                   "up to 3.5 per step, limit 3"));
  Strain outgrown;
  steps(outgrown, report = {}, 0, 200, 1.2, 0.2);
  REQUIRE(outgrown.warnings().size() == 1);
  CHECK_THAT(outgrown.warnings()[0], Catch::Contains("outgrew their neighbour lists in 2 of 2 spans"));
}

TEST_CASE("strain: a short burst within a span is no alarm, a span not yet full is not judged") {
  Strain strain;
  StepReport report;
  steps(strain, report, 0, 10, 8, 0);
  steps(strain, report, 10, 90, 2, 0);  // mean 2.6
  CHECK(strain.warnings().empty());
  steps(strain, report, 100, 99, 5, 0);
  CHECK(strain.warnings().empty());
}

TEST_CASE("strain: survives a restart in the middle of a span") {
  Strain straight, first, second;
  StepReport report;
  steps(straight, report, 0, 250, 3.5, 0.3);
  report = {};
  steps(first, report, 0, 130, 3.5, 0.3);
  Values values;
  first.save(values);
  second.restore(values);
  steps(second, report, 130, 120, 3.5, 0.3);
  CHECK(second.warnings() == straight.warnings());
  CHECK(second.warnings().size() == 2);
}
