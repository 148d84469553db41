// What a split particle becomes: daughters on a fixed pattern and their shares of its mass (Vacondio
// 2010, 3.2). 2-D: six on a circle of radius eps h_N and one in the middle; 1-D: two at +- eps h_N, with or
// without one in the middle. All daughters have h_k = alpha h_N. The shares lambda minimise (3.6), the
// integral of (m_N W(x, h_N) - sum_k lambda_k m_N W(x - x_k, alpha h_N))^2, under sum lambda = 1 and lambda
// >= 0.
#pragma once
#include <vector>

namespace freshet::swe {

struct Daughter {
  double x[2];   // in h_N, from the parent
  double share;  // of the parent's mass
};

struct SplitPattern {
  std::vector<Daughter> daughters;  // those without mass are left out
  double error;                     // E* of (3.9) in m_N^2 / h_N^D
};

// Ring daughters by symmetry share the mass equally: the quadratic programme has one unknown, the ring's
// share s, E(s) = C - 2 [(1-s) b_0 + s b_1] + (1-s)^2 A_00 + 2 s (1-s) A_01 + (s^2 / n) sum_l A_1l, cut to
// [0, 1]. count: 7 in 2-D, 2 or 3 in 1-D. turn [rad]: of the hexagon's first corner from the x axis.
template <int D>
SplitPattern split_pattern(int count, double alpha, double eps, double turn);

// Integral of W(|x|, ha) W(|x - d|, hb) over the line or the plane [1/m^D], to about 1e-12 relative.
template <int D>
double kernel_product(double ha, double hb, double d);

}  // namespace freshet::swe
