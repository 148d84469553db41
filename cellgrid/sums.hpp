// Sums over particles that do not depend on the number of threads: chunks of fixed size, added in order.
#pragma once
#include "cellgrid/types.hpp"

namespace freshet {

// values(i) returns a Kokkos::Array<double, K>; returns their sum over i < n.
template <int K, class Values>
Kokkos::Array<double, K> ordered_sum(const char* label, int n, const Values& values) {
  constexpr int chunk = 512;
  const int chunks = (n + chunk - 1) / chunk;
  using Sums = Kokkos::View<double**, Kokkos::LayoutRight, Memory>;
  const Sums partial(Kokkos::ViewAllocateWithoutInitializing("ordered_sum"), static_cast<size_t>(chunks), K);
  Kokkos::parallel_for(label, Range(0, chunks), KOKKOS_LAMBDA(int c) {
        Kokkos::Array<double, K> sum{};
        for (int i = c * chunk; i < smaller((c + 1) * chunk, n); ++i) {
          const Kokkos::Array<double, K> value = values(i);
          for (int k = 0; k < K; ++k) sum[k] += value[k];
        }
        for (int k = 0; k < K; ++k) partial(c, k) = sum[k];
      });
  const auto host = on_host(partial);
  Kokkos::Array<double, K> total{};
  for (int c = 0; c < chunks; ++c)
    for (int k = 0; k < K; ++k) total[k] += host(c, k);
  return total;
}

}  // namespace freshet
