#include "kernels/ground/regions.hpp"

#include "cellgrid/parallel/on_device.hpp"

namespace freshet {

PlacedValue::PlacedValue(double elsewhere, const std::vector<ValuedRegion>& regions)
    : count_(static_cast<int>(regions.size())), elsewhere_(elsewhere) {
  std::vector<double> x, y, value;
  std::vector<int> first{0};
  for (const ValuedRegion& region : regions) {
    for (const auto& corner : region.corners) x.push_back(corner[0]), y.push_back(corner[1]);
    first.push_back(static_cast<int>(x.size()));
    value.push_back(region.value);
  }
  x_ = on_device("regions.x", x);
  y_ = on_device("regions.y", y);
  first_ = on_device("regions.first", first);
  value_ = on_device("regions.value", value);
}

}  // namespace freshet
