// From a scene's open boundaries and walls to the method's: pieces, what they impose, how walls go on beside buffers.
#include <algorithm>
#include <cmath>

#include "cellgrid/launch.hpp"
#include "kernels/swe/lattice.hpp"
#include "src/scene/open_law.hpp"
#include "src/swe/solver.hpp"

namespace freshet::swe {
namespace {

using Boundary = freshet::OpenBoundary;
using Line = std::vector<Point>;

constexpr double wall_cells = 8;      // a wall beside a buffer is so long
constexpr double least_outward = 0.2;  // sine: a wall that meets the line at a smaller angle runs along it, not out of it

Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1]}; }
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1]; }
double cross(const Point& a, const Point& b) { return a[0] * b[1] - a[1] * b[0]; }
Point unit(const Point& a) {
  const double length = std::hypot(a[0], a[1]);
  return {a[0] / length, a[1] / length};
}
Point outward(const Point& tangent) { return {tangent[1], -tangent[0]}; }  // the water is on the left
bool meet(const Point& a, const Point& b, double spacing) { return std::hypot(a[0] - b[0], a[1] - b[1]) < 1e-3 * spacing; }

// A straight piece of a boundary, from a to b.
struct Piece {
  Point a, b;
  Point tangent() const { return unit(b - a); }
};

std::vector<Piece> pieces_of(const Scene& scene) {
  std::vector<Piece> pieces;
  for (const Boundary& boundary : scene.boundaries)
    for (size_t k = 0; k + 1 < boundary.line.size(); ++k) pieces.push_back({boundary.line[k], boundary.line[k + 1]});
  return pieces;
}

// The last piece of a wall on its way to `end`, if the wall ends there.
std::optional<Point> wall_direction(const std::vector<Wall>& walls, const Point& end, double spacing) {
  for (const Wall& wall : walls) {
    const Line& line = wall.line;
    if (line.size() < 2) continue;
    if (meet(line.front(), end, spacing)) return unit(line[0] - line[1]);
    if (meet(line.back(), end, spacing)) return unit(line.back() - line[line.size() - 2]);
  }
  return {};
}

// How a buffer widens at one end of its piece: half of the bend towards another piece, or along an oblique wall.
double spread(const Scene& scene, const std::vector<Piece>& pieces, const Piece& piece, bool at_b) {
  const double spacing = scene.water.spacing;
  const Point end = at_b ? piece.b : piece.a, t = piece.tangent();
  for (const Piece& other : pieces)
    if (meet(at_b ? other.a : other.b, end, spacing)) {
      const Point first = at_b ? t : other.tangent(), second = at_b ? other.tangent() : t;
      return std::tan(0.5 * std::atan2(cross(first, second), dot(first, second)));
    }
  const std::optional<Point> wall = wall_direction(scene.walls, end, spacing);
  if (!wall || dot(*wall, outward(t)) < least_outward) return 0;
  return (at_b ? 1 : -1) * dot(*wall, t) / dot(*wall, outward(t));
}

OpenLine<1> open_line(const Scene&, const std::vector<Piece>&, const Piece& piece, Vec<double, 1>) {
  return {{piece.a[0]}, {piece.a[1] > piece.b[1] ? 1.0 : -1.0}, {0.0}, 1.0};
}
OpenLine<2> open_line(const Scene& scene, const std::vector<Piece>& pieces, const Piece& piece, Vec<double, 2>) {
  const Point t = piece.tangent(), n = outward(t);
  const double length = std::hypot(piece.b[0] - piece.a[0], piece.b[1] - piece.a[1]);
  return {{piece.a[0], piece.a[1]}, {-n[0], -n[1]}, {t[0], t[1]}, length,
          spread(scene, pieces, piece, false), spread(scene, pieces, piece, true)};
}

// When what is imposed changes its slope.
std::vector<double> times_of(const Boundary& b) {
  std::vector<double> times;
  for (const Series* series : {&b.level, &b.depth, &b.velocity, &b.discharge})
    times.insert(times.end(), series->t.begin(), series->t.end());
  return times;
}

