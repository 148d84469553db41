// Reproducible disorder of points at the start: the same on every machine and for any number of threads.
#pragma once
#include <cstdint>

namespace freshet {

// A number of [-1, 1) that depends on the seed and the counter alone (splitmix64).
inline double random_offset(int seed, std::uint64_t counter) {
  std::uint64_t z =
      static_cast<std::uint64_t>(seed) * 0x632be59bd9b4e019u + (counter + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-52 - 1;
}

}  // namespace freshet
