// BiCGStab with right preconditioning (van der Vorst 1992) for any operator: the residual that it watches is
// the true one.
//   p = r + beta (p - omega v), v = A M p, alpha = rho / (r0.v), s = r - alpha v, t = A M s, omega = t.s /
//   t.t, x += M (alpha p + omega s)
// Where s is small enough already, half an iteration is the last. A breakdown (rho or omega vanish against
// the residual) starts anew from the residual at hand. Results do not depend on the number of threads;
// nothing is allocated after the first solve of a size.
#pragma once
#include <cmath>

#include "cellgrid/parallel/launch.hpp"
#include "kernels/linear/vectors.hpp"

namespace freshet::linear {

struct BiCgStabOptions {
  double tolerance = 1e-8;  // of |r| / |b|
  double floor = 0;         // |r| that is good enough whatever b is
  double enough = 0;        // |r| that is good enough too, but never more than `loosest` |b|
  double loosest = 1e-4;
  int max_iterations = 500;
};

// Of the passes of an iteration beside products, preconditioner and dot products.
inline constexpr Cost direction_cost{0, 4, 4}, step_along_cost{0, 4, 3}, bicgstab_advance_cost{0, 8, 7};

struct BiCgStabReport {
  bool converged = false;
  int iterations = 0;
  double residual = 0;  // |r| / |b|
  int restarts = 0;
};

class BiCgStab {
 public:
  // multiply(x, y): y := A x. precondition(r, z): z := M r, r stays. x holds the first guess.
  template <class Multiply, class Precondition>
  [[nodiscard]] BiCgStabReport solve(int n, const Multiply& multiply, const Precondition& precondition,
                                     const Vector& b, const Vector& x, const BiCgStabOptions& options) {
    for (Vector* v : {&r_, &r0_, &p_, &v_, &t_, &mp_, &ms_}) reserve(*v, "bicgstab", n);
    multiply(x, r_);
    const double bb = dot(n, b, b);
    double rr = subtract_from(n, b, r_);
    const double goal2 = squared_goal(options, bb);
    BiCgStabReport report;
    double rho = 0, alpha = 0, omega = 0;
    for (bool fresh = true; rr > goal2 && report.iterations < options.max_iterations; ++report.iterations) {
      const double rho_new = fresh ? restart(n, rr) : dot(n, r0_, r_);
      direction(n, fresh ? 0.0 : rho_new / rho * (alpha / omega), omega);
      rho = rho_new;
      precondition(p_, mp_);
      multiply(mp_, v_);
      alpha = rho / dot(n, r0_, v_);
      rr = step_along(n, alpha);  // r is s now
      if (rr <= goal2) {
        add(n, alpha, mp_, x);
        ++report.iterations;
        break;
      }
      precondition(r_, ms_);
      multiply(ms_, t_);
      const auto ts_tt = dots(n, t_, r_, t_);
      omega = ts_tt[1] > 0 ? ts_tt[0] / ts_tt[1] : 0;
      rr = advance(n, x, alpha, omega);
      fresh = !(std::abs(rho) > breakdown * rr) || omega == 0;
      report.restarts += fresh;
      if (!std::isfinite(rr)) break;
    }
    report.converged = rr <= goal2;
    report.residual = bb > 0 ? std::sqrt(rr / bb) : 0;
    return report;
  }

  double restart(int n, double rr) {
    const Vector r = r_, r0 = r0_;
    launch(
        "bicgstab::restart", Range(0, n), KOKKOS_LAMBDA(int i) { r0(i) = r(i); });
    return rr;
  }

  // p := r + beta (p - omega v); beta = 0: p := r, whatever p and v held
  void direction(int n, double beta, double omega) {
    const Vector r = r_, p = p_, v = v_;
    launch(
        "bicgstab::direction", Range(0, n),
        KOKKOS_LAMBDA(int i) { p(i) = beta == 0 ? r(i) : r(i) + beta * (p(i) - omega * v(i)); });
  }

  // r -= alpha v; returns r . r
  double step_along(int n, double alpha) {
    const Vector r = r_, v = v_;
    return sum_of_particles<1>(
        "bicgstab::step_along", n, KOKKOS_LAMBDA(const Lanes& me) {
          const Lane rest = me.load(r) - alpha * me.load(v);
          me.store(r, rest);
          return LaneAddends<1>{{rest * rest}};
        })[0];
  }

  // x += alpha M p + omega M s, r := s - omega t; returns r . r
  double advance(int n, const Vector& x, double alpha, double omega) {
    const Vector r = r_, t = t_, mp = mp_, ms = ms_;
    return sum_of_particles<1>(
        "bicgstab::advance", n, KOKKOS_LAMBDA(const Lanes& me) {
          me.store(x, me.load(x) + (alpha * me.load(mp) + omega * me.load(ms)));
          const Lane rest = me.load(r) - omega * me.load(t);
          me.store(r, rest);
          return LaneAddends<1>{{rest * rest}};
        })[0];
  }

 private:
  static constexpr double breakdown = 1e-12;  // of |r|^2

  static double squared_goal(const BiCgStabOptions& options, double bb) {
    const double b = std::sqrt(bb), enough = std::fmin(options.enough, options.loosest * b);
    const double goal = std::fmax(std::fmax(options.tolerance * b, options.floor), enough);
    return goal * goal;
  }

  Vector r_, r0_, p_, v_, t_, mp_, ms_;
};

}  // namespace freshet::linear
