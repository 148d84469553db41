// The alarm for runs that go on with garbage.
#include <catch2/catch.hpp>

#include "src/run/watch/energy.hpp"
#include "src/run/watch/stability.hpp"

using namespace freshet;

namespace {

// So many steps of 0.01 s from step `from` on, each with these iterations and so many lists made again per
// step.
void steps(StabilityWatch& watch, StepReport& report, long from, long count, double iterations,
           double rebuilds) {
  for (long n = 1; n <= count; ++n) {
    report.newton_mean = iterations;
    report.rebuilds = static_cast<long>(rebuilds * static_cast<double>(from + n));
    watch.record(report, {0.01 * static_cast<double>(from + n), from + n});
  }
}

}  // namespace

TEST_CASE("stability: a run at ease has no warning") {
  StabilityWatch watch;
  StepReport report;
  steps(watch, report, 0, 10000, 1.3, 0.05);
  CHECK(watch.warnings(report).empty());
}

TEST_CASE(
    "stability: iterations above three, and lists outgrown in a tenth of the steps, are named with when and "
    "how much") {
  StabilityWatch watch;
  StepReport report;
  steps(watch, report, 0, 3000, 1.2, 0);
  steps(watch, report, 3000, 1000, 3.5, 0);
  steps(watch, report, 4000, 1000, 1.2, 0);
  REQUIRE(watch.warnings(report).size() == 1);
  CHECK_THAT(watch.warnings(report)[0],
             Catch::Contains("the density iteration laboured in 1 of 5 spans of 1000 steps"));
  CHECK_THAT(watch.warnings(report)[0], Catch::Contains("first after t = 30 s: up to 3.5 per step, limit 3"));
  StabilityWatch outgrown;
  steps(outgrown, report = {}, 0, 2000, 1.2, 0.2);
  REQUIRE(outgrown.warnings(report).size() == 1);
  CHECK_THAT(outgrown.warnings(report)[0], Catch::Contains("outgrew their neighbour lists in 2 of 2 spans"));
}

TEST_CASE("stability: a short burst within a span is no alarm, a last span counts from 100 steps on") {
  StabilityWatch watch;
  StepReport report;
  steps(watch, report, 0, 100, 8, 0.4);
  steps(watch, report, 100, 900, 2, 0.04);  // means 2.6 and 0.04
  CHECK(watch.warnings(report).empty());
  StabilityWatch short_run;
  steps(short_run, report = {}, 0, 99, 5, 0);
  CHECK(short_run.warnings(report).empty());
  steps(short_run, report, 99, 1, 5, 0);
  CHECK(short_run.warnings(report).size() == 1);
}

TEST_CASE("stability: survives a restart in the middle of a span") {
  StabilityWatch straight, first, second;
  StepReport report;
  steps(straight, report, 0, 2500, 3.5, 0.3);
  const auto wanted = straight.warnings(report);
  report = {};
  steps(first, report, 0, 1300, 3.5, 0.3);
  Values values;
  first.save(values);
  second.restore(values, {});
  steps(second, report, 1300, 1200, 3.5, 0.3);
  CHECK(second.warnings(report) == wanted);
  CHECK(wanted.size() == 2);
}

TEST_CASE("stability: energy that grows in a closed basin is named, with the time when it was noticed") {
  EnergyWatch watch(Scene{});
  const auto at = [](double kinetic, double potential) {
    Mechanics m;
    m.kinetic = kinetic, m.potential = potential;
    return m;
  };
  watch.start(at(0, 10));
  watch.record(at(2, 8.05), {1, 100});  // 0.05 more, 2.5 % of the kinetic energy
  CHECK(watch.warnings().empty());
  watch.record(at(2, 8.2), {2, 200});
  REQUIRE(watch.warnings().size() == 1);
  CHECK_THAT(watch.warnings()[0],
             Catch::Contains(
                 "up to 0.2 m5/s2 per unit density, largest kinetic energy 2; first noticed at t = 2 s"));
  Values values;
  watch.save(values);
  EnergyWatch again(Scene{});
  again.restore(values, {});
  CHECK(again.warnings() == watch.warnings());
}
