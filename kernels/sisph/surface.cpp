#include "kernels/sisph/surface.hpp"

#include <cmath>

namespace freshet::sisph {
namespace {

KOKKOS_FORCEINLINE_FUNCTION double sum_of(const Lanes& me, Lane a) {
  double total = 0;
  for (int l = 0; l < me.count; ++l) total += lane_of(a, l);
  return total;
}

// The depth of what runs up onto dry land: the water that half its velocity head lifts above the higher bed, at most that at the
// pair's middle. Without it a front stands before every particle that is dry until the water is as high as that particle's bed.
KOKKOS_FORCEINLINE_FUNCTION Lane run_up_depth(Lane depth, Lane bed, Lane dry_bed, Lane half_head) {
  const Lane lifted = bed + depth + half_head - dry_bed, middle = depth + 0.5 * (bed - dry_bed);
  return larger(smaller(lifted, middle), Lane(0.0));
}

// a, f, b, the row sums, the residual of the iterate and the share of its outflow f that a particle has water for; returns the
// slice's parts of |r|^2 and |b|^2, and how many of its particles would give more than they have.
template <int D, bool drying, bool dragged>
struct Coefficients {
  Geometry<D> g;
  SliceList active;
  Water<D> water;
  VecField<double, D> before;
  Field<double> last_depth, level;                 // of the Picard pass before
  Field<double> drag;                              // dt gamma
  Field<double> a, flux, right, residual, row_sum, share;  // written
  double stiffness, dt, gravity;                   // g theta^2 dt^2

  // The depth that f is carried in, vn its velocity from i to j.
  KOKKOS_FORCEINLINE_FUNCTION Lane carried_depth(Lane hi, Lane hj, Lane bi, Lane bj, Lane vn) const {
    const Lane still = face_depth<drying>(hi, hj, bi, bj);
    if constexpr (!drying) return still;
    const auto outward = Lane(0.0) < vn;
    const Lane giver = select(outward, hi, hj), taker = select(outward, hj, hi), half_head = (0.25 / gravity) * vn * vn;
    const Lane up = run_up_depth(giver, select(outward, bi, bj), select(outward, bj, bi), half_head);
    return larger(still, select((Lane(0.0) < giver) & !(Lane(0.0) < taker), up, Lane(0.0)));
  }

  KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, D> pair_velocity(const Vec<Lane, D>& vi, const Vec<Lane, D>& vj, Lane hi, Lane hj) const {
    if constexpr (!drying) return Lane(0.5) * (vi + vj);
    const Lane per = 1.0 / (hi + hj + 1e-300);
    return (hi * per) * vi + (hj * per) * vj;
  }

  KOKKOS_FUNCTION Kokkos::Array<double, 3> operator()(int k) const {
    const int s = active(k);
    const Lanes me = g.pairs(s);
    const Vec<Lane, D> vi = me.load(before);
    const Lane hi = me.load(water.depth), li = larger(me.load(last_depth), Lane(0.0)), bi = me.load(water.bed), eta = me.load(level);
    Lane outflow(0.0), given(0.0), sum_a(0.0), drawn(0.0), drag_i(0.0);
    if constexpr (dragged) drag_i = me.load(drag);
    g.pairs.for_each(s, [&](int e, PairIndex j) {
      const Lane hj = gather(water.depth.data(), j), lj = larger(gather(last_depth.data(), j), Lane(0.0));
      const Lane bj = drying ? gather(water.bed.data(), j) : Lane(0.0);
      const Lane face = 0.5 * (face_depth<drying>(hi, hj, bi, bj) + face_depth<drying>(li, lj, bi, bj));
      const Lane vn = dot(pair_velocity(vi, gather(before, j), hi + li, hj + lj), PairView::load(g.n, e));
      const Lane carried = 0.5 * (carried_depth(hi, hj, bi, bj, vn) + carried_depth(li, lj, bi, bj, vn));
      const Lane area = PairView::load(g.area, e), f = area * carried * vn;
      Lane aij = stiffness * area * face / PairView::load(g.distance, e);
      if constexpr (dragged) aij = aij / (1.0 + 0.5 * (drag_i + gather(drag.data(), j)));
      PairView::store(flux, e, f);
      PairView::store(a, e, aij);
      outflow += f;
      given += larger(f, Lane(0.0));
      sum_a += aij;
      drawn += aij * (gather(level.data(), j) - eta);
    });
    const Lane omega = me.load(g.omega), free = free_lanes(g, me);
    const Lane has = omega * hi, wanted = dt * given, overdrawn = select(has < free * wanted, Lane(1.0), Lane(0.0));
    const Lane b = has - dt * outflow, r = free * (b + drawn - omega * larger(eta - bi, Lane(0.0)));
    me.store(right, b);
    me.store(row_sum, sum_a);
    me.store(residual, r);
    me.store(share, select(Lane(0.5) < overdrawn, has / (wanted + 1e-300), Lane(1.0)));
    return {{sum_of(me, r * r), sum_of(me, free * b * b), sum_of(me, overdrawn)}};
  }
};

// Scales f by the donor's share, so that b >= 0: else a film that runs off has to be held by a surface far below the bed, which
// costs CG and Newton many iterations. Returns the slice's parts of |r|^2 and |b|^2.
template <int D>
struct LimitOutflow {
  Geometry<D> g;
  SliceList active;
  Field<double> depth, share, flux, right, residual;
  double dt;

