// Sums over particles that do not depend on the number of threads: chunks of fixed size, added in order.
#pragma once
#include "cellgrid/launch.hpp"
#include "cellgrid/types.hpp"

namespace freshet {

class OrderedSums {
 public:
  // values(i) returns a Kokkos::Array<double, K>; returns their sum over i < n. What values() writes on the way is one fused
  // pass. The scratch is kept for the next call. Chunk: smaller where each i is itself much work, as a cluster of particles.
  template <int K, int Chunk = 512, class Values>
  Kokkos::Array<double, K> sum(const char* label, int n, const Values& values) {
    const int chunks = (n + Chunk - 1) / Chunk;
    if (partial_.extent_int(0) < chunks * K)
      partial_ = Field<double>(Kokkos::ViewAllocateWithoutInitializing("cellgrid.partial_sums"), static_cast<size_t>(2 * chunks * K));
    const Field<double> partial = partial_;
    launch(label, Range(0, chunks), KOKKOS_LAMBDA(int c) {
          Kokkos::Array<double, K> sum{};
          for (int i = c * Chunk; i < smaller((c + 1) * Chunk, n); ++i) {
            const Kokkos::Array<double, K> value = values(i);
            for (int k = 0; k < K; ++k) sum[k] += value[k];
          }
          for (int k = 0; k < K; ++k) partial(c * K + k) = sum[k];
        });
    const auto host = on_host(partial);
    Kokkos::Array<double, K> total{};
    for (int c = 0; c < chunks; ++c)
      for (int k = 0; k < K; ++k) total[k] += host(c * K + k);
    return total;
  }

 private:
  Field<double> partial_;
};

}  // namespace freshet
