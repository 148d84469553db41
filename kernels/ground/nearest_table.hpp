// A property of the ground on a regular lattice. A place has the value of the nearest node: land use has
// edges, nothing is blended across them. Beyond the lattice the rim's value goes on.
#pragma once
#include <array>
#include <functional>

#include "cellgrid/simd/lanes.hpp"
#include "cellgrid/simd/vec.hpp"

namespace freshet {

class NearestTable {
 public:
  struct Nodes {
    std::array<double, 2> low, high;   // m, the region to cover; 1-D: the same y
    std::array<double, 2> node, step;  // m, one of the nodes, and their spacings
  };

  NearestTable() = default;  // empty: given() is false and nothing is allocated
  // Samples value(x, y) at the nodes whose cells lie in the region, in part at least.
  NearestTable(const std::function<double(double, double)>& value, const Nodes& lattice);

  KOKKOS_FORCEINLINE_FUNCTION bool given() const { return nx_ > 0; }
  int points() const { return nx_ * ny_; }

  // V: double, or a pack for the particles of a cluster.
  template <class V>
  KOKKOS_FORCEINLINE_FUNCTION V at(const Vec<V, 1>& p) const {
    return gather(value_.data(), column(p.x));
  }
  template <class V>
  KOKKOS_FORCEINLINE_FUNCTION V at(const Vec<V, 2>& p) const {
    return gather(value_.data(), nearest(p.y, y0_, per_dy_, ny_) * nx_ + column(p.x));
  }

 private:
  template <class V>
  KOKKOS_FORCEINLINE_FUNCTION auto column(V x) const {
    return nearest(x, x0_, per_dx_, nx_);
  }
  template <class V>
  static KOKKOS_FORCEINLINE_FUNCTION auto nearest(V s, double first, double per_step, int n) {
    return to_index(clamp((s - first) * per_step + 0.5, V(0.0), V(n - 1.0)));
  }

  double x0_ = 0, y0_ = 0, per_dx_ = 1, per_dy_ = 1;
  int nx_ = 0, ny_ = 0;
  Field<double> value_;  // x fastest
};

}  // namespace freshet
