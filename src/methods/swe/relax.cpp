#include "src/methods/swe/relax.hpp"

#include <cmath>
#include <optional>

#include "cellgrid/parallel/launch.hpp"
#include "src/errors.hpp"
#include "src/methods/swe/solver.hpp"

namespace freshet::swe {
namespace {

// The level of the scene's water where it is a lake at rest, to be relaxed over its own bed.
std::optional<double> lake_level(const Scene& scene) {
  if (!scene.water.surface || !scene.bed.elevation || scene.water.velocity[0] || scene.water.velocity[1])
    return {};
  const std::vector<Placed> cells = place(scene, scene.water.depth);
  const double level = scene.water.surface(cells[0].x[0], cells[0].x[1]);
  for (const Placed& cell : cells)
    if (std::abs(scene.water.surface(cell.x[0], cell.x[1]) - level) > 1e-9 * cell.depth) return {};
  return level;
}

Scene still_water(const Scene& scene, bool lake) {
  Scene still = scene;
  if (!lake) {
    still.bed = {};
    still.water.surface = {};
    still.water.velocity = {};
    still.water.depth = [](double, double) { return 1.0; };
  }
  // where the particles come to rest hangs on the tenth digit of their pressures
  still.sph.newton_tolerance = 1e-20;
  still.manning.reset();
  still.sph.well_balanced = false;
  LaxFriedrichs plain;
  if (const auto* muscl = std::get_if<LaxFriedrichsMuscl>(&scene.sph.stabilisation))
    plain.strength = muscl->strength;
  if (const auto* same = std::get_if<LaxFriedrichs>(&scene.sph.stabilisation)) plain = *same;
  still.sph.stabilisation = plain;
  return still;
}

// One step of the relaxation: v falls, and the masses follow the areas that the particles have, until every
// density is the depth there: level - bed, over a flat bed 1, and never below least [m], where a particle has
// run up a shore.
void settle(const FieldSet& fields, int dimension, double eta, double level, double least) {
  constexpr double slowing = 0.95, sharing = 0.05;
  const Field<double> u = fields.real("u"), v = fields.real(dimension == 2 ? "v" : "u");
  const Field<double> m = fields.real("mass"), rho = fields.real("depth"), h0 = fields.real("h0"),
                      kh = fields.real("kh");
  const Field<double> bed = fields.has("bed") ? fields.real("bed") : Field<double>();
  const bool plane = dimension == 2;
  launch(
      "swe::settle", Range(0, fields.size()), KOKKOS_LAMBDA(int i) {
        const double depth = larger(bed.extent(0) > 0 ? level - bed(i) : level, least);
        u(i) *= slowing;
        if (plane) v(i) *= slowing;
        m(i) *= 1 + sharing * (depth / rho(i) - 1);
        h0(i) = eta * (plane ? root(m(i) / depth) : m(i) / depth);
        kh(i) = m(i) * (plane ? eta * eta : eta);
      });
}

double fastest(const FieldSet& fields, int dimension) {
  const Field<double> u = fields.real("u"), v = fields.real(dimension == 2 ? "v" : "u");
  double most = 0;
  Kokkos::parallel_reduce(
      "swe::fastest", Range(0, fields.size()),
      KOKKOS_LAMBDA(int i, double& m) { m = larger(m, larger(::fabs(u(i)), ::fabs(v(i)))); },
      Kokkos::Max<double>(most));
  return most;
}

double deepest_of(const FieldSet& fields) {
  const Field<double> rho = fields.real("depth");
  double deepest = 0;
  Kokkos::parallel_reduce(
      "swe::deepest", Range(0, fields.size()), KOKKOS_LAMBDA(int i, double& d) { d = larger(d, rho(i)); },
      Kokkos::Max<double>(deepest));
  return deepest;
}

}  // namespace

template <int D>
std::vector<Placed> relaxed_lattice(const Scene& scene) {
  constexpr int most_steps = 2000;
  constexpr double still = 1e-5;  // of the celerity
  if (!scene.boundaries.empty())
    throw SceneError("water.start = \"relaxed\" needs a basin without open boundaries; use \"cells\"");
  const std::optional<double> lake = lake_level(scene);
  ExplicitSph<D> water(still_water(scene, lake.has_value()));
  const FieldSet& f = water.fields();
  const double level = lake.value_or(1.0), deepest = deepest_of(f);
  const double celerity = std::sqrt(scene.gravity * deepest);
  for (int n = 0; n < most_steps && (n < 10 || fastest(f, D) > still * celerity); ++n) {
    water.step(0, water.stable_dt());
    settle(f, D, scene.sph.eta, level, 1e-6 * deepest);
  }
  const std::optional<BedSpline<D>> bed = bed_spline<D>(scene, scene.domain);
  const auto x = on_host(f.real("x")), y = on_host(f.real(D == 2 ? "y" : "x")), m = on_host(f.real("mass"));
  std::vector<Placed> placed;
  for (int i = 0; i < f.size(); ++i) {
    const Point at{x(i), D == 2 ? y(i) : 0.0};
    const double d = initial_depth<D>(scene, bed, at), area = m(i) / (lake ? d : 1.0);
    if (!(d > 0)) throw SceneError("water.start = \"relaxed\" needs water all over the basin; use \"cells\"");
    const double side = D == 2 ? std::sqrt(area) : area;
    placed.push_back({at, d, area, scene.sph.eta * side, velocity_at(scene, at[0], at[1])});
  }
  return placed;
}

template std::vector<Placed> relaxed_lattice<1>(const Scene&);
template std::vector<Placed> relaxed_lattice<2>(const Scene&);

}  // namespace freshet::swe
