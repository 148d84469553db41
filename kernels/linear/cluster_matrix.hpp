// A sparse matrix with ones on its diagonal, stored beside a cluster list: entry [c][k][lane] couples the lane's row with the column of
// the cluster's k-th neighbour (zero where that is no neighbour of the row). No gathers: columns are broadcast to the lanes.
#pragma once
#include "cellgrid/clusters.hpp"

namespace freshet::linear {

struct ClusterMatrix {
  ClusterSet clusters;
  NeighbourView near;  // columns
  Kokkos::View<double***, Kokkos::LayoutRight, Memory> a;  // off the diagonal
  Kokkos::View<float***, Kokkos::LayoutRight, Memory> single;  // the same for preconditioners: half the memory traffic
  int rows = 0;

  KOKKOS_FORCEINLINE_FUNCTION Lane entry(int c, int k) const {
    Lane value;
    __builtin_memcpy(&value, &a(c, k, 0), sizeof(Lane));
    return value;
  }

  KOKKOS_FORCEINLINE_FUNCTION void set(int c, int k, Lane value) const {
    __builtin_memcpy(&a(c, k, 0), &value, sizeof value);
    store_single(&single(c, k, 0), value);
  }

  // The cluster's rows of A x without the diagonal; rough: from the single-precision entries.
  KOKKOS_FORCEINLINE_FUNCTION Lane off_diagonal(int c, const Field<double>& x) const {
    return sum(c, x, [&](int k) { return entry(c, k); });
  }
  KOKKOS_FORCEINLINE_FUNCTION Lane off_diagonal_rough(int c, const Field<double>& x) const {
    return sum(c, x, [&](int k) { return load_single(&single(c, k, 0)); });
  }

  // y := A x
  void multiply(const Field<double>& x, const Field<double>& y) const {
    const ClusterMatrix m = *this;
    Kokkos::parallel_for("linear::multiply", Range(0, clusters.size()), KOKKOS_LAMBDA(int c) {
          const Lanes me = m.clusters(c);
          me.store(y, me.load(x) + m.off_diagonal(c, x));
        });
  }

 private:
  template <class Entry>
  KOKKOS_FORCEINLINE_FUNCTION Lane sum(int c, const Field<double>& x, const Entry& entry_at) const {
    const int n = near.length(c);
    const int* j = &near.list(c, 0);
    Lane even{0.0}, odd{0.0};  // two chains: a multiply-add takes four cycles
    int k = 0;
    for (; k + 1 < n; k += 2) {
      even += entry_at(k) * x(j[k]);
      odd += entry_at(k + 1) * x(j[k + 1]);
    }
    if (k < n) even += entry_at(k) * x(j[k]);
    return even + odd;
  }
};

}  // namespace freshet::linear
