#include "kernels/sisph/walls/mirror_walls.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "cellgrid/parallel/on_device.hpp"

namespace freshet::sisph {
namespace {

constexpr double bend = 0.5;          // rad: turns towards the water that are less do not end a chain
constexpr double right_angle = 0.01;  // rad, tolerance

double size_of(const std::vector<Polyline>& lines) {
  double size = 0;
  for (const Polyline& line : lines)
    for (const auto& [x, y] : line)
      size = std::max({size, std::abs(x - lines[0][0][0]), std::abs(y - lines[0][0][1])});
  return size;
}

// Lines that begin where another ends are one.
std::vector<Polyline> joined(std::vector<Polyline> lines) {
  const double rounding = 1e-9 * size_of(lines);
  for (bool again = true; again;) {
    again = false;
    for (std::size_t a = 0; a < lines.size() && !again; ++a)
      for (std::size_t b = 0; b < lines.size() && !again; ++b) {
        if (a == b || !meet(lines[a].back(), lines[b].front(), rounding)) continue;
        lines[a].insert(lines[a].end(), lines[b].begin() + 1, lines[b].end());
        lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(b));
        again = true;
      }
  }
  for (Polyline& line : lines)
    if (is_closed(line, rounding)) line.back() = line.front();
  return lines;
}

struct Cut {
  std::vector<Piece> pieces;
  std::vector<int> chain;  // of pieces
  int chains = 0;
  std::vector<WallCorner> corners;
  int slanting = 0;

  void add(const Polyline& line, bool closed) {
    append_pieces(line, closed, pieces);
    chain.resize(pieces.size(), chains++);
  }
};

// Notes the corner at b; true if a chain ends there.
bool ends_chain(const Point& a, const Point& b, const Point& c, Cut& cut) {
  const Piece s = piece_between(a, b), t = piece_between(b, c);
  const double angle = turn(s.tangent, t.tangent);
  if (angle < bend) return false;
  if (std::abs(angle - 0.5 * pi) < right_angle) cut.corners.push_back({s.b, {s.normal, t.normal}});
  else ++cut.slanting;
  return true;
}

void add_open(const Polyline& line, Cut& cut) {
  Polyline chain{line[0]};
  for (std::size_t k = 1; k < line.size(); ++k) {
    chain.push_back(line[k]);
    if (k + 1 < line.size() && ends_chain(line[k - 1], line[k], line[k + 1], cut)) {
      cut.add(chain, false);
      chain = {line[k]};
    }
  }
  cut.add(chain, false);
}

// Turned so that it begins at a corner, if there is one.
void add_closed(const Polyline& line, Cut& cut) {
  const std::size_t n = line.size() - 1;
  for (std::size_t k = 0; k < n; ++k) {
    Cut unused;
    if (!ends_chain(line[(k + n - 1) % n], line[k], line[k + 1], unused)) continue;
    Polyline turned;
    for (std::size_t l = 0; l <= n; ++l) turned.push_back(line[(k + l) % n]);
    (void)ends_chain(line[(k + n - 1) % n], line[k], line[k + 1], cut);
    return add_open(turned, cut);
  }
  cut.add(line, true);
}

// Free ends go on straight.
Polyline lengthened(Polyline line, double beyond, const MirrorWalls<2>::Ends& goes_on) {
  const std::size_t n = line.size();
  const Piece first = piece_between(line[0], line[1]), last = piece_between(line[n - 2], line[n - 1]);
  const double before = goes_on(line[0]) ? beyond : 0, behind = goes_on(line[n - 1]) ? beyond : 0;
  const Vec<double, 2> from = first.a - before * first.tangent, to = last.b + behind * last.tangent;
  line[0] = {from.x, from.y}, line[n - 1] = {to.x, to.y};
  return line;
}

PieceBins bins_of(const std::vector<WallCorner>& corners, double cell) {
  std::vector<Piece> places;
  for (const WallCorner& corner : corners) places.push_back({corner.x, corner.x});
  return PieceBins(places, cell);
}

}  // namespace

template <>
MirrorWalls<1>::MirrorWalls(const std::vector<Polyline>& lines, double beyond, const Ends&) {
  std::vector<WallCorner> places;
  for (const Polyline& line : lines) places.push_back({to_vec<2>(line[0]), {}});
  corner_bins_ = bins_of(places, beyond);
  corners_ = on_device("sisph.wall_corners", places);
}

template <>
MirrorWalls<2>::MirrorWalls(const std::vector<Polyline>& lines, double beyond, const Ends& goes_on) {
  if (lines.empty()) return;
  Cut cut;
  for (const Polyline& line : joined(lines)) {
    if (line.front() == line.back()) add_closed(line, cut);
    else add_open(lengthened(line, beyond, goes_on), cut);
  }
  slanting_ = cut.slanting;
  bins_ = PieceBins(cut.pieces, 0.25 * beyond);
  corner_bins_ = bins_of(cut.corners, beyond);
  pieces_ = on_device("sisph.wall_pieces", cut.pieces);
  chain_ = on_device("sisph.wall_chain", cut.chain);
  corners_ = on_device("sisph.wall_corners", cut.corners);
}

template class MirrorWalls<1>;
template class MirrorWalls<2>;

}  // namespace freshet::sisph
