// Supports by the number of neighbours (thesis 5.21-5.23, corrected): the h at which n(h) = sum over all points of w(r / h), the point itself
// included, is what it is inside a square lattice with h0 = support x spacing, n0 = pi (h0 / dx)^2 (1 - exp(-7)) / 7. Fixed point
//   h := h (n0 / n(h))^(1/2)   (printed without the iteration, which settles at h ~ n^-1/4 and not at n0 neighbours)
// from h0, held between 0.8 and 1.5 h0; it converges like Newton's (5.23) where n ~ h^2. Reads positions [m]; writes h [m].
#pragma once
#include "kernels/fpm/voronoi.hpp"

namespace freshet::fpm {

struct SupportRule {
  double support = 3.2;               // h0 / dx
  double least = 0.8, most = 1.5;     // x h0
  double settled = 1e-6;              // relative change of h
  int iterations = 30;
};

struct SupportReport {
  int unsettled = 0;  // points whose h still changed
};

double neighbours_wanted(double support);

SupportReport fit_supports(const Cloud& cloud, int n, const Field<double>& h, const SupportRule& rule);

}  // namespace freshet::fpm
