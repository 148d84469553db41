// From a scene's open boundaries and walls to the solver's: pieces, what they impose, and how walls go on
// beside the buffers.
#include <algorithm>
#include <cmath>

#include "cellgrid/parallel/launch.hpp"
#include "kernels/swe/density/lattice.hpp"
#include "src/methods/swe/solver.hpp"

namespace freshet::swe {
namespace {

using Boundary = freshet::OpenBoundary;

constexpr double wall_cells = 8;  // a wall beside a buffer is so long
// sine: a wall that meets the line at a smaller angle runs along it, not out of it
constexpr double least_outward = 0.2;

bool meet(const Vec<double, 2>& a, const Point& b, double spacing) {
  return freshet::meet({a.x, a.y}, b, 1e-3 * spacing);
}

Vec<double, 2> outward(const Piece& piece) { return -1.0 * piece.normal; }

std::vector<Piece> pieces_of(const std::vector<Boundary>& boundaries) {
  std::vector<Piece> pieces;
  for (const Boundary& boundary : boundaries) append_pieces(boundary.line, false, pieces);
  return pieces;
}

// The direction of a wall on its way to `end`, if it ends there.
std::optional<Vec<double, 2>> wall_direction(const std::vector<Wall>& walls, const Vec<double, 2>& end,
                                             double spacing) {
  for (const Wall& wall : walls) {
    const Polyline& line = wall.line;
    if (line.size() < 2) continue;
    if (meet(end, line.front(), spacing)) return piece_between(line[1], line[0]).tangent;
    if (meet(end, line.back(), spacing)) return piece_between(line[line.size() - 2], line.back()).tangent;
  }
  return {};
}

// How a buffer widens at one end of its piece: half of the bend towards another piece, or along an oblique
// wall.
double spread(const Scene& scene, const std::vector<Piece>& pieces, const Piece& piece, bool at_b) {
  const double spacing = scene.water.spacing;
  const Vec<double, 2> end = at_b ? piece.b : piece.a;
  for (const Piece& other : pieces)
    if (const Vec<double, 2> there = at_b ? other.a : other.b; meet(end, {there.x, there.y}, spacing))
      return std::tan(0.5 * (at_b ? turn(piece.tangent, other.tangent) : turn(other.tangent, piece.tangent)));
  const auto wall = wall_direction(scene.walls, end, spacing);
  if (!wall || dot(*wall, outward(piece)) < least_outward) return 0;
  return (at_b ? 1 : -1) * dot(*wall, piece.tangent) / dot(*wall, outward(piece));
}

OpenLine<1> open_line(const Scene&, const std::vector<Piece>&, const Piece& piece, Vec<double, 1>) {
  return {{piece.a.x}, {piece.a.y > piece.b.y ? 1.0 : -1.0}, {0.0}, 1.0};
}
OpenLine<2> open_line(const Scene& scene, const std::vector<Piece>& pieces, const Piece& piece,
                      Vec<double, 2>) {
  const double spread_a = spread(scene, pieces, piece, false), spread_b = spread(scene, pieces, piece, true);
  return {piece.a, piece.normal, piece.tangent, piece.length, spread_a, spread_b};
}

// When what is imposed changes its slope.
std::vector<double> times_of(const Boundary& b) {
  std::vector<double> times;
  for (const Boundary::Imposed& imposed : b.imposed)
    times.insert(times.end(), imposed.series.t.begin(), imposed.series.t.end());
  return times;
}

// A wall that ends on an open line goes on beside its buffer, by whole cells of the lattice that fits its
// length. One that runs along the line ends there.
void extend_end(Point& end, const Point& before, const std::vector<Piece>& pieces, double spacing) {
  for (const Piece& piece : pieces) {
    if (!meet(piece.a, end, spacing) && !meet(piece.b, end, spacing)) continue;
    const Piece last = piece_between(before, end);
    if (dot(last.tangent, outward(piece)) < least_outward) return;
    const double share = wall_cells / std::max(1.0, std::round(last.length / spacing));
    end = {end[0] + share * (end[0] - before[0]), end[1] + share * (end[1] - before[1])};
    return;
  }
}

void extend_past(Polyline& wall, const std::vector<Piece>& pieces, double spacing) {
  if (wall.size() < 2) return;
  extend_end(wall.front(), wall[1], pieces, spacing);
  extend_end(wall.back(), wall[wall.size() - 2], pieces, spacing);
}

}  // namespace

template <int D>
void ExplicitSph<D>::build_boundaries() {
  const std::vector<Piece> all = pieces_of(scene_.boundaries);
  auto piece = all.begin();
  int owner = 1;
  for (const Boundary& b : scene_.boundaries) {
    std::vector<OpenLine<D>> lines;
    for (size_t k = 0; k + 1 < b.line.size(); ++k)
      lines.push_back(open_line(scene_, all, *piece++, Vec<double, D>{}));
    const OpenBufferOptions options{b.spacing > 0 ? b.spacing : scene_.water.spacing, scene_.sph.eta,
                                    support_, lattice_sums<D>(scene_.sph.eta, kernel_).density, friction_};
    boundaries_.emplace_back(
        lines, [b](double t) { return b.at(t); }, times_of(b), options, scene_.gravity, owner);
    owner += boundaries_.back().pieces();
  }
}

template <int D>
void ExplicitSph<D>::build_walls() {
  if (scene_.walls.empty()) return;
  const std::vector<Piece> pieces = pieces_of(scene_.boundaries);
  double spacing = scene_.water.spacing;  // of the coarsest buffer
  for (const Boundary& b : scene_.boundaries) spacing = std::max(spacing, b.spacing);
  std::vector<Polyline> lines;
  for (const Wall& wall : scene_.walls) {
    lines.push_back(wall.line);
    if (D == 2) extend_past(lines.back(), pieces, spacing);
  }
  const Point middle{0.5 * (scene_.domain.low[0] + scene_.domain.high[0]),
                     0.5 * (scene_.domain.low[1] + scene_.domain.high[1])};
  const WallKind kind = scene_.sph.walls.resolved(D == 1 || only_right_corners(lines));
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
  launch(
      "swe::invert_h", Range(0, particles_.size()), KOKKOS_LAMBDA(int i) { p.inv_h(i) = 1.0 / p.h(i); });
  for (auto& boundary : boundaries_)
    boundary.fill(
        order_.rows(), particles_, [this] { return bind(); }, bed_term(), next_id_);
}

template class ExplicitSph<1>;
template class ExplicitSph<2>;

}  // namespace freshet::swe
