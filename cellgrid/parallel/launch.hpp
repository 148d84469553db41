// Loops over particles, clusters and cells: Kokkos::parallel_for whose machinery is compiled once, not for
// every body. A body is compiled as one function of a part of the range, where Kokkos compiles it twice
// (within and outside of a parallel region) and copies every view that it holds once more. Each index must
// write its own results only.
#pragma once
#include "cellgrid/parallel/types.hpp"

namespace freshet {

// A range whose parts go to whichever thread is free: pair passes take longer where water is dense or walls
// are near, and threads on a shared machine are not equally fast. Every index writes its own results, so that
// who does what changes none of them.
using DynamicRange = Kokkos::RangePolicy<Exec, Kokkos::Schedule<Kokkos::Dynamic>>;

// clusters: at least so many that fetching a part costs nothing beside it (some 10 us).
inline DynamicRange balanced(int clusters) {
  constexpr int part = 24;
  return DynamicRange(0, clusters, Kokkos::ChunkSize(part));
}

#ifdef FRESHET_DEVICE
template <class Policy, class Body>
void launch(const char* label, const Policy& range, const Body& body) {
  Kokkos::parallel_for(label, range, body);
}
#else
// A body without its type: run(body, first, end) calls it for first ... end - 1.
struct AnyBody {
  void (*run)(const void* body, int first, int end);
  const void* body;
};
void launch_any(const char* label, const Range& range, const AnyBody& body);  // a part for each thread
void launch_any(const char* label, const DynamicRange& range,
                const AnyBody& body);  // parts of the range's chunk size

template <class Body>
void run_part(const void* body, int first, int end) {
  const Body& one = *static_cast<const Body*>(body);
  for (int i = first; i < end; ++i) one(i);
}

template <class Policy, class Body>
void launch(const char* label, const Policy& range, const Body& body) {
  launch_any(label, range, AnyBody{run_part<Body>, &body});
}
#endif

}  // namespace freshet
