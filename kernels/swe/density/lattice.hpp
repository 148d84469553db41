// What the density summation makes of a regular lattice: off by the kernel's lattice bias, 1e-4 to 2e-3
// (docs/formulas/swe.md (S6)). Particles whose state is imposed carry it too, else still water would be
// pushed where they meet.
#pragma once
#include <cmath>

#include "kernels/swe/particles.hpp"

namespace freshet::swe {

struct LatticeSums {
  double density;  // of a true depth of 1: the root of rho = sum m W(h(rho))
  double alpha;    // -(1/(rho D)) sum m r W' (2.32)
};

template <int D, class K>
LatticeSums lattice_sums_of(const K& kernel, double eta) {
  LatticeSums s{1, 1};
  for (int n = 0; n < 30; ++n) {  // a fixed point: the bias falls by orders of magnitude in each turn
    const double h = smoothing_length<D>(power<D>(eta), s.density);
    const int reach = static_cast<int>(kernel.support * h) + 1;
    double sum = 0, moment = 0;
    for (int i = -reach; i <= reach; ++i)
      for (int j = D == 1 ? 0 : -reach; j <= (D == 1 ? 0 : reach); ++j) {
        const auto k = kernel.at(std::hypot(i, j) / h);
        sum += k.w;
        moment -= k.dw * std::hypot(i, j) / h;
      }
    s = {sum / power<D>(h), moment / (sum * D)};
  }
  return s;
}

template <int D>
LatticeSums lattice_sums(double eta, const AnyKernel<D>& kernel = CubicSpline<D>{}) {
  return std::visit([eta](const auto& k) { return lattice_sums_of<D>(k, eta); }, kernel);
}

}  // namespace freshet::swe
