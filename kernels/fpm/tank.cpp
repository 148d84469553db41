#include "kernels/fpm/tank.hpp"

#include <algorithm>
#include <cmath>

#include "cellgrid/parallel/on_device.hpp"

namespace freshet::fpm {
namespace {

constexpr double corner_turn = 0.17;  // rad, 10 degrees

void note_corner(Side& s, Side& t) {
  const double angle = turn(s.tangent, t.tangent);
  s.round_b = t.round_a = angle < 0;
  s.corner_b = t.corner_a = angle > corner_turn;
}

}  // namespace

Tank::Tank(const std::vector<Polyline>& lines, double cell) {
  const std::vector<Piece> pieces = pieces_of(lines);
  for (const Piece& piece : pieces) sides_.push_back({piece});
  for (Side& s : sides_)
    if (s.after >= 0) note_corner(s, sides_[static_cast<std::size_t>(s.after)]);
  view_ = {on_device("fpm.sides", sides_), PieceBins(pieces, cell)};
}

// Each side holds the points up to its end b; its first one, where nothing is joined there, too.
std::vector<WallStart> Tank::lay_points(double spacing) const {
  std::vector<WallStart> points;
  for (int k = 0; k < size(); ++k) {
    const Side& s = sides_[static_cast<std::size_t>(k)];
    const int parts = std::max(1, static_cast<int>(std::ceil(s.length / spacing - 1e-9)));
    for (int i = s.before < 0 ? 0 : 1; i <= parts; ++i) {
      const double along = s.length * i / parts;
      const bool corner = i == parts && s.corner_b;
      points.push_back(
          {{s.a.x + along * s.tangent.x, s.a.y + along * s.tangent.y}, corner ? in_corner : on_wall, k});
    }
  }
  return points;
}

}  // namespace freshet::fpm
