// The pack of a cluster's lanes: which of them count, how it passes between objects; its words for scalars.
#include "cellgrid/simd/lanes.hpp"

#include <catch2/catch.hpp>

#include "tests/support/points/pack_border.hpp"

using namespace freshet;

TEST_CASE("pack: the same words for plain scalars") {
  CHECK(size_of(-2.0) == 2);
  CHECK(turned_by(3.0, -1.0) == -3);
  CHECK(larger_where(false, 1.0, 2.0) == 1);
  CHECK(larger_where(true, 1.0, 2.0) == 2);
  CHECK(rsqrt(4.0) == 0.5);
  CHECK(inverse_cbrt(8.0) == Approx(0.5).epsilon(1e-15).margin(0));
  CHECK(select(true, 1.0, 2.0) == 1);
  CHECK((any(true) && count(true) == 1 && !any(false)));
}

TEST_CASE("pack: the first lanes of a cluster") {
  for (int k = 0; k <= lanes; ++k) {
    CHECK(count(first_lanes(k)) == k);
    const Lane which = select(first_lanes(k), Lane(1.0), Lane(0.0));
    for (int l = 0; l < lanes; ++l) CHECK(lane_of(which, l) == (l < k ? 1 : 0));
  }
}

TEST_CASE("pack: passed by value between objects") {
  const Lane a = lanes_of<Lane>([](int l) { return 1.0 + l; }),
             b = lanes_of<Lane>([](int l) { return 10.0 - l; });
  const auto check = [](const Lane& found, const auto& expected) {
    for (int l = 0; l < lanes; ++l) CHECK(lane_of(found, l) == expected(l));
  };
  check(test::twice_and_once(a, b), [](int l) { return 2 * (1.0 + l) + 10 - l; });
  check(test::sum_of_ten(a, a, a, a, a, a, a, a, a, 100.0 * a), [](int l) { return 109 * (1.0 + l); });
  const Vec<Lane, 2> turned = test::turned({a, b});
  check(turned.x, [](int l) { return -(10.0 - l); });
  check(turned.y, [](int l) { return 1.0 + l; });
}
