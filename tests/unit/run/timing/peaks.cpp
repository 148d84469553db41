// The measured limits of the machine against what its clock and the width of its registers allow.
#include "src/run/timing/peaks.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

#include "cellgrid/simd/registers.hpp"

using namespace freshet;

TEST_CASE("peaks: multiply-adds reach what clock and width allow", "[alone]") {
  // Other programs only take time away: the best of up to twenty tries counts, a second in all.
  double share = 0;
  for (int n = 0; n < 20 && share < 0.7; ++n)
    share = std::max(share, multiply_add_rate(1) / (clock_rate() * allowed_multiply_adds()));
  INFO(instruction_set << " at " << 1e-9 * clock_rate() << " GHz");
  // 0.7: loads, branches and a clock that changes between the two loops. Packs wider than the registers
  // reached 0.06.
  CHECK(share > 0.7);
  // Three units where two are counted, or cores whose 64 bytes are not two halves: twice, never three times.
  CHECK(share < 3);
}
