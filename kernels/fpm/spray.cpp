#include "kernels/fpm/spray.hpp"

namespace freshet::fpm {
namespace {

constexpr double reach = 0.75;  // x support: contact lines and corners of lattices have three inner points as near
constexpr double enough = 1.5;  // inner points
constexpr double slack = 1e-9;  // of the speeds: round-off is no change

struct Bounds {
  Lane low, high;  // m/s
  KOKKOS_FORCEINLINE_FUNCTION explicit Bounds(const Lane& v) : low(v), high(v) {}
  KOKKOS_FORCEINLINE_FUNCTION void see(const Lane& v) { low = smaller(low, v), high = larger(high, v); }
  KOKKOS_FORCEINLINE_FUNCTION void widen(double by) { (by < 0 ? low : high) += Lane(by); }
  KOKKOS_FORCEINLINE_FUNCTION Lane held(const Lane& v) const { return larger(low, smaller(high, v)); }
};

// The limited velocities of a cluster and how many points of it changed.
struct Limited {
  Vec<Lane, 2> v;
  int changed = 0;
};

KOKKOS_INLINE_FUNCTION Limited limited(const Neighbourhood<2>& around, const Flow& flow, const Vec<double, 2>& kick, int c) {
  const Lanes me = around.clusters(c);
  const Vec<Lane, 2> xi = me.load(flow.x), before = me.load(flow.v), n = me.load(flow.normal), free = me.load(flow.v_star);
  const Vec<Lane, 2> after = free - dot(free, n) * n;  // walls hold that part
  const Lane far = reach * me.load(around.h), far2 = far * far;
  Bounds u(before.x), v(before.y);
  Lane inner{0.0};
  around.near.for_each(c, [&](int j) {
    const Vec<Lane, 2> d = shortest(broadcast(at(flow.x, j)) - xi, around.period);
    const auto close = dot(d, d) < far2;
    inner += select(close, Lane(flow.row(j) == row_equation ? 1.0 : 0.0), Lane(0.0));
    u.see(select(close, Lane(flow.v.x(j)), before.x)), v.see(select(close, Lane(flow.v.y(j)), before.y));
  });
  u.widen(kick.x), v.widen(kick.y);
  const auto thin = inner < Lane(enough);
  Limited result{{select(thin, u.held(after.x), after.x), select(thin, v.held(after.y), after.y)}};
  const Vec<Lane, 2> change = result.v - after;
  const Lane much = Lane(slack) * dot(after, after);
  for (int l = 0; l < me.count; ++l) result.changed += lane_of(dot(change, change), l) > lane_of(much, l);
  return result;
}

}  // namespace

int limit_spray(const Neighbourhood<2>& around, const Flow& flow, const Vec<double, 2>& force, double tau) {
  int count = 0;
  const Vec<double, 2> kick = tau * force;
  Kokkos::parallel_reduce("fpm::limit_spray", Range(0, around.clusters.size()), KOKKOS_LAMBDA(int c, int& sum) {
        const Limited now = limited(around, flow, kick, c);
        around.clusters(c).store(flow.v_star, now.v);
        sum += now.changed;
      }, count);
  return count;
}

}  // namespace freshet::fpm
