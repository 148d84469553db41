#include "kernels/sisph/walls.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "cellgrid/on_device.hpp"

namespace freshet::sisph {
namespace {

using Place = std::array<double, 2>;

constexpr double bend = 0.5;             // rad: turns towards the water that are less do not end a chain
constexpr double right_angle = 0.01;     // rad, tolerance
constexpr double half_pi = 1.57079632679489662;

bool meet(const Place& a, const Place& b, double size) { return std::hypot(a[0] - b[0], a[1] - b[1]) < 1e-9 * size; }

double size_of(const std::vector<Polyline>& lines) {
  double size = 0;
  for (const Polyline& line : lines)
    for (const Place& p : line) size = std::max({size, std::abs(p[0] - lines[0][0][0]), std::abs(p[1] - lines[0][0][1])});
  return size;
}

// Lines that begin where another ends are one.
std::vector<Polyline> joined(std::vector<Polyline> lines) {
  const double size = size_of(lines);
  for (bool again = true; again;) {
    again = false;
    for (std::size_t a = 0; a < lines.size() && !again; ++a)
      for (std::size_t b = 0; b < lines.size() && !again; ++b) {
        if (a == b || !meet(lines[a].back(), lines[b].front(), size)) continue;
        lines[a].insert(lines[a].end(), lines[b].begin() + 1, lines[b].end());
        lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(b));
        again = true;
      }
  }
  for (Polyline& line : lines)
    if (line.size() > 2 && meet(line.front(), line.back(), size)) line.back() = line.front();
  return lines;
}

Place tangent(const Place& a, const Place& b) {
  const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
  return {(b[0] - a[0]) / length, (b[1] - a[1]) / length};
}

// The turn to the left, rad: towards the water.
double turn(const Place& s, const Place& t) { return std::atan2(s[0] * t[1] - s[1] * t[0], s[0] * t[0] + s[1] * t[1]); }

struct Cut {
  std::vector<Polyline> chains;
  std::vector<int> open;
  std::vector<double> corners;  // six values each
  int slanting = 0;
};

// Notes the corner at b; true if a chain ends there.
bool ends_chain(const Place& a, const Place& b, const Place& c, Cut& cut) {
  const Place s = tangent(a, b), t = tangent(b, c);
  const double angle = turn(s, t);
  if (angle < bend) return false;
  if (std::abs(angle - half_pi) < right_angle)
    cut.corners.insert(cut.corners.end(), {b[0], b[1], -s[1], s[0], -t[1], t[0]});
  else
    ++cut.slanting;
  return true;
}

void add_open(const Polyline& line, Cut& cut) {
  Polyline chain{line[0]};
  for (std::size_t k = 1; k < line.size(); ++k) {
    chain.push_back(line[k]);
    if (k + 1 < line.size() && ends_chain(line[k - 1], line[k], line[k + 1], cut)) {
      cut.chains.push_back(chain);
      cut.open.push_back(1);
      chain = {line[k]};
    }
  }
  cut.chains.push_back(chain);
  cut.open.push_back(1);
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
  cut.chains.push_back(line);
  cut.open.push_back(0);
}

// Free ends go on straight.
Polyline lengthened(Polyline line, double beyond, const MirrorWalls<2>::Ends& goes_on) {
  const std::size_t n = line.size();
  const Place first = tangent(line[0], line[1]), last = tangent(line[n - 2], line[n - 1]);
  const double before = goes_on(line[0]) ? beyond : 0, behind = goes_on(line[n - 1]) ? beyond : 0;
  for (std::size_t k = 0; k < 2; ++k) line[0][k] -= before * first[k], line[n - 1][k] += behind * last[k];
  return line;
}

// Of corners, `stride` values each.
SegmentBins bins_of_corners(const std::vector<double>& corners, std::size_t stride, double cell) {
  std::vector<SegmentBins::Ends> ends;
  for (std::size_t k = 0; k < corners.size(); k += stride) {
    const double x = corners[k], y = stride > 1 ? corners[k + 1] : 0;
    ends.push_back({{x, y}, {x, y}});
  }
  return SegmentBins(ends, cell);
}

}  // namespace

template <>
MirrorWalls<1>::MirrorWalls(const std::vector<Polyline>& lines, double beyond, const Ends&) {
  std::vector<double> places;
  for (const Polyline& line : lines) places.push_back(line[0][0]);
  corners_ = bins_of_corners(places, 1, beyond);
  corner_ = on_device("sisph.wall_place", places);
}

template <>
MirrorWalls<2>::MirrorWalls(const std::vector<Polyline>& lines, double beyond, const Ends& goes_on) {
  if (lines.empty()) return;
  Cut cut;
  for (const Polyline& line : joined(lines)) {
    if (line.front() == line.back())
      add_closed(line, cut);
    else
      add_open(lengthened(line, beyond, goes_on), cut);
  }
  std::vector<SegmentBins::Ends> ends;
  std::vector<int> chains, end;
  std::vector<double> ax, ay, tx, ty, length;
  for (std::size_t c = 0; c < cut.chains.size(); ++c) {
    const Polyline& chain = cut.chains[c];
    for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
      const Place t = tangent(chain[k], chain[k + 1]);
      ax.push_back(chain[k][0]), ay.push_back(chain[k][1]), tx.push_back(t[0]), ty.push_back(t[1]);
      length.push_back(std::hypot(chain[k + 1][0] - chain[k][0], chain[k + 1][1] - chain[k][1]));
      ends.push_back({{chain[k][0], chain[k][1]}, {chain[k + 1][0], chain[k + 1][1]}});
      chains.push_back(static_cast<int>(c));
      end.push_back(cut.open[c] == 0 ? 0 : (k == 0 ? at_a : 0) | (k + 2 == chain.size() ? at_b : 0));
    }
  }
  slanting_ = cut.slanting;
  pieces_ = SegmentBins(ends, 0.25 * beyond);
  corners_ = bins_of_corners(cut.corners, 6, beyond);
  chain_ = on_device("sisph.wall_chain", chains), end_ = on_device("sisph.wall_end", end);
  ax_ = on_device("sisph.wall_ax", ax), ay_ = on_device("sisph.wall_ay", ay);
  tx_ = on_device("sisph.wall_tx", tx), ty_ = on_device("sisph.wall_ty", ty);
  length_ = on_device("sisph.wall_length", length);
  corner_ = on_device("sisph.wall_corner", cut.corners);
}

template class MirrorWalls<1>;
template class MirrorWalls<2>;

}  // namespace freshet::sisph
