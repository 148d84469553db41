#include "kernels/linear/cg.hpp"

#include <cstdio>

namespace freshet::linear {

void CgVectors::resize(int n) {
  reserve(r, "cg.r", n);
  reserve(z, "cg.z", n);
  reserve(p, "cg.p", n);
  reserve(q, "cg.q", n);
}

CgVectors::Products CgVectors::residual(int n, const Vector& d, const Vector& b) {
  const Vector to_r = r, to_z = z, ax = q;
  const auto sum = sums.sum<3>("cg::residual", n, KOKKOS_LAMBDA(int i) {
    const double bi = b(i), ri = bi - ax(i), zi = d(i) * ri;
    to_r(i) = ri;
    to_z(i) = zi;
    return Kokkos::Array<double, 3>{{ri * ri, ri * zi, bi * bi}};
  });
  return {sum[0], sum[1], sum[2]};
}

CgVectors::Products CgVectors::advance(int n, double alpha, const Vector& d, const Vector& x) {
  const Vector to_r = r, to_z = z, along = p, ap = q;
  const auto sum = sums.sum<2>("cg::advance", n, KOKKOS_LAMBDA(int i) {
    x(i) += alpha * along(i);
    const double ri = to_r(i) - alpha * ap(i), zi = d(i) * ri;
    to_r(i) = ri;
    to_z(i) = zi;
    return Kokkos::Array<double, 2>{{ri * ri, ri * zi}};
  });
  return {sum[0], sum[1], 0};
}

void ConjugateGradients::resize(int unknowns) {
  size_ = unknowns;
  v_.resize(unknowns);
}

std::string describe(const CgReport& report) {
  const char* what[] = {"converged in", "not converged within the limit of", "stopped (operator or right-hand side not positive definite, or not finite) after"};
  char text[200];
  std::snprintf(text, sizeof text, "%s %d iterations, residual %.2g", what[static_cast<int>(report.outcome)], report.iterations,
                report.residual);
  return text;
}

}  // namespace freshet::linear
