// Seconds of a call with its launches finished: the least of some repeats.
#pragma once
#include <algorithm>
#include <chrono>

#include "cellgrid/parallel/types.hpp"

namespace freshet {

template <class Call>
double fastest(int repeats, const Call& call) {  // s
  double least = 1e300;
  for (int n = 0; n < repeats; ++n) {
    const auto begun = std::chrono::steady_clock::now();
    call();
    Exec().fence();
    least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count());
  }
  return least;
}

}  // namespace freshet
