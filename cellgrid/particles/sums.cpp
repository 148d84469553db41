#include "cellgrid/particles/sums.hpp"

namespace freshet {

double sum_of_values(const char* label, int n, const Field<double>& values) {
  return sum_of_particles<1>(
      label, n, KOKKOS_LAMBDA(const Lanes& me) { return LaneAddends<1>{{me.load(values)}}; })[0];
}

#ifndef FRESHET_DEVICE
template <int K>
IntegerSums<K> sum_of_any_rows(const char* label, int rows, const AnyRow<K>& row) {
  const auto add = [row](int r, IntegerSums<K>& total) { row.add(row.pass, r, total); };
  IntegerSums<K> total;
  Kokkos::parallel_reduce(label, Range(0, rows), add, JoinedSums<K>{&total});
  return total;
}

template IntegerSums<1> sum_of_any_rows<1>(const char*, int, const AnyRow<1>&);
template IntegerSums<2> sum_of_any_rows<2>(const char*, int, const AnyRow<2>&);
template IntegerSums<3> sum_of_any_rows<3>(const char*, int, const AnyRow<3>&);
template IntegerSums<4> sum_of_any_rows<4>(const char*, int, const AnyRow<4>&);

#endif

}  // namespace freshet
