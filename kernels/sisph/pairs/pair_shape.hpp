// One pair from where its particles stand: n from i to j, d, G = -W'(r), W, and its area A, symmetric in i
// and j to the bit; closed by the multipliers of closure.hpp. The one source of what geometry.cpp stores and
// coefficients.hpp finds anew. Padding, a particle with itself, has G = W = 0 and is 1 m apart, so that it
// can be divided by.
#pragma once
#include "cellgrid/simd/vec.hpp"
#include "kernels/smoothing/smoothing.hpp"

namespace freshet::sisph {

template <int D>
struct PairShape {
  Vec<Lane, D> n;
  Lane distance, slope, w;  // m; G [m^-(D+1)]; W [m^-D]
};

// apart: x_j - x_i
template <int D, class Kernel>
KOKKOS_FORCEINLINE_FUNCTION PairShape<D> pair_shape(const Kernel& kernel, const Vec<Lane, D>& apart,
                                                    Lane inv_h) {
  const Lane r2 = dot(apart, apart), inv_r = rsqrt(r2 + tiny_square), r = r2 * inv_r, norm = power<D>(inv_h);
  const KernelValue<Lane> k = kernel.at(r * inv_h);
  const Lane here = select(Lane(0.0) < r2, Lane(1.0), Lane(0.0));  // not padding
  return {inv_r * apart, r + (1.0 - here), -here * norm * inv_h * k.dw, here * norm * k.w};
}

// 2 omega_i omega_j G (1/s_i + 1/s_j) / 2
KOKKOS_FORCEINLINE_FUNCTION Lane pair_area(Lane omega_i, Lane omega_j, Lane slope, Lane per_i, Lane per_j) {
  return omega_i * omega_j * slope * (per_i + per_j);
}

// What the closure multiplies an area by.
template <int D>
KOKKOS_FORCEINLINE_FUNCTION Lane closing(const Vec<Lane, D>& lambda_i, const Vec<Lane, D>& lambda_j,
                                         const Vec<Lane, D>& n) {
  return 1.0 - dot(lambda_j - lambda_i, n);
}

}  // namespace freshet::sisph
