#include "kernels/regions.hpp"

#include "cellgrid/assign.hpp"

namespace freshet {
namespace {

template <class T>
Field<T> uploaded(const std::string& label, const std::vector<T>& values) {
  Field<T> field(label, values.size());
  auto host = Kokkos::create_mirror_view(field);
  for (std::size_t k = 0; k < values.size(); ++k) host(k) = values[k];
  assign(field, host);
  return field;
}

}  // namespace

PlacedValue::PlacedValue(double elsewhere, const std::vector<ValuedRegion>& regions)
    : count_(static_cast<int>(regions.size())), elsewhere_(elsewhere) {
  std::vector<double> x, y, value;
  std::vector<int> first{0};
  for (const ValuedRegion& region : regions) {
    for (const auto& corner : region.corners) x.push_back(corner[0]), y.push_back(corner[1]);
    first.push_back(static_cast<int>(x.size()));
    value.push_back(region.value);
  }
  x_ = uploaded("regions.x", x);
  y_ = uploaded("regions.y", y);
  first_ = uploaded("regions.first", first);
  value_ = uploaded("regions.value", value);
}

}  // namespace freshet
