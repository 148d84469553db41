#include "cellgrid/sums.hpp"

#ifndef FRESHET_DEVICE
namespace freshet {

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

}  // namespace freshet
#endif
