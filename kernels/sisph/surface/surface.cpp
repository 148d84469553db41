#include "kernels/sisph/surface/surface.hpp"

#include <cmath>

#include "cellgrid/parallel/launch.hpp"
#include "kernels/sisph/surface/surface_loops.hpp"

namespace freshet::sisph {

template <int D>
FreeSurface<D>::FreeSurface(const Geometry<D>& g, const Rows& rows, const SurfaceOptions& options,
                            const std::optional<PairSource<D>>& source)
    : g_(g), rows_(rows), options_(options) {
  const size_t pair_values = g.pairs.j.extent(0);
  flux_ = Field<double>("sisph.flux", pair_values);
  if (source) take_source(*source);
  else pairs_ = linear::StoredPairs{Field<double>("sisph.a", pair_values)};
  for (Field<double>* f :
       {&level_, &depth_, &right_, &residual_, &change_, &row_sum_, &diagonal_, &inverse_, &share_})
    *f = Field<double>("sisph.surface", static_cast<size_t>(g.pairs.particles) + lanes);
  cg_.resize(g.pairs.particles);
}

template <int D>
void FreeSurface<D>::take_source(const PairSource<D>& source) {
  const auto particles = static_cast<size_t>(g_.pairs.particles) + lanes;
  const int slots = g_.images.slots();
  const bool closed = source.lambda.extent(0) > 0;
  const Field<double> lambda =
      closed ? source.lambda : Field<double>("sisph.lambda", static_cast<size_t>(D * slots) + lanes);
  kernel_ = source.kernel;
  for (Field<double>* f : {&places_.per_moment, &held_depth_, &held_last_})
    *f = Field<double>("sisph.held", particles);
  places_.inv_h = 1 / source.h;
  places_.x = g_.x;
  places_.lambda = parts(lambda, slots, Vec<double, D>{});
  places_.omega = g_.omega;
  const Field<double> moment = g_.moment, per = places_.per_moment;
  launch(
      "sisph::per_moment", Range(0, g_.pairs.particles), KOKKOS_LAMBDA(int i) { per(i) = 1.0 / moment(i); });
}

// What coefficients that are not stored need of a pass: depths change while it is solved.
template <int D>
void FreeSurface<D>::hold_depths(const Layer<D>& water, bool drying) {
  const Field<double> now = water.depth, last = depth_, held_depth = held_depth_, held_last = held_last_;
  launch(
      "sisph::hold_depths", Range(0, g_.pairs.particles), KOKKOS_LAMBDA(int i) {
        const double before = larger(last(i), 0.0);
        held_depth(i) = drying ? now(i) : 0.5 * (now(i) + before);
        held_last(i) = before;
      });
}

template <int D>
template <bool drying>
AnyPairs<D> FreeSurface<D>::recomputed(const Layer<D>& water, double stiffness) const {
  const Holdings<drying> held{held_depth_, held_last_, water.bed, drag_, drag_.extent(0) > 0};
  return std::visit(
      [&](const auto& kernel) -> AnyPairs<D> {
        return RecomputedPairs<D, std::decay_t<decltype(kernel)>, drying>{kernel, places_, held, stiffness};
      },
      *kernel_);
}

template <int D>
void FreeSurface<D>::set_meshed(bool on) {
  mesh_on_ = on;
  if (!on || mesh_) return;
  mesh_.emplace();
  mesh_->lay(rows_, g_.x, g_.pairs.particles);
  for (Field<double>* f : {&wet_, &mesh_depth_})
    *f = Field<double>("sisph.mesh", static_cast<size_t>(g_.pairs.particles) + lanes);
}

template <int D>
const Field<double>& FreeSurface<D>::make_drag() {
  if (drag_.extent(0) == 0)
    drag_ = Field<double>("sisph.drag", static_cast<size_t>(g_.pairs.particles) + lanes);
  return drag_;
}

template <int D>
void FreeSurface<D>::start(const Layer<D>& water) {
  const Field<double> level = level_, depth = depth_, residual = residual_, inverse = inverse_,
                      share = share_;
  const Layer<D> w = water;
  first_ = true;
  launch(
      "sisph::start_surface", Range(0, g_.pairs.particles), KOKKOS_LAMBDA(int i) {
        depth(i) = w.depth(i);
        level(i) = w.bed(i) + w.depth(i);
        residual(i) = 0;
        inverse(i) = 0;
        share(i) = 1;
      });
}

template <int D>
template <bool drying>
typename FreeSurface<D>::Norms FreeSurface<D>::find_coefficients(const SliceList& active,
                                                                 const Layer<D>& water,
                                                                 const VecField<double, D>& before,
                                                                 double dt) {
  const double stiffness = options_.gravity * options_.theta * options_.theta * dt * dt;
  g_.images.fill(before);
  const auto visit = [&](const auto& stored, const Field<double>& a) {
    const PairCoefficients<D, drying, std::decay_t<decltype(stored)>::value> pass{g_,
                                                                                  active,
                                                                                  water,
                                                                                  before,
                                                                                  depth_,
                                                                                  level_,
                                                                                  drag_,
                                                                                  a,
                                                                                  flux_,
                                                                                  right_,
                                                                                  residual_,
                                                                                  row_sum_,
                                                                                  share_,
                                                                                  stiffness,
                                                                                  dt,
                                                                                  options_.gravity,
                                                                                  drag_.extent(0) > 0};
    return sum_of_slices<3>("sisph::coefficients", active.count, pass);
  };
  if (kernel_) {
    hold_depths(water, drying);
    pairs_ = recomputed<drying>(water, stiffness);
  }
  const auto sums = kernel_ ? visit(std::false_type{}, {})
                            : visit(std::true_type{}, std::get<linear::StoredPairs>(pairs_).a);
  if (!drying || sums[2] == 0) return {std::sqrt(sums[0]), std::sqrt(sums[1])};
  const auto limited =
      sum_of_slices<2>("sisph::limit_outflow", active.count,
                       LimitOutflow<D>{g_, active, water.depth, share_, flux_, right_, residual_, dt});
  return {std::sqrt(limited[0]), std::sqrt(limited[1])};
}

template <int D>
double FreeSurface<D>::find_residual(const SliceList& active, const Layer<D>& water) {
  return std::visit(
      [&](const auto& a) {
        const Residual<D, std::decay_t<decltype(a)>> pass{g_,        active, a,      level_,
                                                          water.bed, right_, depth_, residual_};
        return std::sqrt(sum_of_slices<1>("sisph::residual", active.count, pass)[0]);
      },
      pairs_);
}

// P + sum_j a_ij and its inverse; rows without any are left out.
template <int D>
void FreeSurface<D>::set_diagonal(const SliceList& active, const Layer<D>& water, bool all_wet) {
  const Geometry<D> g = g_;
  const Field<double> level = level_, bed = water.bed, row_sum = row_sum_, diagonal = diagonal_,
                      inverse = inverse_;
  launch(
      "sisph::diagonal", Range(0, active.count), KOKKOS_LAMBDA(int k) {
        const Lanes me = g.pairs(active(k));
        const Lane wet = select(me.load(bed) < me.load(level), Lane(1.0), Lane(all_wet ? 1.0 : 0.0));
        const Lane sum = me.load(row_sum) + wet * me.load(g.omega);
        me.store(diagonal, sum);
        me.store(inverse, select(Lane(0.0) < sum, free_lanes(g, me) / sum, Lane(0.0)));
      });
}

// The mesh of the rows that are wet; where a_ij vanishes with the water, so does its conductance.
template <int D>
void FreeSurface<D>::set_mesh(const SliceList& active, const Layer<D>& water, double stiffness) {
  const Geometry<D> g = g_;
  const SliceList list = active;
  const Field<double> level = level_, bed = water.bed, depth = depth_, drag = drag_, wet = wet_,
                      conducts = mesh_depth_;
  const bool dragged = drag.extent(0) > 0;
  linear::fill(g_.pairs.particles, 0.0, wet_);
  launch(
      "sisph::mesh_rows", Range(0, active.count), KOKKOS_LAMBDA(int k) {
        const Lanes me = g.pairs(list(k));
        Lane deep = larger(me.load(depth), Lane(0.0));
        if (dragged) deep = deep / (1.0 + me.load(drag));
        me.store(wet, free_lanes(g, me) * select(me.load(bed) < me.load(level), me.load(g.omega), Lane(0.0)));
        me.store(conducts, deep);
      });
  mesh_->set(wet_, mesh_depth_, stiffness);
}

// change := (P + T)^-1 residual; returns the iterations.
template <int D>
int FreeSurface<D>::solve_linear(const SliceList& active, const Layer<D>& water,
                                 const linear::CgOptions& options, double stiffness) {
  const auto product = [&](const Field<double>& x, const Field<double>& y) {
    return std::visit(
        [&](const auto& a) {
          using Product = linear::PairProduct<SliceList, std::decay_t<decltype(a)>>;
          return sum_of_slices<1>("sisph::product", active.count,
                                  Product{g_.pairs, active, a, diagonal_, g_.free, x, y})[0];
        },
        pairs_);
  };
  if (!mesh_on_) return cg_.solve(product, linear::Jacobi{inverse_}, residual_, change_, options).iterations;
  set_mesh(active, water, stiffness);
  return cg_
      .solve(product, linear::JacobiPlus<linear::ParticleMesh<D>>{inverse_, *mesh_}, residual_, change_,
             options)
      .iterations;
}

// A film of 1e-20 m that only films touch has a row so small that no tolerance of CG settles its level;
// kilometres above the bed it would be wet for Newton's method and undo the rest, again and again. This step
// keeps iterates on the side of the solution where Newton's are, so that their convergence is monotone still.
template <int D>
void FreeSurface<D>::level_rows(const SliceList& active, const Layer<D>& water) {
  std::visit(
      [&](const auto& a) {
        const LevelAlone<D, std::decay_t<decltype(a)>> pass{g_,        active, a,        level_,
                                                            water.bed, right_, row_sum_, change_};
        launch("sisph::level_alone", Range(0, active.count), pass);
      },
      pairs_);
  const PairView pairs = g_.pairs;
  const Field<double> level = level_, found = change_;
  const SliceList list = active;
  launch(
      "sisph::take_level", Range(0, active.count), KOKKOS_LAMBDA(int k) {
        const Lanes me = pairs(list(k));
        me.store(level, me.load(found));
      });
}

template <int D>
SurfaceReport FreeSurface<D>::solve(const SliceList& active, const Layer<D>& water,
                                    const VecField<double, D>& before, double dt, bool drying) {
  const TimedRegion region("sisph::free_surface");
  const Norms norms = drying ? find_coefficients<true>(active, water, before, dt)
                             : find_coefficients<false>(active, water, before, dt);
  // Asked for no less than round-off of |b|: water at rest needs no iteration.
  constexpr double round_off = 1e-14;
  const double least = round_off / smaller(options_.cg_tolerance, options_.newton_tolerance);
  if (first_) scale_ = larger(norms.residual, least * norms.right + 1e-300);
  bool first_solve = first_;
  first_ = false;
  const double stiffness = options_.gravity * options_.theta * options_.theta * dt * dt;
  const double scale = scale_,
               settled = 2 * options_.newton_tolerance;  // CG's own tolerance and as much again
  linear::CgOptions cg;
  cg.tolerance = options_.cg_tolerance;
  cg.max_iterations = options_.cg_most;
  cg.scale = scale;
  SurfaceReport report;
  report.residual = norms.residual / scale;
  const Field<double> level = level_, change = change_;
  for (bool all_wet = true; report.newton < options_.newton_most; all_wet = false) {
    set_diagonal(active, water, all_wet);
    const int iterations = solve_linear(active, water, cg, stiffness);
    report.iterations += iterations;
    if (iterations > options_.mesh_from || (mesh_on_ && first_solve))
      set_meshed(iterations > options_.mesh_until);
    first_solve = false;
    ++report.newton;
    launch(
        "sisph::move_surface", Range(0, g_.pairs.particles), KOKKOS_LAMBDA(int i) { level(i) += change(i); });
    report.residual = find_residual(active, water) / scale;
    if (report.residual <= settled) return report;
    if (!drying) continue;
    level_rows(active, water);
    report.residual = find_residual(active, water) / scale;
    if (report.residual <= settled) return report;
  }
  report.converged = false;
  return report;
}

template class FreeSurface<1>;
template class FreeSurface<2>;

}  // namespace freshet::sisph