  KOKKOS_FUNCTION Kokkos::Array<double, 2> operator()(int k) const {
    const int s = active(k);
    const Lanes me = g.pairs(s);
    const Lane mine = me.load(share), free = free_lanes(g, me);
    Lane outflow(0.0);
    g.pairs.for_each(s, [&](int e, PairIndex j) {
      const Lane f = PairView::load(flux, e), limited = f * select(Lane(0.0) < f, mine, gather(share.data(), j));
      PairView::store(flux, e, limited);
      outflow += limited;
    });
    const Lane b = me.load(g.omega) * me.load(depth) - dt * outflow, r = me.load(residual) + free * (b - me.load(right));
    me.store(right, b);
    me.store(residual, r);
    return {{sum_of(me, r * r), sum_of(me, free * b * b)}};
  }
};

// y = (P + T) x; returns the slice's part of x . y.
template <int D>
struct Product {
  Geometry<D> g;
  SliceList active;
  Field<double> a, diagonal, x, y;

  KOKKOS_FUNCTION Kokkos::Array<double, 1> operator()(int k) const {
    const int s = active(k);
    const Lanes me = g.pairs(s);
    const Lane xi = me.load(x);
    const Lane row = free_lanes(g, me) * (me.load(diagonal) * xi - g.pairs.weighted_sum(s, a, x));
    me.store(y, row);
    return {{sum_of(me, xi * row)}};
  }
};

// The depth from the fluxes, b - T eta = omega H, and the residual against V(eta); returns the slice's part of |r|^2.
template <int D>
struct Residual {
  Geometry<D> g;
  SliceList active;
  Field<double> a, level, bed, right, row_sum, depth, residual;

  KOKKOS_FUNCTION Kokkos::Array<double, 1> operator()(int k) const {
    const int s = active(k);
    const Lanes me = g.pairs(s);
    const Lane eta = me.load(level), omega = me.load(g.omega), free = free_lanes(g, me);
    Lane drawn(0.0);
    g.pairs.for_each(s, [&](int e, PairIndex j) { drawn += PairView::load(a, e) * (gather(level.data(), j) - eta); });
    const Lane volume = me.load(right) + drawn;
    const Lane r = free * (volume - omega * larger(eta - me.load(bed), Lane(0.0)));
    me.store(depth, select(Lane(0.5) < free, volume / omega, me.load(depth)));
    me.store(residual, r);
    return {{sum_of(me, r * r)}};
  }
};

// Every row solved for its own level, its neighbours' as they are.
template <int D>
struct LevelAlone {
  Geometry<D> g;
  SliceList active;
  Field<double> a, level, bed, right, row_sum, found;

