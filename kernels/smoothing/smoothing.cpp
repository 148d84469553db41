#include "kernels/smoothing/smoothing.hpp"

#include <cmath>

namespace freshet {
namespace {

constexpr double pi = 3.14159265358979323846;

// In 1-D Wendland's C2 function is (1 - q/2)^3 (1 + 3q/2), in 2-D (1 - q/2)^4 (1 + 2q); with p = 2 - q both are two powers.
template <int D>
GeneralKernel<D> wendland(double kappa) {
  GeneralKernel<D> k;
  if (D == 1)
    k.term[0] = {2, kappa * 5.0 / 8 * 0.5, -kappa * 5.0 / 8 * 1.5 / 8, 0};
  else
    k.term[0] = {2, 0, kappa * 7 / (4 * pi) * 5.0 / 16, -kappa * 7 / (4 * pi) * 2.0 / 16};
  return k;
}

// sum_i w(|i| / eta) / eta^D over the lattice: one for a kernel without lattice bias.
template <int D>
double lattice_sum(const GeneralKernel<D>& kernel, double eta) {
  const int reach = static_cast<int>(kernel.support * eta) + 1, across = D == 1 ? 0 : reach;
  double sum = 0;
  for (int i = -reach; i <= reach; ++i)
    for (int j = -across; j <= across; ++j) sum += kernel.at(std::hypot(i, j) / eta).w;
  return sum / power<D>(eta);
}

}  // namespace

template <int D>
GeneralKernel<D> general_kernel(KernelName name, double kappa) {
  GeneralKernel<D> k;
  switch (name) {
    case KernelName::cubic: {
      const double n = kappa * CubicSpline<D>::norm;
      k.term[0] = {2, 0.25 * n, 0, 0};
      k.term[1] = {1, -n, 0, 0};
      return k;
    }
    case KernelName::quartic: {
      const double n = kappa * (D == 1 ? 1.0 / 24 : 96 / (1199 * pi));
      k.support = 2.5;
      k.term[0] = {2.5, 0, n, 0};
      k.term[1] = {1.5, 0, -5 * n, 0};
      k.term[2] = {0.5, 0, 10 * n, 0};
      return k;
    }
    case KernelName::quintic: {
      const double n = kappa * (D == 1 ? 1.0 / 120 : 7 / (478 * pi));
      k.support = 3;
      k.term[0] = {3, 0, 0, n};
      k.term[1] = {2, 0, 0, -6 * n};
      k.term[2] = {1, 0, 0, 15 * n};
      return k;
    }
    case KernelName::gaussian:
      k.support = 3;
      k.gaussian = kappa * (D == 1 ? 1 / std::sqrt(pi) : 1 / pi);
      return k;
    case KernelName::wendland: return wendland<D>(kappa);
  }
  return k;
}

template <int D>
AnyKernel<D> make_kernel(KernelName name, double eta, bool lattice_correction) {
  if (name == KernelName::cubic && !lattice_correction) return CubicSpline<D>{};
  return general_kernel<D>(name, lattice_correction ? 1 / lattice_sum(general_kernel<D>(name), eta) : 1.0);
}

template GeneralKernel<1> general_kernel<1>(KernelName, double);
template GeneralKernel<2> general_kernel<2>(KernelName, double);
template AnyKernel<1> make_kernel<1>(KernelName, double, bool);
template AnyKernel<2> make_kernel<2>(KernelName, double, bool);

}  // namespace freshet
