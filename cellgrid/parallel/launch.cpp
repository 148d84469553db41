#include "cellgrid/parallel/launch.hpp"

#ifndef FRESHET_DEVICE
namespace freshet {
namespace {

// The range in parts of equal size, the last one what is left.
struct Partition {
  AnyBody body;
  int begin, end, size;

  int count() const { return (end - begin + size - 1) / size; }
  void operator()(int part) const {
    const int first = begin + part * size;
    body.run(body.body, first, smaller(first + size, end));
  }
};

template <class Policy>
Partition cut(const Policy& range, const AnyBody& body, int size) {
  return {body, static_cast<int>(range.begin()), static_cast<int>(range.end()), larger(size, 1)};
}

}  // namespace

void launch_any(const char* label, const Range& range, const AnyBody& body) {
  const int threads = Exec().concurrency(), length = static_cast<int>(range.end() - range.begin());
  const Partition parts = cut(range, body, (length + threads - 1) / threads);
  Kokkos::parallel_for(label, Range(0, parts.count()), parts);
}

void launch_any(const char* label, const DynamicRange& range, const AnyBody& body) {
  const Partition parts = cut(range, body, static_cast<int>(range.chunk_size()));
  Kokkos::parallel_for(label, DynamicRange(0, parts.count(), Kokkos::ChunkSize(1)), parts);
}

}  // namespace freshet
#endif
