// From a scene to the solver's state: bed, particles and the held rim, geometry, the form of the momentum.
#include <algorithm>
#include <cmath>

#include "cellgrid/assign.hpp"
#include "cellgrid/launch.hpp"
#include "src/errors.hpp"
#include "src/scene/open_law.hpp"
#include "src/scene/place.hpp"
#include "src/sisph/beside.hpp"
#include "src/sisph/solver.hpp"

namespace freshet::sisph {

// A particle at t = 0.
struct Start {
  Placed placed;
  double depth, bed;  // m
  bool held;
};

namespace {

void require(bool holds, const std::string& what, const std::string& remedy = "") {
  if (!holds) throw SceneError("the method \"sisph\" does not know " + what + " yet\n  help: " + remedy + "use scene.method = \"sph-swe\"");
}

void require_known(const Scene& scene) {
  require(!scene.split && !scene.merge, "splitting and merging ([split], [merge])");
  require(scene.water.start == freshet::Water::Start::cells, "any water.start but \"cells\"", "set water.start = \"cells\", or ");
  require_on_sides(scene);
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

template <class F>
void set_field(const Field<double>& field, const std::vector<Start>& start, const F& value) {
  auto host = Kokkos::create_mirror_view(field);
  for (std::size_t i = 0; i < start.size(); ++i) host(i) = value(start[i]);
  assign(field, host);
}

template <int D>
VecField<double, D> scratch(const std::string& label, int n) {
  const auto field = [&] { return Field<double>(label, static_cast<std::size_t>(n) + lanes); };
  if constexpr (D == 1) return {field()};
  else return {field(), field()};
}

VecField<double, 1> vector_field(const FieldSet& f, const char* x, const char*, Vec<double, 1>) { return {f.real(x)}; }
VecField<double, 2> vector_field(const FieldSet& f, const char* x, const char* y, Vec<double, 2>) { return {f.real(x), f.real(y)}; }

// see(i, place) for the particles.
template <int D, class See>
void for_each_place(const VecField<double, D>& x, int particles, const See& see) {
  const auto along = on_host(x.x);
  auto up = along;
  if constexpr (D == 2) up = on_host(x.y);
  for (int i = 0; i < particles; ++i) see(i, Point{along(i), D == 2 ? up(i) : 0.0});
}

}  // namespace

// Walls that end at a side of the domain go on beside the rim.
template <int D>
MirrorWalls<D> Solver<D>::mirror_walls() const {
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
void Solver<D>::place_particles() {
  constexpr double rounding = 1e-9;
  require_known(scene_);
  const Scene wider = with_rim(scene_, support_);
  if (scene_.bed.elevation) {
    const double spacing = scene_.bed.spacing > 0 ? scene_.bed.spacing : scene_.water.spacing;
    bed_.emplace(scene_.bed.elevation, typename BedSpline<D>::Lattice{wider.domain.low, wider.domain.high, spacing, scene_.bed.filter});
  }
  std::vector<Start> start;
  const double whole = scene_.sisph.smoothing * (D == 2 ? std::sqrt(cell_area(scene_)) : cell_area(scene_));  // beside walls, too
  double deepest = 0, covered = 0;
  int inside = 0;
  for (Placed& p : place(wider, [](double, double) { return 1.0; })) {
    Vec<double, D> place;
    place.x = p.x[0];
    if constexpr (D == 2) place.y = p.x[1];
    const double bed = bed_ ? bed_->at(place).b : 0.0;
    const double depth = scene_.water.surface ? scene_.water.surface(p.x[0], p.x[1]) - bed : scene_.water.depth(p.x[0], p.x[1]);
    if (!std::isfinite(depth)) throw SceneError("water: the depth at (" + std::to_string(p.x[0]) + ", " + std::to_string(p.x[1]) +
                                                ") m is not a finite number; check the expressions of [water] and [bed] there");
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
  for (Start& s : start) s.depth = s.depth > least ? s.depth : 0.0;
  particles_ = FieldSet(static_cast<int>(start.size()));
  make_fields();
  fill_fields(start);
}

template <int D>
void Solver<D>::make_fields() {
  FieldSet& f = particles_;
  for (const char* name : {"x", "y"})
    if (D == 2 || name == std::string("x")) f.real(name, "m", Carry::state);
  for (const char* name : {"u", "v"})
    if (D == 2 || name == std::string("u")) f.real(name, "m/s", Carry::state);
  f.real("depth", "m", Carry::state);
  f.real("h", "m", Carry::state);
  f.real("mass", D == 1 ? "m2" : "m3", Carry::state);
  if (bed_) f.real("bed", "m", Carry::state);
  f.integer("id", "1", Carry::state);
  f.integer("kind", "1", Carry::state);
}

template <int D>
void Solver<D>::fill_fields(const std::vector<Start>& start) {
  const auto fill = [&](const char* name, const auto& value) { set_field(particles_.real(name), start, value); };
  fill("x", [](const Start& s) { return s.placed.x[0]; });
  if (D == 2) fill("y", [](const Start& s) { return s.placed.x[1]; });
  fill("u", [](const Start& s) { return s.depth > 0 ? s.placed.velocity[0] : 0.0; });
  if (D == 2) fill("v", [](const Start& s) { return s.depth > 0 ? s.placed.velocity[1] : 0.0; });
  fill("depth", [](const Start& s) { return s.depth; });
  fill("h", [](const Start& s) { return s.placed.h0; });
  if (bed_) fill("bed", [](const Start& s) { return s.bed; });
  const auto id = Kokkos::create_mirror_view(particles_.integer("id")), kind = Kokkos::create_mirror_view(particles_.integer("kind"));
  for (std::size_t i = 0; i < start.size(); ++i) id(i) = static_cast<int>(i), kind(i) = start[i].held ? 1 : 0;
  assign(particles_.integer("id"), id);
  assign(particles_.integer("kind"), kind);
}

template <int D>
void Solver<D>::build_geometry() {
  order_.sort(particles_);
  const Field<double> h = particles_.real("h");
  order_.measure_reach(particles_, h, support_);
  const int n = particles_.size();
  const VecField<double, D> x = vector_field(particles_, "x", "y", Vec<double, D>{});
  const bool linear = scene_.sisph.exact_slopes;
  geometry_ = measure_geometry<D>(n, kernel_, {order_.rows(), x, h, particles_.integer("kind"), scene_.water.spacing, cell_,
                                               mirror_walls(), linear});
  if (geometry_.images.count > 0) {  // room for their vectors
    particles_.resize(geometry_.images.slots() + lanes);
    particles_.resize(n);
  }
  if (scene_.sisph.closure && !scene_.sisph.moving) closure_ = close_areas(geometry_);
  level_of_bed_ = bed_ ? particles_.real("bed") : Field<double>("sisph.flat_bed", static_cast<std::size_t>(n) + lanes);
  const Field<double> mass = particles_.real("mass"), depth = particles_.real("depth"), omega = geometry_.omega;
  launch("sisph::fill", Range(0, n), KOKKOS_LAMBDA(int i) { mass(i) = omega(i) * depth(i); });
}

template <int D>
void Solver<D>::build_momentum() {
  const int slots = geometry_.images.slots();
  const Sisph& sisph = scene_.sisph;
  const SurfaceOptions options{scene_.gravity, sisph.theta, sisph.cg.tolerance, sisph.newton.tolerance, sisph.cg.most, sisph.newton.most};
  std::optional<PairSource<D>> source;
  if (sisph.recomputed)
    source = PairSource<D>{kernel_, on_host(Kokkos::subview(particles_.real("h"), std::make_pair(0, 1)))(0), closure_.lambda};
  closure_.lambda = {};
  surface_.emplace(geometry_, order_.rows(), options, source);
  active_.emplace(geometry_);
  active_->find(particles_.real("depth"), sisph.picard);
  rim_.emplace(geometry_);
  for (VecField<double, D>* v : {&slope_, &explicit_, &carried_, &before_, &end_}) *v = scratch<D>("sisph.velocity", slots);
  push(water().v, 0, carried_);  // for good where all of a slice is held
  conservative_ = sisph.momentum.conservative;
  const bool by_fluxes = sisph.momentum.by_fluxes(active_->drying());
  if ((conservative_ || !by_fluxes) && active_->drying())  // antisymmetric pressure on a film's mass knows no bound
    throw SceneError("sisph.momentum = \"" + std::string(sisph.momentum.name) + "\" needs water everywhere, and " +
                     std::to_string(active_->dry()) + " particles are dry\n  help: use \"mass-flux\"");
  if (by_fluxes) {
    fluxes_.emplace(geometry_);
    velocity_gradient_.u = scratch<D>("sisph.grad_u", slots);
    if (D == 2) velocity_gradient_.v = scratch<D>("sisph.grad_v", slots);
  } else {
    paths_.emplace(geometry_, order_.rows(), scene_.water.spacing, support_ * sisph.smoothing * scene_.water.spacing);
  }
}

// Viscosity; g n^2 at each particle, and a place for dt gamma.
template <int D>
void Solver<D>::build_friction() {
  const Sisph& sisph = scene_.sisph;
  if (sisph.viscosity > 0)
    viscosity_.emplace(geometry_, ViscosityOptions{sisph.viscosity, sisph.slip, sisph.cg.tolerance, sisph.cg.most});
  if (!scene_.manning) return;
  const Manning& manning = *scene_.manning;
  g_n2_ = Field<double>("sisph.g_n2", static_cast<std::size_t>(particles_.size()) + lanes);
  const auto host = Kokkos::create_mirror_view(g_n2_);
  for_each_place(geometry_.x, particles_.size(), [&](int i, const Point& p) {
    const double n = manning.map ? manning.map(p[0], p[1]) : manning.n;
    host(i) = scene_.gravity * n * n;
  });
  assign(g_n2_, host);
  drag_ = surface_->make_drag();
}

template <int D>
std::vector<RimPlace<D>> Solver<D>::rim_places() const {
  const auto kind = on_host(particles_.integer("kind"));
  std::vector<RimPlace<D>> places;
  for_each_place(geometry_.x, particles_.size(), [&](int i, const Point& p) {
    const Beside side = kind(i) > 0 ? beside(scene_, p) : Beside{};
    if (side.opening < 0) return;
    const double width = side.outside < scene_.water.spacing ? scene_.water.spacing : 0.0;
    RimPlace<D> place{i, side.opening, side.outside, D == 2 ? width : width / scene_.water.spacing, {}};
    place.n.x = side.n[0];
    if constexpr (D == 2) place.n.y = side.n[1];
    places.push_back(place);
  });
  return places;
}

template <int D>
void Solver<D>::build_openings() {
  if (scene_.boundaries.empty()) return;
  std::vector<LawInTime> laws;
  for (const OpenBoundary& boundary : scene_.boundaries) laws.push_back(law_in_time(boundary));
  open_.emplace(std::move(laws), rim_places(), traced());
}

template <int D>
TracedWater<D> Solver<D>::traced() const {
  return {order_.rows(), geometry_.x, water(), g_n2_, scene_.gravity, scene_.water.spacing};
}

template <int D>
Swarm<D> Solver<D>::swarm() const {
  const FieldSet& f = particles_;
  const Vec<double, D> like;
  const bool remembers = f.has("u_before");
  return {order_.rows(), vector_field(f, "x", "y", like), vector_field(f, "u", "v", like),
          remembers ? vector_field(f, "u_before", "v_before", like) : VecField<double, D>{}, f.real("depth"), f.real("mass"),
          bed_ ? f.real("bed") : Field<double>(), f.real("h"), f.integer("id"), f.integer("kind"), drag_};
}

template <int D>
Water<D> Solver<D>::water() const {
  return {particles_.real("depth"), level_of_bed_, vector_field(particles_, "u", "v", Vec<double, D>{})};
}

template <int D>
SortedWater<D> Solver<D>::sorted_water() const {
  const FieldSet& f = particles_;
  const Vec<double, D> dimension;
  return {order_.rows(), vector_field(f, "x", "y", dimension), vector_field(f, "u", "v", dimension), f.real("mass"), f.real("depth"),
          f.real("h"), f.integer("kind")};
}

template class Solver<1>;
template class Solver<2>;

}  // namespace freshet::sisph
