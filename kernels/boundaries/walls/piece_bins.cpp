#include "kernels/boundaries/walls/piece_bins.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "cellgrid/parallel/on_device.hpp"

namespace freshet {
namespace {

// The least and the largest of x [m] along the part of a -> b whose y lies between low and high.
std::array<double, 2> extent_between(const Piece& s, double low, double high) {
  const double rise = s.b.y - s.a.y;
  double from = 0, to = 1;
  if (std::abs(rise) > 1e-300) {
    from = std::clamp((low - s.a.y) / rise, 0.0, 1.0);
    to = std::clamp((high - s.a.y) / rise, 0.0, 1.0);
  }
  const double x0 = s.a.x + from * (s.b.x - s.a.x), x1 = s.a.x + to * (s.b.x - s.a.x);
  return {std::min(x0, x1), std::max(x0, x1)};
}

}  // namespace

// The lattice: about square cells, as many as memory can spare, none finer than asked for.
void PieceBins::span(const std::vector<Piece>& pieces, double finest) {
  constexpr double cells_per_piece = 16, rounding = 1e-14;
  double largest = 0;
  for (const Piece& s : pieces)
    for (const Vec<double, 2>& p : {s.a, s.b}) {
      bounds_ = {std::min(bounds_.xlo, p.x), std::max(bounds_.xhi, p.x), std::min(bounds_.ylo, p.y),
                 std::max(bounds_.yhi, p.y)};
      largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
    }
  const double width = bounds_.xhi - bounds_.xlo, height = bounds_.yhi - bounds_.ylo;
  const double cells = cells_per_piece * size_;
  double side = std::max({finest, std::sqrt(width * height / cells), std::max(width, height) / cells});
  if (side <= 0) side = 1;  // all pieces are one point
  slack_ = 1e-6 * side + rounding * largest;
  bounds_ = {bounds_.xlo - slack_, bounds_.xhi + slack_, bounds_.ylo - slack_, bounds_.yhi + slack_};
  per_cell_ = 1 / side;
  nx_ = static_cast<int>(width * per_cell_) + 1;
  ny_ = static_cast<int>(height * per_cell_) + 1;
}

// Calls visit(cell) for the cells that the piece crosses, row by row.
template <class Visit>
void PieceBins::for_each_crossed(const Piece& s, const Visit& visit) const {
  const double low = std::min(s.a.y, s.b.y) - slack_, high = std::max(s.a.y, s.b.y) + slack_;
  for (int j = cell(low, bounds_.ylo, ny_); j <= cell(high, bounds_.ylo, ny_); ++j) {
    const double bottom = j == 0 ? low : bounds_.ylo + j / per_cell_ - slack_;
    const double top = j + 1 == ny_ ? high : bounds_.ylo + (j + 1) / per_cell_ + slack_;
    const auto [x0, x1] = extent_between(s, bottom, top);
    const int last = cell(x1 + slack_, bounds_.xlo, nx_);
    for (int i = cell(x0 - slack_, bounds_.xlo, nx_); i <= last; ++i) visit(at(i, j));
  }
}

PieceBins::PieceBins(const std::vector<Piece>& pieces, double finest)
    : size_(static_cast<int>(pieces.size())) {
  if (pieces.empty()) return;
  span(pieces, finest);
  std::vector<int> first(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_) + 1, 0);
  for (const Piece& s : pieces) for_each_crossed(s, [&](int c) { ++first[static_cast<std::size_t>(c) + 1]; });
  for (std::size_t c = 1; c < first.size(); ++c) first[c] += first[c - 1];
  std::vector<int> list(static_cast<std::size_t>(first.back())), free = first;
  for (int k = 0; k < size_; ++k)
    for_each_crossed(pieces[static_cast<std::size_t>(k)],
                     [&](int c) { list[static_cast<std::size_t>(free[static_cast<std::size_t>(c)]++)] = k; });
  first_ = on_device("pieces.first", first);
  list_ = on_device("pieces.list", list);
}

}  // namespace freshet
