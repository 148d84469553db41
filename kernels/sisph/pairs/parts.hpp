// Parts of wholes: the components of a vector unknown, which lie one after another, and the sum over the
// particles of a slice.
#pragma once
#include <utility>

#include "cellgrid/particles/pairs.hpp"

namespace freshet::sisph {

// Components of `stride` values each.
inline VecField<double, 1> parts(const Field<double>& v, int stride, Vec<double, 1>) {
  return {Kokkos::subview(v, std::make_pair(0, stride))};
}
inline VecField<double, 2> parts(const Field<double>& v, int stride, Vec<double, 2>) {
  return {Kokkos::subview(v, std::make_pair(0, stride)),
          Kokkos::subview(v, std::make_pair(stride, 2 * stride))};
}

}  // namespace freshet::sisph
