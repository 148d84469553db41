// Refinement: merging.
#include "cellgrid/parallel/launch.hpp"
#include "kernels/swe/split/refinement.hpp"

namespace freshet::swe {
namespace {

// Total order on pairs: nearer first, then the smaller of the two ids, then the larger. The same for both of
// a pair.
struct Pair {
  double r2 = 1e300;
  int low = 0, high = 0;
  KOKKOS_FORCEINLINE_FUNCTION bool before(const Pair& b) const {
    return r2 < b.r2 || (r2 == b.r2 && (low < b.low || (low == b.low && high < b.high)));
  }
};

// The smoothing length that keeps the density at the place of the new particle: m W(0, h) = m_i W(r_i, h_i) +
// m_j W(r_j, h_j).
template <int D>
KOKKOS_INLINE_FUNCTION double merged_length(const Particles<D>& p, int i, int j, const Vec<double, D>& x) {
  double density = 0;
  const int both[2] = {i, j};
  for (const int k : both) {
    const Vec<double, D> d = at(p.x, k) - x;
    density += p.m(k) * Kernel<D>::at(root(dot(d, d)) / p.h(k)).w / power<D>(p.h(k));
  }
  const double volume = (p.m(i) + p.m(j)) * Kernel<D>::at(0.0).w / density;
  return D == 1 ? volume : root(volume);
}

}  // namespace

// area_: of the particles that may merge. partner_: the first of each one's pairs by the order above.
template <int D>
void Refinement<D>::choose_partners(const Particles<D>& p, int n, const Field<int>& kind,
                                    const ClusterSet& clusters, const NeighbourView& near) {
  constexpr double never = 1e300;
  reserve(area_, "merge.area", n);
  reserve(partner_, "merge.partner", n);
  const Field<double> area = area_;
  const Field<int> partner = partner_;
  const PlacedValue limit = merge_->area, split_limit = merge_->split_area;
  const bool open = kind.extent(0) > 0;
  const double reach = 0.5 * merge_->reach;
  const ClusterSet sets = clusters;
  const NeighbourView neighbours = near;
  launch(
      "merge::eligible", Range(0, n), KOKKOS_LAMBDA(int i) {
        const bool small = p.id(i) >= 0 && !(open && kind(i) != 0) && p.m(i) < limit(at(p.x, i)) * p.rho(i);
        area(i) = small ? p.m(i) / p.rho(i) : never;
      });
  launch(
      "merge::choose", Range(0, clusters.size()), KOKKOS_LAMBDA(int c) {
        const Lanes me = sets(c);
        for (int i = me.first; i < me.first + me.count; ++i) {
          partner(i) = -1;
          if (area(i) == never) continue;
          Pair best;
          const double most = split_limit(at(p.x, i));
          neighbours.for_each(c, [&](int j) {
            if (j == i || area(j) == never || area(i) + area(j) >= smaller(most, split_limit(at(p.x, j))))
              return;
            const Vec<double, D> d = at(p.x, i) - at(p.x, j);
            const Pair pair{dot(d, d), smaller(p.id(i), p.id(j)), larger(p.id(i), p.id(j))};
            const double far = reach * (p.h(i) + p.h(j));
            if (pair.r2 >= far * far || !pair.before(best)) return;
            best = pair;
            partner(i) = j;
          });
        }
      });
}

template <int D>
int Refinement<D>::merge(const Particles<D>& p, int n, const Field<int>& kind, const ClusterSet& clusters,
                         const NeighbourView& near) {
  choose_partners(p, n, kind, clusters, near);
  const Field<int> partner = partner_;
  const ClusterSet sets = clusters;
  const double longest = relax_.longest;
  int mergers = 0;
  Kokkos::parallel_reduce(
      "merge::join", Range(0, clusters.size()),
      KOKKOS_LAMBDA(int c, int& count) {
        const Lanes me = sets(c);
        for (int i = me.first; i < me.first + me.count; ++i) {
          const int j = partner(i);
          if (j < i || partner(j) != i) continue;  // the first of the two does it for both, none: -1 < i
          const double m = p.m(i) + p.m(j), part = p.m(j) / m;
          const Vec<double, D> x = at(p.x, i) + part * (at(p.x, j) - at(p.x, i));
          p.h(i) = merged_length<D>(p, i, j, x);
          put(p.x, i, x);
          const VecField<double, D> velocities[2] = {p.v, p.v_pred};
          for (const VecField<double, D>& v : velocities) put(v, i, at(v, i) + part * (at(v, j) - at(v, i)));
          p.rho(i) = m / (p.m(i) / p.rho(i) + p.m(j) / p.rho(j));  // the areas add up
          p.rate(i) += part * (p.rate(j) - p.rate(i));
          p.m(i) = m;
          const double area0 = power<D>(p.h0(i)) + power<D>(p.h0(j)), kh = p.rho(i) * power<D>(p.h(i));
          // to the power D: kh / h0^D is the two's mean rho0
          const double h0 = kh / (p.kh(i) + p.kh(j)) * area0;
          p.h0(i) = smaller(D == 1 ? h0 : root(h0), larger(longest, larger(p.h0(i), p.h0(j))));
          p.kh(i) = kh;
          p.id(j) = -1;
          ++count;
        }
      },
      mergers);
  return mergers;
}

template int Refinement<1>::merge(const Particles<1>&, int, const Field<int>&, const ClusterSet&,
                                  const NeighbourView&);
template int Refinement<2>::merge(const Particles<2>&, int, const Field<int>&, const ClusterSet&,
                                  const NeighbourView&);
template void Refinement<1>::choose_partners(const Particles<1>&, int, const Field<int>&, const ClusterSet&,
                                             const NeighbourView&);
template void Refinement<2>::choose_partners(const Particles<2>&, int, const Field<int>&, const ClusterSet&,
                                             const NeighbourView&);

}  // namespace freshet::swe
