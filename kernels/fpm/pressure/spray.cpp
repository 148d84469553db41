#include "kernels/fpm/pressure/spray.hpp"

namespace freshet::fpm {
namespace {

// x support: contact lines and corners of lattices have three inner points as near
constexpr double reach = 0.75;
constexpr double enough = 1.5;  // inner points
constexpr double slack = 1e-9;  // of the speed squared: round-off is no change

// The limited velocities of a cluster and how many points of it changed.
struct Limited {
  Vec<Lane, 2> v;
  int changed = 0;
};

KOKKOS_INLINE_FUNCTION Limited limited(const Neighbourhood<2>& around, const Flow& flow,
                                       const Vec<double, 2>& kick, int c) {
  const Lanes me = around.clusters(c);
  const Vec<Lane, 2> xi = me.load(flow.x), n = me.load(flow.normal), free = me.load(flow.v_star);
  const Vec<Lane, 2> after = free - dot(free, n) * n;  // walls hold that part
  const Lane far = reach * me.load(around.h), far2 = far * far, speed2 = dot(after, after);
  Lane inner{0.0}, most2{0.0};
  around.near.for_each(c, [&](int j) {
    const Vec<Lane, 2> d = shortest(broadcast(at(flow.x, j)) - xi, around.period);
    const auto close = dot(d, d) < far2;
    const Vec<double, 2> v = at(flow.v, j), kicked = v + kick;
    inner += select(close, Lane(flow.row(j) == row_equation ? 1.0 : 0.0), Lane(0.0));
    most2 = larger(most2, select(close, Lane(larger(dot(v, v), dot(kicked, kicked))), Lane(0.0)));
  });
  const auto thin = inner < Lane(enough), fast = (1 + slack) * most2 < speed2;
  const Lane slower =
      select(thin, select(fast, root(most2 / larger(speed2, Lane(1e-300))), Lane(1.0)), Lane(1.0));
  Limited result{slower * after};
  for (int l = 0; l < me.count; ++l) result.changed += lane_of(slower, l) < 1;
  return result;
}

}  // namespace

int limit_spray(const Neighbourhood<2>& around, const Flow& flow, const Vec<double, 2>& force, double tau) {
  int count = 0;
  const Vec<double, 2> kick = tau * force;
  Kokkos::parallel_reduce(
      "fpm::limit_spray", Range(0, around.clusters.size()),
      KOKKOS_LAMBDA(int c, int& sum) {
        const Limited now = limited(around, flow, kick, c);
        around.clusters(c).store(flow.v_star, now.v);
        sum += now.changed;
      },
      count);
  return count;
}

}  // namespace freshet::fpm