// A wall that ends on an open line goes on beside its buffer, by whole cells of the lattice that fits its length. One that runs
// along the line ends there.
void extend_end(Point& end, const Point& before, const std::vector<Piece>& pieces, double spacing) {
  for (const Piece& piece : pieces) {
    if (!meet(end, piece.a, spacing) && !meet(end, piece.b, spacing)) continue;
    const Point along = end - before;
    if (dot(unit(along), outward(piece.tangent())) < least_outward) return;
    const double share = wall_cells / std::max(1.0, std::round(std::hypot(along[0], along[1]) / spacing));
    end = {end[0] + share * along[0], end[1] + share * along[1]};
    return;
  }
}

void extend_past(Line& wall, const std::vector<Piece>& pieces, double spacing) {
  if (wall.size() < 2) return;
  extend_end(wall.front(), wall[1], pieces, spacing);
  extend_end(wall.back(), wall[wall.size() - 2], pieces, spacing);
}

WallKind wall_kind(Walling wanted, bool exact_images) {
  switch (wanted) {
    case Walling::none: return WallKind::none;
    case Walling::vbp: return WallKind::vbp;
    case Walling::mvbp: return WallKind::mvbp;
    case Walling::rows: return WallKind::rows;
    case Walling::mirror: return WallKind::mirror;
    case Walling::automatic: break;
  }
  return exact_images ? WallKind::mirror : WallKind::rows;
}

}  // namespace

template <int D>
void ExplicitSph<D>::build_boundaries() {
  const std::vector<Piece> all = pieces_of(scene_);
  auto piece = all.begin();
  int owner = 1;
  for (const Boundary& b : scene_.boundaries) {
    std::vector<OpenLine<D>> lines;
    for (size_t k = 0; k + 1 < b.line.size(); ++k) lines.push_back(open_line(scene_, all, *piece++, Vec<double, D>{}));
    const OpenBufferOptions options{b.spacing > 0 ? b.spacing : scene_.water.spacing, scene_.sph.eta, support_,
                                    lattice_sums<D>(scene_.sph.eta, kernel_).density, friction_};
    boundaries_.emplace_back(lines, law_of(b), times_of(b), options, scene_.gravity, owner);
    owner += boundaries_.back().pieces();
  }
}

template <int D>
void ExplicitSph<D>::build_walls() {
  if (scene_.walls.empty()) return;
  const std::vector<Piece> pieces = pieces_of(scene_);
  double spacing = scene_.water.spacing;  // of the coarsest buffer
  for (const Boundary& b : scene_.boundaries) spacing = std::max(spacing, b.spacing);
  std::vector<Line> lines;
  for (const Wall& wall : scene_.walls) {
    lines.push_back(wall.line);
    if (D == 2) extend_past(lines.back(), pieces, spacing);
  }
  const Point middle{0.5 * (scene_.domain.low[0] + scene_.domain.high[0]), 0.5 * (scene_.domain.low[1] + scene_.domain.high[1])};
  const WallKind kind = wall_kind(scene_.sph.walls, D == 1 || only_right_corners(lines));
  // Rows reach as deep as the support of an h half as long again as the first.
  const double dx = scene_.water.spacing, reach = 1.5 * support_ * scene_.sph.eta * dx;
  walls_.emplace(lines, WallOptions{kind, dx, reach, scene_.sph.slip}, middle, support_);
}

// The buffers at the start, from the water as it was placed.
template <int D>
void ExplicitSph<D>::fill_boundaries() {
  if (boundaries_.empty()) return;
  order_.sort(particles_);
  order_.measure_reach(particles_, particles_.real("h"), support_);
  const Particles<D> p = bind();
  launch("swe::invert_h", Range(0, particles_.size()), KOKKOS_LAMBDA(int i) { p.inv_h(i) = 1.0 / p.h(i); });
  for (auto& boundary : boundaries_)
    boundary.fill(order_.rows(), particles_, [this] { return bind(); }, bed_term(), next_id_);
}

template class ExplicitSph<1>;
template class ExplicitSph<2>;

}  // namespace freshet::swe
