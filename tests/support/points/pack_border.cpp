// Functions that take and return packs by value, compiled apart from the test that calls them: between
// objects built with different instruction sets the arguments arrive in other registers, silently.
#include "tests/support/points/pack_border.hpp"

namespace freshet::test {

Lane twice_and_once(Lane a, Lane b) { return 2.0 * a + b; }

Lane sum_of_ten(Lane a, Lane b, Lane c, Lane d, Lane e, Lane f, Lane g, Lane h, Lane i, Lane j) {
  return a + b + c + d + e + f + g + h + i + j;
}

Vec<Lane, 2> turned(Vec<Lane, 2> a) { return {-a.y, a.x}; }

}  // namespace freshet::test
