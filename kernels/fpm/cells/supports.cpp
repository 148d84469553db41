#include "kernels/fpm/cells/supports.hpp"

#include <cmath>

#include "kernels/fpm/stencils/mls.hpp"

namespace freshet::fpm {
namespace {

// Squared distances [m2] of the points that any admitted support reaches; of more than `room` the first.
struct Distances {
  static constexpr int room = 256;
  double r2[room];
  int size = 0;

  // Newton's step for n(h) = wanted on h: n' = sum of 2 steepness r^2 / h^3 w.
  KOKKOS_INLINE_FUNCTION double newton(double h, double wanted) const {
    double count = 0, slope = 0;
    for (int k = 0; k < size; ++k) {
      const double s = r2[k] / (h * h), w = weight(s);
      count += w, slope += 2 * steepness * s * w;
    }
    return h * (1 + (wanted - count) / larger(slope, count));  // slope: h n'; few neighbours: as if n ~ h
  }
};

}  // namespace

double neighbours_wanted(double support) {
  return pi * support * support * (1 - std::exp(-steepness)) / steepness;
}

SupportReport fit_supports(const Cloud& cloud, int n, const Field<double>& h, const SupportRule& rule) {
  const double wanted = neighbours_wanted(rule.support);
  SupportReport report;
  Kokkos::parallel_reduce(
      "fpm::supports", Range(0, n),
      KOKKOS_LAMBDA(int i, int& unsettled) {
        const double h0 = rule.support * cloud.spacing_at(i), low = rule.least * h0, high = rule.most * h0;
        Distances near;
        cloud.near.for_each(at(cloud.near.x, i), high, [&](int, const Vec<double, 2>&, double r2) {
          if (near.size < Distances::room) near.r2[near.size++] = r2;
        });
        double now = h0, change = h0;
        for (int k = 0; k < rule.iterations && change > rule.settled * now; ++k) {
          const double next = clamp(near.newton(now, wanted), low, high);
          change = next > now ? next - now : now - next;
          now = next;
        }
        h(i) = now;
        unsettled += change > rule.settled * now;
      },
      report.unsettled);
  return report;
}

}  // namespace freshet::fpm
