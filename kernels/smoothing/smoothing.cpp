#include "kernels/smoothing/smoothing.hpp"

namespace freshet {
namespace {

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
AnyKernel<D> make_kernel(const KernelChoice& choice, double eta, bool lattice_correction) {
  if (std::holds_alternative<kernel::Cubic>(choice) && !lattice_correction) return CubicSpline<D>{};
  return general_kernel<D>(choice,
                           lattice_correction ? 1 / lattice_sum(general_kernel<D>(choice), eta) : 1.0);
}

template AnyKernel<1> make_kernel<1>(const KernelChoice&, double, bool);
template AnyKernel<2> make_kernel<2>(const KernelChoice&, double, bool);

}  // namespace freshet
