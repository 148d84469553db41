// From a scene to the state at t = 0: the particles of the water and of the rim around the domain, their places and masses.
#include <algorithm>
#include <cmath>

#include "cellgrid/assign.hpp"
#include "cellgrid/launch.hpp"
#include "src/errors.hpp"
#include "src/sisph/beside.hpp"
#include "src/sisph/solver.hpp"

namespace freshet::sisph {
namespace {

void require(bool holds, const std::string& what, const std::string& remedy = "") {
  if (!holds) throw SceneError("the method \"sisph\" does not know " + what + " yet\n  help: " + remedy + "use scene.method = \"sph-swe\"");
}

void require_known(const Scene& scene) {
  require(!scene.split && !scene.merge, "splitting and merging ([split], [merge])");
  require(scene.water.start == freshet::Water::Start::cells, "any water.start but \"cells\"", "set water.start = \"cells\", or ");
  require_on_sides(scene);
}

void require_finite(double depth, const Point& x) {
  if (!std::isfinite(depth))
    throw SceneError("water: the depth at (" + std::to_string(x[0]) + ", " + std::to_string(x[1]) +
                     ") m is not a finite number; check the expressions of [water] and [bed] there");
}

// Width of the cells along a side, as place() has it.
double cell_width(const Scene& scene, int axis) {
  const double length = scene.domain.high[axis] - scene.domain.low[axis];
  return length / std::max(1.0, std::round(length / scene.water.spacing));
}

double cell_area(const Scene& scene) { return cell_width(scene, 0) * (scene.domain.dimension == 2 ? cell_width(scene, 1) : 1.0); }

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

void fill_fields(FieldSet& fields, const std::vector<StartCell>& start) {
  const auto fill = [&](const auto& field, const auto& value) {
    upload(field, start.size(), [&](std::size_t i) { return value(start[i]); });
  };
  const bool plane = fields.has("y");
  fill(fields.real("x"), [](const StartCell& s) { return s.placed.x[0]; });
  if (plane) fill(fields.real("y"), [](const StartCell& s) { return s.placed.x[1]; });
  fill(fields.real("u"), [](const StartCell& s) { return s.depth > 0 ? s.placed.velocity[0] : 0.0; });
  if (plane) fill(fields.real("v"), [](const StartCell& s) { return s.depth > 0 ? s.placed.velocity[1] : 0.0; });
  fill(fields.real("depth"), [](const StartCell& s) { return s.depth; });
  fill(fields.real("h"), [](const StartCell& s) { return s.placed.h0; });
  if (fields.has("bed")) fill(fields.real("bed"), [](const StartCell& s) { return s.bed; });
  fill(fields.integer("kind"), [](const StartCell& s) { return s.held ? 1 : 0; });
  upload(fields.integer("id"), start.size(), [](std::size_t i) { return static_cast<int>(i); });
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
      if (std::abs(end[axis] - domain.low[axis]) < 0.5 * dx || std::abs(end[axis] - domain.high[axis]) < 0.5 * dx) return true;
    return false;
  });
}

// Every cell has a particle, dry or wet. Depths below a billionth of the deepest are what rounding leaves of dry land.
template <int D>
void SemiImplicitSph<D>::place_particles() {
  constexpr double rounding = 1e-9;
  require_known(scene_);
  const Scene wider = with_rim(scene_, support_);
  bed_ = bed_spline<D>(scene_, wider.domain);
  std::vector<StartCell> start;
  const double whole = scene_.sisph.smoothing * (D == 2 ? std::sqrt(cell_area(scene_)) : cell_area(scene_));  // beside walls, too
  double deepest = 0, covered = 0;
  int inside = 0;
  for (Placed& p : place(wider, [](double, double) { return 1.0; })) {
    const double bed = bed_ ? bed_->at(to_vec<D>(p.x)).b : 0.0, depth = initial_depth<D>(scene_, bed_, p.x);
    require_finite(depth, p.x);
    const bool held = !is_inside(scene_.domain, p.x);
    if (held && beside(scene_, p.x).wall) continue;
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
  make_fields();
  fill_fields(particles_, start);
}

template <int D>
Geometry<D> SemiImplicitSph<D>::measure() {
  order_.sort(particles_);
  const Field<double> h = particles_.real("h");
  order_.measure_reach(particles_, h, support_);
  const int n = particles_.size();
  const bool linear = scene_.sisph.correction == Sisph::Correction::krongauz_belytschko;
  const FieldSet& f = particles_;
  const Geometry<D> geometry = measure_geometry<D>(n, kernel_, {order_.rows(), f.vector<D>("x", "y"), h, f.integer("kind"),
                                                                scene_.water.spacing, cell_, mirror_walls(), linear});
  if (geometry.images.count > 0) {  // room for their vectors
    particles_.resize(geometry.images.slots() + lanes);
    particles_.resize(n);
  }
  level_of_bed_ = bed_ ? particles_.real("bed") : Field<double>("sisph.flat_bed", static_cast<std::size_t>(n) + lanes);
  const Field<double> mass = particles_.real("mass"), depth = particles_.real("depth"), omega = geometry.omega;
  launch("sisph::fill", Range(0, n), KOKKOS_LAMBDA(int i) { mass(i) = omega(i) * depth(i); });
  return geometry;
}

template class SemiImplicitSph<1>;
template class SemiImplicitSph<2>;

}  // namespace freshet::sisph
