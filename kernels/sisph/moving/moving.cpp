#include "kernels/sisph/moving/moving.hpp"

#include <algorithm>
#include <cmath>

#include "cellgrid/parallel/assign.hpp"
#include "cellgrid/parallel/launch.hpp"
#include "kernels/sisph/moving/moving_loops.hpp"

namespace freshet::sisph {
namespace {

Field<double> scalar(int n) { return Field<double>("sisph.moving", static_cast<size_t>(n) + lanes); }

SymField<double, 1> matrices(int n, Vec<double, 1>) { return {scalar(n)}; }
SymField<double, 2> matrices(int n, Vec<double, 2>) { return {scalar(n), scalar(n), scalar(n)}; }

// Room for so many values; those that there are stay.
void make_longer(VecField<double, 1>& v, int n) {
  const Field<double> old = v.x, longer = scalar(n);
  const auto kept = std::make_pair(size_t{0}, old.extent(0));
  Kokkos::deep_copy(Kokkos::subview(longer, kept), old);
  v.x = longer;
}
void make_longer(VecField<double, 2>& v, int n) {
  VecField<double, 1> x{v.x}, y{v.y};
  make_longer(x, n);
  make_longer(y, n);
  v = {x.x, y.x};
}

// The bed's level at a place.
template <int D>
KOKKOS_FORCEINLINE_FUNCTION double level_at(const BedSpline<D>& bed, const Vec<double, D>& place) {
  return bed.sloped_at(place).b;
}

}  // namespace

template <int D>
MovingWater<D>::MovingWater(int particles, const AnyKernel<D>& kernel, const MirrorWalls<D>& walls,
                            const MovingOptions& options)
    : options_(options), shapes_{kernel, {}, options.held_moment, options.linear}, walls_(walls) {
  for (Field<double>* f : {&inertia_, &rise_, &last_, &level_, &change_, &correction_, &right_, &diagonal_,
                           &inverse_, &zero_, &g_.omega, &g_.moment, &g_.free})
    *f = scalar(particles);
  g_.inverse = matrices(particles, Vec<double, D>{});
  cg_.resize(particles);
}

// By how much two particles approach in half a step, and a tenth of a spacing.
template <int D>
double MovingWater<D>::reach(double dt, double jump) const {
  return 0.5 * dt * jump + 0.1 * options_.spacing;
}

// Rows get longer and shorter, so the number of slices changes.
template <int D>
void MovingWater<D>::visit_all(int slices) {
  g_.slices.count = slices;
  if (g_.slices.list.extent_int(0) >= slices) return;
  const Field<int> all("sisph.slices", static_cast<size_t>(slices + slices / 8));
  launch(
      "sisph::number_slices", Range(0, all.extent_int(0)), KOKKOS_LAMBDA(int s) { all(s) = s; });
  g_.slices.list = all;
}

// Coefficients for all pairs and vectors for all images.
template <int D>
void MovingWater<D>::make_room() {
  if (g_.area.extent(0) < g_.pairs.j.extent(0)) {
    g_.n = pairs_.template vector_coefficient<D>("sisph.n");
    for (Field<double>* f : {&g_.distance, &g_.weight, &g_.area, &a_}) *f = pairs_.coefficient("sisph.pairs");
  }
  visit_all(g_.pairs.slices());
  const int wanted = g_.images.slots(), had = end_.x.extent_int(0) - lanes;
  if (had >= wanted) return;
  for (VecField<double, D>* v : {&mixed_, &slope_, &end_, &g_.x, &gradient_.u})
    make_longer(*v, wanted + g_.images.count / 4);
  if (D == 2) make_longer(gradient_.v, wanted + g_.images.count / 4);
}

// Pairs that may be within each other's support as long as they approach by less than the skin [m].
template <int D>
void MovingWater<D>::list_pairs(const Swarm<D>& now, double skin) {
  const TimedRegion region("sisph::list_pairs");
  const int n = g_.omega.extent_int(0) - lanes;
  shapes_.h = now.h;
  skin_ = skin;
  const PairRequest<D> request{now.rows, now.x, now.h, options_.support + skin / options_.h};
  list_wall_pairs<D>(n, request, walls_, pairs_, image_lists_);
  g_.images = image_lists_.images;
  g_.pairs = pairs_.view();
  rows_ = now.rows;
  listed_ = freshet::sisph::place_images<D>(n, request, walls_, image_lists_);
  make_room();
}

// The first pass takes the end of the step to be as its start.
template <int D>
void MovingWater<D>::start(const Swarm<D>& now) {
  const Swarm<D> at_n = now;
  const VecField<double, D> end = end_;
  const Field<double> last = last_, change = change_, free = g_.free;
  launch(
      "sisph::start_step", Range(0, g_.pairs.particles), KOKKOS_LAMBDA(int i) {
        put(end, i, at(at_n.v, i));
        last(i) = at_n.depth(i);
        change(i) = 0;
        free(i) = at_n.kind(i) > 0 ? 0.0 : 1.0;
      });
}

// x at the middle of the step; H_m and what follows from it; the bed at the end of the path.
template <int D>
void MovingWater<D>::place(const Swarm<D>& now, const BedSpline<D>* bed, const PathWeights& path, double dt) {
  const Swarm<D> at_n = now;
  const PathWeights w = path;
  const Geometry<D> g = g_;
  const VecField<double, D> end = end_;
  const Field<double> last = last_, inertia = inertia_, rise = rise_;
  launch(
      "sisph::place_midway", Range(0, g.pairs.particles), KOKKOS_LAMBDA(int i) {
        const double mid = 0.5 * (at_n.depth(i) + last(i));
        put(g.x, i, at(at_n.x, i) + (0.5 * dt) * (w.half_start * at(at_n.v, i) + w.half_end * at(end, i)));
        g.omega(i) = at_n.mass(i) / mid;
        inertia(i) = at_n.mass(i) / (mid * mid);
      });
  place_images(now);
  if (!bed) return;
  const BedSpline<D> ground = *bed;
  const bool remembers = at_n.before.x.extent(0) > 0;
  launch(
      "sisph::rise_of_bed", Range(0, g.pairs.particles), KOKKOS_LAMBDA(int i) {
        Vec<double, D> to = at(at_n.x, i) + dt * (w.start * at(at_n.v, i) + w.end * at(end, i));
        if (remembers) to += (dt * w.before) * at(at_n.before, i);
        rise(i) = level_at(ground, to) - at_n.bed(i);
      });
}

// Images move as their particles do, reflected: pairs keep |x_i - x_j'| = |x_j - x_i'|.
template <int D>
void MovingWater<D>::place_images(const Swarm<D>& now) {
  if (g_.images.count == 0) return;
  const Images<D> images = g_.images;
  const VecField<double, D> from = listed_, x = now.x, to = g_.x;
  launch(
      "sisph::move_images", Range(0, images.count), KOKKOS_LAMBDA(int k) {
        const int slot = images.first + k, j = images.source(k);
        put(to, slot, at(from, slot) + images.of(images.reflection, k) * (at(to, j) - at(x, j)));
      });
}

// eta_th. Beside the domain depths stay: the surface goes up and down with the bed.
template <int D>
void MovingWater<D>::find_levels(const Swarm<D>& now) {
  const Swarm<D> at_n = now;
  const Field<double> bed = now.bed.extent(0) > 0 ? now.bed : zero_, level = level_, change = change_,
                      rise = rise_, free = g_.free;
  const double theta = options_.theta;
  launch(
      "sisph::levels", Range(0, g_.pairs.particles), KOKKOS_LAMBDA(int i) {
        if (free(i) < 0.5) change(i) = rise(i);
        level(i) = bed(i) + at_n.depth(i) + theta * change(i);
      });
}

template <int D>
double MovingWater<D>::find_jump(const VecField<double, D>& v) {
  g_.images.fill(v);
  double most = 0;
  Kokkos::parallel_reduce("sisph::jump", Range(0, g_.slices.count), LargestJump<D>{g_, v},
                          Kokkos::Max<double>(most));
  return std::sqrt(most);
}

template <int D>
double MovingWater<D>::find_least_depth() {
  const Field<double> last = last_;
  double least = 0;
  Kokkos::parallel_reduce(
      "sisph::shallowest", Range(0, g_.pairs.particles),
      KOKKOS_LAMBDA(int i, double& m) { m = smaller(m, last(i)); }, Kokkos::Min<double>(least));
  return least;
}

template <int D>
void MovingWater<D>::measure_jump(const Swarm<D>& now) {
  list_pairs(now, 0);
  start(now);
  jump_ = find_jump(end_);
}

template <int D>
MovingReport MovingWater<D>::attempt(const Swarm<D>& now, const BedSpline<D>* bed, const PathWeights& path,
                                     double dt) {
  MovingReport report;
  list_pairs(now, reach(dt, jump_));
  followers_.locate(g_.pairs.particles, now.id);
  laid_ = false;
  start(now);
  for (int pass = 0; pass < options_.picard; ++pass) {
    const double fastest = std::max(jump_, report.jump);
    if (reach(dt, fastest) > skin_ + 0.1 * options_.spacing) list_pairs(now, reach(dt, 1.2 * fastest));
    place(now, bed, path, dt);
    measure_again(g_, shapes_);
    find_levels(now);
    predict(now, dt);
    solve_increment(now, dt, report);
    if (!report.solved) return report;
    correct(now, dt);
    if (pass + 1 == options_.picard) even_out(dt);
    report.jump = find_jump(end_);
    report.least_depth = find_least_depth();
    if (!report.holds()) return report;
  }
  tried_ = report.jump;
  return report;
}

template <int D>
void MovingWater<D>::arrive(const Swarm<D>& now, const BedSpline<D>* bed, const PathWeights& path,
                            double dt) {
  const Swarm<D> at_n = now;
  const PathWeights w = path;
  const VecField<double, D> end = end_;
  const Field<double> last = last_, free = g_.free;
  const bool remembers = at_n.before.x.extent(0) > 0;
  launch(
      "sisph::arrive", Range(0, g_.pairs.particles), KOKKOS_LAMBDA(int i) {
        const Vec<double, D> v = at(at_n.v, i);
        Vec<double, D> to = at(at_n.x, i) + dt * (w.start * v + w.end * at(end, i));
        if (remembers) {
          to += (dt * w.before) * at(at_n.before, i);
          put(at_n.before, i, v);
        }
        put(at_n.x, i, to);
        put(at_n.v, i, at(end, i));
        if (free(i) > 0.5) at_n.depth(i) = last(i);
      });
  jump_ = tried_;
  if (!bed) return;
  const BedSpline<D> ground = *bed;
  launch(
      "sisph::find_bed", Range(0, g_.pairs.particles),
      KOKKOS_LAMBDA(int i) { at_n.bed(i) = level_at(ground, at(at_n.x, i)); });
}

template class MovingWater<1>;
template class MovingWater<2>;

}  // namespace freshet::sisph
