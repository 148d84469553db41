// The particles within a distance of any place, also across the sides of a periodic domain: for work that is
// done point by point on few or irregular places, where a cluster list would not pay.
#pragma once
#include "cellgrid/particles/order.hpp"
#include "cellgrid/simd/vec.hpp"

namespace freshet {

// Lengths [m] after which the domain repeats itself; 0 = it does not. Particles are kept in low <= x < low +
// length.
struct Period {
  Vec<double, 2> low, length;

  // The place's equal within the domain.
  KOKKOS_INLINE_FUNCTION Vec<double, 2> wrap(Vec<double, 2> p) const {
    if (length.x > 0) p.x = into(p.x, low.x, length.x);
    if (length.y > 0) p.y = into(p.y, low.y, length.y);
    return p;
  }

  // The shortest of the ways that d stands for.
  KOKKOS_INLINE_FUNCTION Vec<double, 2> shortest(Vec<double, 2> d) const {
    if (length.x > 0) d.x = into(d.x, -0.5 * length.x, length.x);
    if (length.y > 0) d.y = into(d.y, -0.5 * length.y, length.y);
    return d;
  }

 private:
  static KOKKOS_INLINE_FUNCTION double into(double x, double lowest, double size) {
    if (x < lowest) x += size * static_cast<double>(1 + static_cast<long>((lowest - x) / size));
    if (x >= lowest + size) x -= size * static_cast<double>(static_cast<long>((x - lowest) / size));
    return x < lowest + size ? x : lowest;  // x + size may round up to the other side
  }
};

struct Near {
  Rows rows;              // the order of the particles
  VecField<double, 2> x;  // m
  Period period;

  // Calls see(j, x_j - p, r2) for every particle nearer than reach to p, in an order that depends on
  // positions and ids alone. A periodic domain is longer than 2 reach.
  template <class See>
  KOKKOS_INLINE_FUNCTION void for_each(const Vec<double, 2>& p, double reach, const See& see) const {
    const double xlo = image(p.x, reach, period.low.x, period.length.x, -1),
                 xhi = image(p.x, reach, period.low.x, period.length.x, 1);
    const double ylo = image(p.y, reach, period.low.y, period.length.y, -1),
                 yhi = image(p.y, reach, period.low.y, period.length.y, 1);
    for (double sy = ylo; sy <= yhi; sy += 1)
      for (double sx = xlo; sx <= xhi; sx += 1)
        from({p.x + sx * period.length.x, p.y + sy * period.length.y}, reach, see);
  }

 private:
  // -1, 0 or 1: whether the domain must also be looked at from the side beyond it.
  static KOKKOS_FORCEINLINE_FUNCTION double image(double x, double reach, double low, double length,
                                                  int side) {
    if (length <= 0) return 0;
    return side < 0 ? (x + reach > low + length ? -1 : 0) : (x - reach < low ? 1 : 0);
  }

  template <class See>
  KOKKOS_FORCEINLINE_FUNCTION void from(const Vec<double, 2>& p, double reach, const See& see) const {
    const double far2 = reach * reach;
    rows.for_each_run(p.x, p.x, p.y, p.y, reach, [&](int begin, int end) {
      for (int j = begin; j < end; ++j) {
        const Vec<double, 2> d{x.x(j) - p.x, x.y(j) - p.y};
        const double r2 = d.x * d.x + d.y * d.y;
        if (r2 < far2) see(j, d, r2);
      }
    });
  }
};

}  // namespace freshet
