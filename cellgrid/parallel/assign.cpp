#include "cellgrid/parallel/assign.hpp"

namespace freshet {

void assign(const Field<double>& field, double value) { Kokkos::deep_copy(field, value); }
void assign(const Field<int>& field, int value) { Kokkos::deep_copy(field, value); }
void assign(const Field<double>& field, const HostMirror<double>& values) {
  Kokkos::deep_copy(field, values);
}
void assign(const Field<int>& field, const HostMirror<int>& values) { Kokkos::deep_copy(field, values); }

}  // namespace freshet
