// Packs across a border between objects (pack_border.cpp).
#pragma once
#include "cellgrid/simd/lanes.hpp"
#include "cellgrid/simd/vec.hpp"

namespace freshet::test {

Lane twice_and_once(Lane a, Lane b);  // 2 a + b
Lane sum_of_ten(Lane a, Lane b, Lane c, Lane d, Lane e, Lane f, Lane g, Lane h, Lane i,
                Lane j);              // more than fit in registers
Vec<Lane, 2> turned(Vec<Lane, 2> a);  // by 90 degrees

}  // namespace freshet::test
