// A range whose parts go to whichever thread is free: pair passes take longer where water is dense or walls are near, and threads
// on a shared machine are not equally fast. Every index writes its own results, so that who does what changes none of them.
#pragma once
#include "cellgrid/launch.hpp"

namespace freshet {

using BalancedRange = DynamicRange;

// clusters: at least so many that fetching a part costs nothing beside it (some 10 us).
inline BalancedRange balanced(int clusters) {
  constexpr int part = 24;
  return BalancedRange(0, clusters, Kokkos::ChunkSize(part));
}

}  // namespace freshet
