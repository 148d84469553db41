// Steps land on events, and none is tiny.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/reference/exact.hpp"
#include "src/run/observe/events.hpp"
#include "src/run/record/errors.hpp"

using namespace freshet;

TEST_CASE("regular times begin at 0 and end at the end") {
  CHECK(regular_times(0, 5) == std::vector<double>{0, 5});
  CHECK(regular_times(2, 5) == std::vector<double>{0, 2, 4, 5});
  CHECK(regular_times(10, 5) == std::vector<double>{0, 5});
  CHECK(regular_times(1, 0) == std::vector<double>{0});
  const auto tenths = regular_times(0.1, 0.3);  // 3 * 0.1 > 0.3 in binary
  REQUIRE(tenths.size() == 4);
  CHECK(tenths.back() == 0.3);
  CHECK(regular_times(0.05, 22.5).size() == 451);  // the measured times of Okushiri
}

TEST_CASE("comparison times spread over the window before the end") {
  Compare compare;
  compare.exact = stoker(2, 1, 0, 9.81);
  CHECK(comparison_times(compare, 10) == std::vector<double>{10});
  compare.samples = 3;
  compare.window = 2;
  CHECK(comparison_times(compare, 10) == std::vector<double>{8, 9, 10});
  CHECK(comparison_times(compare, 1) == std::vector<double>{0, 1});  // none before the start
}

TEST_CASE("the time left to an event is split into equal steps") {
  const double stable = 0.3, end = 1;
  Clock clock;
  std::vector<double> steps;
  while (clock.t < end) {
    const Stride stride = stride_towards(end, clock, stable);
    CHECK(stride.dt <= stable);
    steps.push_back(stride.dt);
    clock.t = stride.until;
  }
  CHECK(clock.t == 1.0);  // exactly, not by a sum
  REQUIRE(steps.size() == 4);
  // Equal up to the rounding of the running time: 4 additions of numbers below 1, 2^-53 each.
  for (const double dt : steps) CHECK(dt == Approx(0.25).margin(1e-15));
}

TEST_CASE("no step is shorter than half the stable one unless two events are closer") {
  const double end = 10;
  Timetable events(regular_times(0.37, end));
  Clock clock;
  double shortest = 1e9;
  while (clock.t < end) {
    if (events.due(clock.t)) events.advance();
    const double stable = 0.05 * (1.2 + std::sin(40 * clock.t));
    const Stride stride = stride_towards(events.next(), clock, stable);
    // ceil(q) < 2 q for q > 1: a remainder of more than one stable step is never cut below half of it. A
    // remainder of less than one step can only follow a step that was itself the first of equal parts, with a
    // stable step grown since.
    if (stride.until < events.next()) CHECK(stride.dt > 0.5 * stable);
    shortest = std::min(shortest, stride.dt);
    clock.t = stride.until;
  }
  CHECK(shortest > 0.5 * 0.05 * 0.2);  // half the smallest stable step
  CHECK(events.done() + 1 == events.count());
}

TEST_CASE("without water any step is stable") {
  const Stride stride = stride_towards(3, {}, std::numeric_limits<double>::infinity());
  CHECK(stride.dt == 3.0);
  CHECK(stride.until == 3.0);
}
