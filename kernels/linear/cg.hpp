// Preconditioned conjugate gradients for any symmetric positive (semi-)definite operator:
//   x += alpha p, r -= alpha A p, z = D^-1 r + C r, p = z + beta p,   alpha = r.z / p.Ap, beta = (r.z)_new /
//   r.z
// (thesis Algorithm 1 with the sign of r mended). Jacobi's D^-1 always; C is an optional additive correction.
// An iteration visits memory three times: p, A p with p.Ap, and x, r, z with r.r and r.z (+ what C does).
// Results do not depend on the number of threads. Nothing is allocated after the first solve of a size.
#pragma once
#include <cmath>
#include <string>

#include "kernels/linear/vectors.hpp"

namespace freshet::linear {

struct CgOptions {
  double tolerance = 1e-6;  // of |r| / |b|, r as the recurrence has it
  int max_iterations = 1000;
  double scale = 0;       // > 0: |r| is measured in this instead of |b|
  bool from_zero = true;  // x starts at zero; false: at what it holds (one operator call more)
};

struct CgReport {
  // not_positive: p.Ap or r.z was not a positive finite number: the operator or the preconditioner is not
  // positive definite, or something was not finite. x is then the last iterate before.
  enum class Outcome { converged, iteration_limit, not_positive };
  Outcome outcome = Outcome::converged;
  int iterations = 0;
  double residual = 0;  // |r| / |b| at the end
  bool converged() const { return outcome == Outcome::converged; }
};

// What happened, for logs and errors: "converged in 12 iterations, residual 3.1e-07".
std::string describe(const CgReport& report);

// Above zero, and neither infinite nor NaN.
inline bool is_positive(double a) { return a > 0 && std::isfinite(a); }

struct Jacobi {
  Vector inverse_diagonal;  // zero in rows that are left out: x stays there, and b must be zero
  double correct(const Vector&, const Vector&) const { return 0; }
};

// correction(r, z) adds C r to z and returns r.Cr; C symmetric, positive semidefinite.
template <class Correction>
struct JacobiPlus {
  Vector inverse_diagonal;
  Correction& correction;
  double correct(const Vector& r, const Vector& z) const { return correction(r, z); }
};

// What a pass does with each row; products are the operator's.
inline constexpr Cost residual_cost{0, 8, 5}, advance_cost{0, 9, 8};

// The vectors of one solve and the two passes between operator calls (cg.cpp).
struct CgVectors {
  struct Products {
    double rr, rz, bb;
  };
  Vector r, z, p, q;  // q: A p, at the start A x

  void resize(int n);
  // r := b - q, z := D^-1 r; returns r.r, r.z, b.b
  Products residual(int n, const Vector& d, const Vector& b);
  // x += alpha p, r -= alpha q, z := D^-1 r; returns r.r, r.z
  Products advance(int n, double alpha, const Vector& d, const Vector& x);
};

class ConjugateGradients {
 public:
  // The number of unknowns of the systems to come.
  void resize(int unknowns);

  // a(x, y) sets y := A x and returns x.Ax; preconditioner: Jacobi or JacobiPlus. b: unknowns; x: start (see
  // options) and result.
  template <class Operator, class Preconditioner>
  [[nodiscard]] CgReport solve(const Operator& a, const Preconditioner& preconditioner, const Vector& b,
                               const Vector& x, const CgOptions& options);

 private:
  int size_ = 0;
  CgVectors v_;
};

template <class Operator, class Preconditioner>
CgReport ConjugateGradients::solve(const Operator& a, const Preconditioner& preconditioner, const Vector& b,
                                   const Vector& x, const CgOptions& options) {
  using Outcome = CgReport::Outcome;
  const Vector& d = preconditioner.inverse_diagonal;
  if (options.from_zero) {
    fill(size_, 0.0, x);
    fill(size_, 0.0, v_.q);
  } else {
    a(x, v_.q);
  }
  CgVectors::Products now = v_.residual(size_, d, b);
  const double scale = options.scale > 0 ? options.scale : std::sqrt(now.bb);
  const double per_scale = scale > 0 ? 1 / scale : 1;
  double rz = 0;
  for (int n = 0;; ++n) {
    const double residual = std::sqrt(now.rr) * per_scale;
    if (residual <= options.tolerance) return {Outcome::converged, n, residual};
    if (n == options.max_iterations) return {Outcome::iteration_limit, n, residual};
    const double before = rz;
    rz = now.rz + preconditioner.correct(v_.r, v_.z);
    if (!is_positive(rz)) return {Outcome::not_positive, n, residual};
    follow(size_, v_.z, n > 0 ? rz / before : 0.0, v_.p);
    const double curvature = a(v_.p, v_.q);
    if (!is_positive(curvature)) return {Outcome::not_positive, n, residual};
    now = v_.advance(size_, rz / curvature, d, x);
  }
}

}  // namespace freshet::linear
