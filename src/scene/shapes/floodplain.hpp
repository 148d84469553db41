// A synthetic flood plain, the same for the same seed on every machine: rising ground all round but for a
// breach in the middle of its upper (northern) side, a plain with three wavelengths of unevenness, low areas,
// and a railway embankment from the lower left towards the middle.
#pragma once
#include "src/scene/scene.hpp"

namespace freshet::input {

struct Floodplain {
  Point low{0, 0}, high{9000, 4000};  // m
  int seed = 1;
};

Function floodplain(const Floodplain& plain);

}  // namespace freshet::input
