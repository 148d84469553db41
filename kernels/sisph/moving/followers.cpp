#include "kernels/sisph/moving/followers.hpp"

#include <string>

#include "cellgrid/parallel/launch.hpp"

namespace freshet::sisph {
namespace {

KOKKOS_FORCEINLINE_FUNCTION Vec<double, 1> clamped(const Vec<double, 1>& p, const Vec<double, 1>& low,
                                                   const Vec<double, 1>& high) {
  return {clamp(p.x, low.x, high.x)};
}
KOKKOS_FORCEINLINE_FUNCTION Vec<double, 2> clamped(const Vec<double, 2>& p, const Vec<double, 2>& low,
                                                   const Vec<double, 2>& high) {
  return {clamp(p.x, low.x, high.x), clamp(p.y, low.y, high.y)};
}

Field<int> integers(const std::string& label, int n) { return Field<int>(label, static_cast<size_t>(n)); }

}  // namespace

template <int D>
Followers<D>::Followers(int particles, const Origin& start)
    : place_(integers("sisph.place_of_id", particles)) {
  list(particles, leaders(particles, start));
  locate(particles, start.id);
}

template <int D>
Field<int> Followers<D>::leaders(int particles, const Origin& start) const {
  const Field<int> leader = integers("sisph.leader_of_id", particles);
  const Rows rows = start.rows;
  const VecField<double, D> x = start.x;
  const Field<int> id = start.id, kind = start.kind;
  const Vec<double, D> low = start.low, high = start.high;
  const double far = 2 * start.spacing;
  launch(
      "sisph::find_leaders", Range(0, particles), KOKKOS_LAMBDA(int i) {
        const Vec<double, D> side = clamped(at(x, i), low, high);
        double least = far * far;
        int nearest = -1;
        if (kind(i) > 0)
          rows.for_each_run(side.x, side.x, y_of(side), y_of(side), far, [&](int begin, int end) {
            for (int j = begin; j < end; ++j) {
              const Vec<double, D> d = at(x, j) - side;
              if (kind(j) > 0 || !(dot(d, d) < least)) continue;
              least = dot(d, d);
              nearest = id(j);
            }
          });
        leader(id(i)) = nearest;
      });
  return leader;
}

template <int D>
void Followers<D>::list(int particles, const Field<int>& leader) {
  Kokkos::parallel_reduce(
      "sisph::count_followers", Range(0, particles),
      KOKKOS_LAMBDA(int i, int& n) { n += leader(i) >= 0 ? 1 : 0; }, count_);
  follower_ = integers("sisph.followers", count_);
  leader_ = integers("sisph.leaders", count_);
  const Field<int> from = follower_, to = leader_;
  Kokkos::parallel_scan(
      "sisph::list_followers", Range(0, particles), KOKKOS_LAMBDA(int i, int& n, bool last) {
        if (leader(i) < 0) return;
        if (last) from(n) = i, to(n) = leader(i);
        ++n;
      });
}

template <int D>
void Followers<D>::locate(int particles, const Field<int>& id) {
  if (count_ == 0) return;
  const Field<int> place = place_;
  launch(
      "sisph::locate", Range(0, particles), KOKKOS_LAMBDA(int i) { place(id(i)) = i; });
}

template <int D>
void Followers<D>::follow(const VecField<double, D>& v) const {
  if (count_ == 0) return;
  const Field<int> place = place_, follower = follower_, leader = leader_;
  launch(
      "sisph::follow", Range(0, count_),
      KOKKOS_LAMBDA(int k) { put(v, place(follower(k)), at(v, place(leader(k)))); });
}

template class Followers<1>;
template class Followers<2>;

}  // namespace freshet::sisph
