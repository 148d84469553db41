#include "kernels/ground/nearest_table.hpp"

#include <algorithm>
#include <cmath>

#include "cellgrid/parallel/assign.hpp"

namespace freshet {

NearestTable::NearestTable(const std::function<double(double, double)>& value, const Nodes& lattice)
    : per_dx_(1 / lattice.step[0]), per_dy_(1 / lattice.step[1]) {
  constexpr double slack = 1e-9;  // cells: one that only touches the region's edge is left out
  const auto first_of = [&](int k) {
    return std::floor((lattice.low[k] - lattice.node[k]) / lattice.step[k] + 0.5 + slack);
  };
  const auto last_of = [&](int k) {
    return std::ceil((lattice.high[k] - lattice.node[k]) / lattice.step[k] - 0.5 - slack);
  };
  const auto count_of = [&](int k) { return std::max(1, static_cast<int>(last_of(k) - first_of(k)) + 1); };
  nx_ = count_of(0);
  ny_ = count_of(1);
  x0_ = lattice.node[0] + first_of(0) * lattice.step[0];
  y0_ = lattice.node[1] + first_of(1) * lattice.step[1];
  value_ = Field<double>(Kokkos::ViewAllocateWithoutInitializing("ground.table"),
                         static_cast<size_t>(nx_) * static_cast<size_t>(ny_));
  upload(value_, value_.extent(0), [&](std::size_t k) {
    const int i = static_cast<int>(k) % nx_, j = static_cast<int>(k) / nx_;
    return value(x0_ + i * lattice.step[0], y0_ + j * lattice.step[1]);
  });
}

}  // namespace freshet
