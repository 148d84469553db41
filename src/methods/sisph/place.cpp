// From a scene to the state at t = 0: the particles of the water and of the rim around the domain.
#include <algorithm>
#include <cmath>

#include "cellgrid/parallel/assign.hpp"
#include "cellgrid/parallel/launch.hpp"
#include "src/errors.hpp"
#include "src/methods/sisph/side_at.hpp"
#include "src/methods/sisph/solver.hpp"

namespace freshet::sisph {
namespace {

void require(bool holds, const std::string& what, const std::string& remedy = "") {
  if (!holds)
    throw SceneError("the method \"sisph\" does not know " + what + " yet\n  help: " + remedy +
                     "use scene.method = \"sph-swe\"");
}

void require_known(const Scene& scene) {
  require(!scene.split && !scene.merge, "splitting and merging ([split], [merge])");
  require(scene.water.start == freshet::Water::Start::cells, "any water.start but \"cells\"",
          "set water.start = \"cells\", or ");
  require_on_sides(scene);
}

double cell_area(const Scene& scene) {
  return cell_width(scene, 0) * (scene.domain.dimension == 2 ? cell_width(scene, 1) : 1.0);
}

// The scene with room for the rim: cells of a support beyond each side of the domain.
Scene with_rim(const Scene& scene, double support) {
  Scene wider = scene;
  const double cells = std::ceil(support * scene.sisph.smoothing - 1e-9) + (scene.water.disorder > 0 ? 1 : 0);
  for (int axis = 0; axis < scene.domain.dimension; ++axis) {
    const double rim = cells * cell_width(scene, axis);
    wider.domain.low[axis] -= rim;
    wider.domain.high[axis] += rim;
  }
  wider.water.wet_above = 0;
  return wider;
}

bool is_inside(const Domain& domain, const Point& p) {
  for (int axis = 0; axis < domain.dimension; ++axis)
    if (p[axis] < domain.low[axis] || p[axis] > domain.high[axis]) return false;
  return true;
}

// A particle at t = 0.
struct StartCell {
  Placed placed;
  double depth, bed;  // m
  bool held;
};

template <int D>
void fill_fields(const WaterFields<D>& f, const std::vector<StartCell>& start) {
  const auto fill = [&](const auto& field, const auto& value) {
    upload(field, start.size(), [&](std::size_t i) { return value(start[i]); });
  };
  fill(f.x.x, [](const StartCell& s) { return s.placed.x[0]; });
  fill(f.v.x, [](const StartCell& s) { return s.depth > 0 ? s.placed.velocity[0] : 0.0; });
  if constexpr (D == 2) {
    fill(f.x.y, [](const StartCell& s) { return s.placed.x[1]; });
    fill(f.v.y, [](const StartCell& s) { return s.depth > 0 ? s.placed.velocity[1] : 0.0; });
  }
  fill(f.depth, [](const StartCell& s) { return s.depth; });
  fill(f.h, [](const StartCell& s) { return s.placed.h0; });
  if (f.bed.extent(0) > 0) fill(f.bed, [](const StartCell& s) { return s.bed; });
  fill(f.kind, [](const StartCell& s) { return s.held ? 1 : 0; });
  upload(f.id, start.size(), [](std::size_t i) { return static_cast<int>(i); });
}

}  // namespace

// Walls that end at a side of the domain go on beside the rim.
template <int D>
MirrorWalls<D> SemiImplicitSph<D>::mirror_walls() const {
  std::vector<Polyline> lines;
  for (const Wall& wall : scene_.walls) lines.push_back(wall.line);
  const Domain& domain = scene_.domain;
  const double dx = scene_.water.spacing;
  return MirrorWalls<D>(lines, (2 * support_ * scene_.sisph.smoothing + 2) * dx, [&](const Point& end) {
    for (std::size_t axis = 0; axis < 2; ++axis)
      if (std::abs(end[axis] - domain.low[axis]) < 0.5 * dx ||
          std::abs(end[axis] - domain.high[axis]) < 0.5 * dx)
        return true;
    return false;
  });
}

// Every cell has a particle, dry or wet. Depths below a billionth of the deepest are what rounding leaves of
// dry land.
template <int D>
void SemiImplicitSph<D>::place_particles() {
  constexpr double rounding = 1e-9;
  require_known(scene_);
  const Scene wider = with_rim(scene_, support_);
  bed_ = bed_spline<D>(scene_, wider.domain);
  std::vector<StartCell> start;
  const double whole = scene_.sisph.smoothing *
                       (D == 2 ? std::sqrt(cell_area(scene_)) : cell_area(scene_));  // beside walls, too
  double deepest = 0, covered = 0;
  int inside = 0;
  for (Placed& p : place(wider, [](double, double) { return 1.0; })) {
    const double bed = bed_ ? bed_->at(to_vec<D>(p.x)).b : 0.0, depth = initial_depth<D>(scene_, bed_, p.x);
    require_finite(depth, p.x);
    const bool held = !is_inside(scene_.domain, p.x);
    if (held && side_at(scene_, p.x).wall) continue;
    if (!held) covered += p.area, ++inside;
    p.h0 = whole;
    start.push_back({p, depth, bed, held});
    deepest = std::max(deepest, depth);
  }
  if (!(deepest > 0)) throw SceneError("water: no particle is wet: check [water] and [bed]");
  cell_ = covered / inside;
  held_ = static_cast<int>(start.size()) - inside;
  const double least = std::max(scene_.water.wet_above, rounding * deepest);
  for (StartCell& s : start) s.depth = s.depth > least ? s.depth : 0.0;
  particles_ = FieldSet(static_cast<int>(start.size()));
  fill_fields(declare(FieldList::making(particles_)), start);
}

template <int D>
Geometry<D> SemiImplicitSph<D>::measure() {
  order_.sort(particles_);
  order_.measure_reach(particles_, bind().h, support_);
  const int n = particles_.size();
  const bool linear = scene_.sisph.exact_slopes;
  const WaterFields<D> sorted = bind();
  const GeometryRequest<D> request{order_.rows(),        sorted.x, sorted.h,       sorted.kind,
                                   scene_.water.spacing, cell_,    mirror_walls(), linear};
  const Geometry<D> geometry = measure_geometry<D>(n, kernel_, request);
  if (geometry.images.count > 0) {  // room for their vectors
    particles_.resize(geometry.images.slots() + lanes);
    particles_.resize(n);
  }
  const WaterFields<D> f = bind();
  level_of_bed_ = bed_ ? f.bed : Field<double>("sisph.flat_bed", static_cast<std::size_t>(n) + lanes);
  const Field<double> mass = f.mass, depth = f.depth, omega = geometry.omega;
  launch(
      "sisph::fill", Range(0, n), KOKKOS_LAMBDA(int i) { mass(i) = omega(i) * depth(i); });
  return geometry;
}

template class SemiImplicitSph<1>;
template class SemiImplicitSph<2>;

}  // namespace freshet::sisph
