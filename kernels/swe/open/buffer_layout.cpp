// OpenBuffer: how many rows and columns of boundary particles it has, and where a row begins and ends.
#include <algorithm>
#include <cmath>
#include <vector>

#include "cellgrid/parallel/on_device.hpp"
#include "kernels/swe/open/buffer.hpp"

namespace freshet::swe {
namespace {

// Columns of boundary particles: the support and two more.
double columns(const OpenBufferOptions& o) { return std::max(5.0, std::ceil(o.support * o.eta) + 2); }
constexpr double most_wedge = 4;  // x the buffer's depth: sharper mitres are cut off

// Rows beyond an end that a widening buffer needs.
int wedge_rows(double spread, double buffer, double width) {
  return spread <= 0 ? 0 : static_cast<int>(std::ceil(std::min(spread, most_wedge) * buffer / width - 0.5));
}

}  // namespace

template <int D>
OpenBuffer<D>::OpenBuffer(const OpenLine<D>& line, const OpenBufferOptions& options, int owner)
    : line_(line), options_(options), owner_(owner), buffer_(columns(options) * options.spacing) {
  if (D == 2) {
    count_ = std::max(1, static_cast<int>(std::lround(line.length / options.spacing)));
    width_ = line.length / count_;
    before_ = wedge_rows(line.spread_a, buffer_, width_);
    total_ = before_ + count_ + wedge_rows(line.spread_b, buffer_, width_);
  }
  const auto size = static_cast<size_t>(total_);
  farthest_ = Field<double>("open.farthest", size);
  nearest_ = Field<double>("open.nearest", size);
  room_ = Field<int>("open.room", size + 1);
  inner_room_ = Field<int>("open.inner_room", size);
  std::vector<RowPart> parts;
  for (int r = 0; r < total_; ++r) parts.push_back(extent(r));
  extent_ = on_device("open.extents", parts);
}

// Where the sides of the buffer cross a row, on the lattice of the boundary particles: those on the side
// itself belong to the piece that begins there.
template <int D>
typename OpenBuffer<D>::RowPart OpenBuffer<D>::extent(int row) const {
  constexpr double rounding = 1e-6;
  RowPart part{0, buffer_};
  const double dx = options_.spacing, from_a = (row - before_ + 0.5) * width_, from_b = line_.length - from_a;
  const auto cut = [&](double distance, double spread, bool at_a) {
    if (D == 1 || spread == 0) return;
    const double reached = -distance / spread, cell = reached / dx - 0.5;
    if (distance < 0) part.from = dx * (at_a ? std::ceil(cell - rounding) : std::floor(cell + rounding) + 1);
    if (distance > 0 && spread < 0) part.to = std::min(part.to, reached - (at_a ? 0 : 0.5 * dx));
  };
  cut(from_a, line_.spread_a, true);
  cut(from_b, line_.spread_b, false);
  return part;
}

template OpenBuffer<1>::OpenBuffer(const OpenLine<1>&, const OpenBufferOptions&, int);
template OpenBuffer<2>::OpenBuffer(const OpenLine<2>&, const OpenBufferOptions&, int);

}  // namespace freshet::swe
