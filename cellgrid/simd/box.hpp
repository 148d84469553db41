// The axis-aligned box of a cluster's lanes [m]; in 1-D its y is zero.
#pragma once
#include "cellgrid/simd/lanes.hpp"
#include "cellgrid/simd/vec.hpp"

namespace freshet {

struct Box {
  double xlo, xhi, ylo, yhi;
};
KOKKOS_FORCEINLINE_FUNCTION Box box_of(const Vec<Lane, 1>& x) {
  return {smallest(x.x), largest(x.x), 0.0, 0.0};
}
KOKKOS_FORCEINLINE_FUNCTION Box box_of(const Vec<Lane, 2>& x) {
  return {smallest(x.x), largest(x.x), smallest(x.y), largest(x.y)};
}

}  // namespace freshet