  KOKKOS_FUNCTION void operator()(int k) const {
    const int s = active(k);
    const Lanes me = g.pairs(s);
    const Lane sum = me.load(row_sum), floor = me.load(bed);
    const Lane excess = me.load(right) + g.pairs.weighted_sum(s, a, level) - sum * floor;  // were its level the bed's
    const Lane slope = sum + select(Lane(0.0) < excess, me.load(g.omega), Lane(0.0));
    const auto tied = (Lane(0.0) < sum) & (Lane(0.5) < free_lanes(g, me));
    me.store(found, select(tied, floor + excess / (slope + 1e-300), me.load(level)));
  }
};

}  // namespace

template <int D>
FreeSurface<D>::FreeSurface(const Geometry<D>& g, const Rows& rows, const SurfaceOptions& options)
    : g_(g), rows_(rows), options_(options) {
  const size_t pair_values = g.pairs.j.extent(0);
  a_ = Field<double>("sisph.a", pair_values);
  flux_ = Field<double>("sisph.flux", pair_values);
  for (Field<double>* f : {&level_, &depth_, &right_, &residual_, &change_, &row_sum_, &diagonal_, &inverse_, &share_})
    *f = Field<double>("sisph.surface", static_cast<size_t>(g.pairs.particles) + lanes);
  cg_.resize(g.pairs.particles);
}

template <int D>
void FreeSurface<D>::set_meshed(bool on) {
  mesh_on_ = on;
  if (!on || mesh_) return;
  mesh_.emplace();
  mesh_->lay(rows_, g_.x);
  for (Field<double>* f : {&wet_, &mesh_depth_}) *f = Field<double>("sisph.mesh", static_cast<size_t>(g_.pairs.particles) + lanes);
}

template <int D>
const Field<double>& FreeSurface<D>::make_drag() {
  if (drag_.extent(0) == 0) drag_ = Field<double>("sisph.drag", static_cast<size_t>(g_.pairs.particles) + lanes);
  return drag_;
}

template <int D>
void FreeSurface<D>::start(const Water<D>& water) {
  const Field<double> level = level_, depth = depth_, residual = residual_, inverse = inverse_, share = share_;
  const Water<D> w = water;
  first_ = true;
  Kokkos::parallel_for("sisph::start_surface", Range(0, g_.pairs.particles), KOKKOS_LAMBDA(int i) {
        depth(i) = w.depth(i);
        level(i) = w.bed(i) + w.depth(i);
        residual(i) = 0;
        inverse(i) = 0;
        share(i) = 1;
      });
}

template <int D>
template <bool drying, bool dragged>
typename FreeSurface<D>::Norms FreeSurface<D>::find_coefficients(const SliceList& active, const Water<D>& water,
                                                                 const VecField<double, D>& before, double dt) {
  const double stiffness = options_.gravity * options_.theta * options_.theta * dt * dt;
  const Coefficients<D, drying, dragged> pass{g_, active, water, before, depth_, level_, drag_, a_, flux_, right_, residual_,
                                              row_sum_, share_, stiffness, dt, options_.gravity};
  g_.images.fill(before);
  const auto sums = sums_.sum<3>("sisph::coefficients", active.count, pass);
  if (!drying || sums[2] == 0) return {std::sqrt(sums[0]), std::sqrt(sums[1])};
  const auto limited = sums_.sum<2>("sisph::limit_outflow", active.count,
                                    LimitOutflow<D>{g_, active, water.depth, share_, flux_, right_, residual_, dt});
  return {std::sqrt(limited[0]), std::sqrt(limited[1])};
}

template <int D>
double FreeSurface<D>::find_residual(const SliceList& active, const Water<D>& water) {
  return std::sqrt(sums_.sum<1>("sisph::residual", active.count,
                                Residual<D>{g_, active, a_, level_, water.bed, right_, row_sum_, depth_, residual_})[0]);
}

// P + sum_j a_ij and its inverse; rows without any are left out.
template <int D>
void FreeSurface<D>::set_diagonal(const SliceList& active, const Water<D>& water, bool all_wet) {
  const Geometry<D> g = g_;
  const Field<double> level = level_, bed = water.bed, row_sum = row_sum_, diagonal = diagonal_, inverse = inverse_;
  Kokkos::parallel_for("sisph::diagonal", Range(0, active.count), KOKKOS_LAMBDA(int k) {
        const Lanes me = g.pairs(active(k));
        const Lane wet = select(me.load(bed) < me.load(level), Lane(1.0), Lane(all_wet ? 1.0 : 0.0));
        const Lane sum = me.load(row_sum) + wet * me.load(g.omega);
        me.store(diagonal, sum);
        me.store(inverse, select(Lane(0.0) < sum, free_lanes(g, me) / sum, Lane(0.0)));
      });
}

// The mesh of the rows that are wet; where a_ij vanishes with the water, so does its conductance.
template <int D>
void FreeSurface<D>::set_mesh(const SliceList& active, const Water<D>& water, double stiffness) {
  const Geometry<D> g = g_;
  const SliceList list = active;
  const Field<double> level = level_, bed = water.bed, depth = depth_, drag = drag_, wet = wet_, conducts = mesh_depth_;
  const bool dragged = drag.extent(0) > 0;
  linear::fill(g_.pairs.particles, 0.0, wet_);
  Kokkos::parallel_for("sisph::mesh_rows", Range(0, active.count), KOKKOS_LAMBDA(int k) {
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
int FreeSurface<D>::solve_linear(const SliceList& active, const Water<D>& water, const linear::CgOptions& options, double stiffness) {
  const auto product = [&](const Field<double>& x, const Field<double>& y) {
    return sums_.sum<1>("sisph::product", active.count, Product<D>{g_, active, a_, diagonal_, x, y})[0];
  };
  if (!mesh_on_) return cg_.solve(product, linear::Jacobi{inverse_}, residual_, change_, options).iterations;
  set_mesh(active, water, stiffness);
  return cg_.solve(product, linear::JacobiPlus<linear::ParticleMesh<D>>{inverse_, *mesh_}, residual_, change_, options).iterations;
}

// A film of 1e-20 m that only films touch has a row so small that no tolerance of CG settles its level; kilometres above the bed it
// would be wet for Newton's method and undo the rest, again and again. This step keeps iterates on the side of the solution where
// Newton's are, so that their convergence is monotone still.
template <int D>
void FreeSurface<D>::level_rows(const SliceList& active, const Water<D>& water) {
  Kokkos::parallel_for("sisph::level_alone", Range(0, active.count),
                       LevelAlone<D>{g_, active, a_, level_, water.bed, right_, row_sum_, change_});
  const PairView pairs = g_.pairs;
  const Field<double> level = level_, found = change_;
  const SliceList list = active;
  Kokkos::parallel_for("sisph::take_level", Range(0, active.count), KOKKOS_LAMBDA(int k) {
        const Lanes me = pairs(list(k));
        me.store(level, me.load(found));
      });
}

template <int D>
SurfaceReport FreeSurface<D>::solve(const SliceList& active, const Water<D>& water, const VecField<double, D>& before, double dt,
                                    bool drying) {
  const Region region("sisph::free_surface");
  const bool dragged = drag_.extent(0) > 0;
  const Norms norms = drying ? dragged ? find_coefficients<true, true>(active, water, before, dt)
                                       : find_coefficients<true, false>(active, water, before, dt)
                      : dragged ? find_coefficients<false, true>(active, water, before, dt)
                                : find_coefficients<false, false>(active, water, before, dt);
  // Asked for no less than round-off of |b|: water at rest needs no iteration.
  constexpr double round_off = 1e-14;
  const double least = round_off / smaller(options_.cg_tolerance, options_.newton_tolerance);
  if (first_) scale_ = larger(norms.residual, least * norms.right + 1e-300);
  bool first_solve = first_;
  first_ = false;
  const double stiffness = options_.gravity * options_.theta * options_.theta * dt * dt;
  const double scale = scale_, settled = 2 * options_.newton_tolerance;  // CG's own tolerance and as much again
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
    if (iterations > options_.mesh_from || (mesh_on_ && first_solve)) set_meshed(iterations > options_.mesh_until);
    first_solve = false;
    ++report.newton;
    Kokkos::parallel_for("sisph::move_surface", Range(0, g_.pairs.particles), KOKKOS_LAMBDA(int i) { level(i) += change(i); });
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
