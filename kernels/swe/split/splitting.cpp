// Refinement: splitting.
#include <Kokkos_Sort.hpp>

#include "cellgrid/parallel/assign.hpp"
#include "cellgrid/parallel/launch.hpp"
#include "kernels/swe/split/refinement.hpp"
#include "kernels/water/ids.hpp"

namespace freshet::swe {
namespace {

KOKKOS_FORCEINLINE_FUNCTION void set_offset(Vec<double, 1>& v, const double* x) { v.x = x[0]; }
KOKKOS_FORCEINLINE_FUNCTION void set_offset(Vec<double, 2>& v, const double* x) { v.x = x[0], v.y = x[1]; }

// grad v . d with the symmetric part of grad v.
KOKKOS_FORCEINLINE_FUNCTION Vec<double, 1> stretched(const SymField<double, 1>& strain, int i,
                                                     const Vec<double, 1>& d) {
  return {strain.xx(i) * d.x};
}
KOKKOS_FORCEINLINE_FUNCTION Vec<double, 2> stretched(const SymField<double, 2>& strain, int i,
                                                     const Vec<double, 2>& d) {
  return {strain.xx(i) * d.x + strain.xy(i) * d.y, strain.xy(i) * d.x + strain.yy(i) * d.y};
}

// Where a value stands among n ascending ones.
KOKKOS_INLINE_FUNCTION int rank_in(const Field<int>& sorted, int n, int value) {
  int first = 0;
  for (int last = n; first < last;) {
    const int middle = first + (last - first) / 2;
    if (sorted(middle) < value) first = middle + 1;
    else last = middle;
  }
  return first;
}

Field<double>& component(VecField<double, 1>& f, int) { return f.x; }
Field<double>& component(VecField<double, 2>& f, int k) { return k == 0 ? f.x : f.y; }

}  // namespace

template <int D>
void Refinement<D>::lay_pattern() {
  const auto& daughters = split_->pattern.daughters;
  share_ = Field<double>("split.share", daughters.size());
  upload(share_, daughters.size(), [&](std::size_t k) { return daughters[k].share; });
  for (int axis = 0; axis < D; ++axis) {
    component(offset_, axis) = Field<double>("split.offset", daughters.size());
    upload(component(offset_, axis), daughters.size(), [&](std::size_t k) { return daughters[k].x[axis]; });
  }
}

template <int D>
int Refinement<D>::split(FieldSet& particles, const Bind& bind, const Field<int>& kind,
                         const WallView<D>& walls, int& next_id) {
  const int n = particles.size(), more = static_cast<int>(split_->pattern.daughters.size()) - 1;
  reserve(parent_, "split.parent", n);
  const Particles<D> p = bind();
  const Field<int> parent = parent_;
  const PlacedValue limit = split_->area;
  const double least = split_->least_depth;
  const bool open = kind.extent(0) > 0;
  int parents = 0;
  Kokkos::parallel_scan(
      "split::choose", Range(0, n),
      KOKKOS_LAMBDA(int i, int& sum, bool last) {
        if (p.id(i) < 0 || (open && kind(i) != 0) || p.rho(i) < least ||
            p.m(i) < limit(at(p.x, i)) * p.rho(i))
          return;
        if (last) parent(sum) = i;
        ++sum;
      },
      parents);
  if (parents == 0 || n + parents * more > split_->most_particles) return 0;
  const int first_id = take_ids(next_id, parents * more);
  rank_parents(p.id, parents);
  reserve(copy_of_, "split.copy_of", parents * more);
  const Field<int> copy_of = copy_of_;
  launch(
      "split::copies", Range(0, parents * more), KOKKOS_LAMBDA(int k) { copy_of(k) = parent(k / more); });
  particles.append_copies(copy_of, parents * more);
  place_daughters(bind(), parents, n, first_id, walls);
  return parents;
}

// The parents' ids in ascending order: daughters are numbered by them, not by where their parents stand.
template <int D>
void Refinement<D>::rank_parents(const Field<int>& id, int parents) {
  reserve(parent_ids_, "split.parent_ids", parents);
  const Field<int> parent = parent_, ids = parent_ids_;
  launch(
      "split::parent_ids", Range(0, parents), KOKKOS_LAMBDA(int s) { ids(s) = id(parent(s)); });
  Kokkos::sort(Kokkos::subview(ids, std::pair<int, int>(0, parents)));
}

// The first daughter takes the parent's place in the fields; the others are copies of the parent so far. rho
// h^D = kh with the parent's depth and alpha times its h: that is h0_k = alpha h0_N, rho0_k = rho0_N where
// h_N was free, and goes on from h_N where that was at a bound. The bounds of h count from here on.
template <int D>
void Refinement<D>::place_daughters(const Particles<D>& p, int parents, int first, int first_id,
                                    const WallView<D>& walls) const {
  const int daughters = share_.extent_int(0);
  const Field<int> parent = parent_, ids = parent_ids_;
  const Field<double> share = share_;
  const VecField<double, D> offset = offset_;
  const double alpha = split_->alpha;
  const bool linear = split_->linear;
  const double longest = relax_.longest;
  launch(
      "split::place", Range(0, parents * daughters), KOKKOS_LAMBDA(int q) {
        const int k = q / parents, s = q % parents;  // neighbours in memory belong to different parents
        const int i = k == 0 ? parent(s) : first + s * (daughters - 1) + k - 1;
        const Vec<double, D> from = at(p.x, i), to = walls.inside(from + p.h(i) * at(offset, k));
        put(p.x, i, to);
        const VecField<double, D>* const velocities[2] = {&p.v, &p.v_pred};  // not copies: those are counted
        if (linear)
          for (const auto* v : velocities) put(*v, i, at(*v, i) + stretched(p.strain, parent(s), to - from));
        p.m(i) *= share(k);
        p.h(i) *= alpha;
        p.h0(i) = smaller(p.h(i), larger(p.h0(i), longest));
        p.kh(i) = p.rho(i) * power<D>(p.h(i));
        if (k > 0) p.id(i) = first_id + rank_in(ids, parents, p.id(parent(s))) * (daughters - 1) + k - 1;
      });
}

template <int D>
void Refinement<D>::adapt(FieldSet& particles, const Bind& bind, const Field<int>& kind,
                          const ClusterSet& clusters, const NeighbourView& near, const WallView<D>& walls,
                          int& next_id) {
  if (merge_) count_.mergers += merge(bind(), particles.size(), kind, clusters, near);
  if (split_) count_.splits += split(particles, bind, kind, walls, next_id);
}

template class Refinement<1>;
template class Refinement<2>;

}  // namespace freshet::swe
