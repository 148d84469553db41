#include "src/scene/sections/boundaries/open_law.hpp"

#include "cellgrid/parallel/on_device.hpp"

namespace freshet {
namespace {

TimeSeries in_time(const OpenBoundary& boundary, std::size_t k) {
  if (k >= boundary.imposed.size() || boundary.imposed[k].series.t.empty()) return {};
  const Series& series = boundary.imposed[k].series;
  return {on_device("open.times", series.t), on_device("open.values", series.value)};
}

}  // namespace

LawInTime law_in_time(const OpenBoundary& boundary) {
  return {boundary.law, in_time(boundary, 0), in_time(boundary, 1)};
}

}  // namespace freshet
