// Supports by the number of neighbours (docs/formulas/fpm.md (F29)): the h at which n(h) = sum over all
// points of w(r / h), the point itself included, is what it is inside a square lattice with h0 = support x
// spacing, n0 = pi (h0 / dx)^2 (1 - exp(-7)) / 7. Newton's iteration (5.23, with the slope of the very count
// in place of d n / h; the fixed point h := h (n0 / n)^(1/2) swings for ever on disordered points) from h0,
// held between 0.8 and 1.5 h0. As printed, (5.21) settles at h ~ n^-1/4 and not at n0 neighbours. Reads
// positions [m]; writes h [m].
#pragma once
#include "kernels/fpm/cells/voronoi.hpp"

namespace freshet::fpm {

struct SupportRule {
  double support = 3.2;            // h0 / dx
  double least = 0.8, most = 1.5;  // x h0
  double settled = 1e-3;           // relative change of h; a point that enters at r = h counts 9e-4
  int iterations = 20;
};

struct SupportReport {
  int unsettled = 0;  // points whose h still changed
};

double neighbours_wanted(double support);

SupportReport fit_supports(const Cloud& cloud, int n, const Field<double>& h, const SupportRule& rule);

}  // namespace freshet::fpm
