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
  const auto sum = sum_of_particles<3>(
      "cg::residual", n, KOKKOS_LAMBDA(const Lanes& me) {
        const Lane bi = me.load(b), ri = bi - me.load(ax), zi = me.load(d) * ri;
        me.store(to_r, ri);
        me.store(to_z, zi);
        return LaneAddends<3>{{ri * ri, ri * zi, bi * bi}};
      });
  return {sum[0], sum[1], sum[2]};
}

CgVectors::Products CgVectors::advance(int n, double alpha, const Vector& d, const Vector& x) {
  const Vector to_r = r, to_z = z, along = p, ap = q;
  const auto sum = sum_of_particles<2>(
      "cg::advance", n, KOKKOS_LAMBDA(const Lanes& me) {
        me.store(x, me.load(x) + alpha * me.load(along));
        const Lane ri = me.load(to_r) - alpha * me.load(ap), zi = me.load(d) * ri;
        me.store(to_r, ri);
        me.store(to_z, zi);
        return LaneAddends<2>{{ri * ri, ri * zi}};
      });
  return {sum[0], sum[1], 0};
}

void ConjugateGradients::resize(int unknowns) {
  size_ = unknowns;
  v_.resize(unknowns);
}

std::string describe(const CgReport& report) {
  const char* what[] = {"converged in", "not converged within the limit of",
                        "stopped (operator or right-hand side not positive definite, or not finite) after"};
  char text[200];
  std::snprintf(text, sizeof text, "%s %d iterations, residual %.2g", what[static_cast<int>(report.outcome)],
                report.iterations, report.residual);
  return text;
}

}  // namespace freshet::linear
