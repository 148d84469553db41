// The pair force of docs/formulas/swe.md (S15) to (S20) as scalar sums over all pairs, as the page has it.
#pragma once
#include <Eigen/Dense>

#include "tests/support/points/cloud.hpp"

namespace freshet::test {

using Eigen::Matrix2d;
using Eigen::Vector2d;

enum class Flux { none, lax_friedrichs, muscl, viscosity, two_shock, two_shock_muscl };
inline bool reconstructs(Flux flux) { return flux == Flux::muscl || flux == Flux::two_shock_muscl; }
inline bool riemann(Flux flux) { return flux == Flux::two_shock || flux == Flux::two_shock_muscl; }

// Everything of the direct sum, by id. h and rho are the solver's (unit/density.cpp), the rest is made here.
struct Direct {
  int dimension;
  double gravity;
  Flux flux;
  double strength;
  swe::LengthBounds bounds;
  std::vector<Grain> grains;
  std::vector<double> h, rho, alpha;
  std::vector<Matrix2d> gradient;  // [row] of v, [column] by x
  std::vector<Vector2d> depth_gradient;

  Vector2d x(size_t i) const { return {grains[i].x[0], grains[i].x[1]}; }
  Vector2d v(size_t i) const { return {grains[i].v[0], grains[i].v[1]}; }

  // G_ij(h) = W'(r, h) x_ij / r
  Vector2d slope(size_t i, size_t j, double length) const {
    const Vector2d x_ij = x(i) - x(j);
    const double r = x_ij.norm();
    if (r == 0) return {0, 0};
    return x_ij / r * printed_dw(dimension, r / length) / std::pow(length, dimension + 1);
  }
};

// -(1/(rho D)) sum m r W', 1 where h is at a bound.
inline double direct_alpha(const Direct& s, size_t i) {
  const double h0 = s.grains[i].h0;
  if (std::abs(s.h[i] - s.bounds.floor * h0) < 1e-9 * h0 || std::abs(s.h[i] - s.bounds.cap * h0) < 1e-9 * h0)
    return 1;
  double sum = 0;
  for (size_t j = 0; j < s.grains.size(); ++j)
    sum -= s.grains[j].m * (s.x(i) - s.x(j)).dot(s.slope(i, j, s.h[i]));
  return sum / (s.rho[i] * s.dimension);
}

// sum m_j (v_j - v_i) G_ij^T L, with L the inverse of the same sum for x; nothing where the neighbours do not
// span the plane.
inline Matrix2d direct_gradient(const Direct& s, size_t i) {
  Matrix2d of_v = Matrix2d::Zero(), of_x = Matrix2d::Zero();
  for (size_t j = 0; j < s.grains.size(); ++j) {
    const Vector2d weight = s.grains[j].m * s.slope(i, j, s.h[i]);
    of_v += (s.v(j) - s.v(i)) * weight.transpose();
    of_x += (s.x(j) - s.x(i)) * weight.transpose();
  }
  if (s.dimension == 1) return (Matrix2d() << of_v(0, 0) / of_x(0, 0), 0, 0, 0).finished();
  const double half = 0.5 * of_x.trace();
  if (of_x.determinant() <= 0.15 * half * half) return Matrix2d::Zero();  // the least spread of density.cpp
  return of_v * of_x.inverse();
}

inline double limiter(double ratio) { return std::max(0.0, std::min(1.0, ratio)); }

// v_r - v_l of the normal velocity f = v . n, left = j, right = i (2.57, corrected); unlimited fluxes take
// f_i - f_j.
inline double normal_jump(const Direct& s, size_t i, size_t j) {
  const Vector2d x_ij = s.x(i) - s.x(j), n = x_ij.normalized();
  const double f_ij = (s.v(i) - s.v(j)).dot(n);
  if (!reconstructs(s.flux) || f_ij == 0) return f_ij;
  const double plus = n.dot(s.gradient[j] * x_ij) / f_ij, minus = n.dot(s.gradient[i] * x_ij) / f_ij;
  const double left = s.v(j).dot(n) + limiter(plus) * f_ij / 2,
               right = s.v(i).dot(n) - limiter(minus) * f_ij / 2;
  return right - left;
}

// sum m_j (rho_j - rho_i) G_ij L
inline Vector2d direct_depth_gradient(const Direct& s, size_t i) {
  Vector2d of_rho = Vector2d::Zero();
  Matrix2d of_x = Matrix2d::Zero();
  for (size_t j = 0; j < s.grains.size(); ++j) {
    const Vector2d weight = s.grains[j].m * s.slope(i, j, s.h[i]);
    of_rho += (s.rho[j] - s.rho[i]) * weight;
    of_x += (s.x(j) - s.x(i)) * weight.transpose();
  }
  if (s.dimension == 1) return {of_rho.x() / of_x(0, 0), 0};
  const double half = 0.5 * of_x.trace();
  if (of_x.determinant() <= 0.15 * half * half) return Vector2d::Zero();
  return of_x.transpose().inverse() * of_rho;
}

// d* of Toro's two-shock solver on the two-rarefaction estimate (2.56), left = j, right = i; the
// reconstructed states with the ratio form of the limiter as the thesis prints it (2.57).
inline double direct_two_shock(const Direct& s, size_t i, size_t j) {
  const Vector2d x_ij = s.x(i) - s.x(j);
  double left = s.rho[j], right = s.rho[i];
  const double f = right - left;
  if (s.flux == Flux::two_shock_muscl && f != 0) {
    const double plus = s.depth_gradient[j].dot(x_ij) / f, minus = s.depth_gradient[i].dot(x_ij) / f;
    left += limiter(plus) * f / 2;
    right -= limiter(minus) * f / 2;
  }
  const double u_lr = i == j ? 0 : -normal_jump(s, i, j), g = s.gravity;
  const double c0 = 0.5 * (std::sqrt(g * left) + std::sqrt(g * right)) + 0.25 * u_lr;
  if (c0 <= 0) return 0;
  const double d0 = c0 * c0 / g, g_l = std::sqrt(g * (d0 + left) / (2 * d0 * left)),
               g_r = std::sqrt(g * (d0 + right) / (2 * d0 * right));
  return std::max(0.0, (g_l * left + g_r * right + u_lr) / (g_l + g_r));
}

// Artificial viscosity (2.53), corrected: approaching pairs, mean rho, c, h; a = strength, b = 2.
inline double direct_viscosity(const Direct& s, size_t i, size_t j) {
  const Vector2d x_ij = s.x(i) - s.x(j);
  const double closing = (s.v(i) - s.v(j)).dot(x_ij), h = 0.5 * (s.h[i] + s.h[j]),
               rho = 0.5 * (s.rho[i] + s.rho[j]);
  if (closing >= 0) return 0;
  const double mu = h * closing / (x_ij.squaredNorm() + 0.01 * h * h);
  const double c = 0.5 * (std::sqrt(s.gravity * s.rho[i]) + std::sqrt(s.gravity * s.rho[j]));
  return (-s.strength * c * mu + 2 * mu * mu) / rho;
}

inline double direct_pi(const Direct& s, size_t i, size_t j) {
  if (s.flux == Flux::none || riemann(s.flux) || i == j) return 0;
  if (s.flux == Flux::viscosity) return direct_viscosity(s, i, j);
  const double celerity = 0.5 * (std::sqrt(s.gravity * s.rho[i]) + std::sqrt(s.gravity * s.rho[j]));
  return -s.strength * celerity * normal_jump(s, i, j) / (0.5 * (s.rho[i] + s.rho[j]));
}

// t_i = sum m_j {[g/(2 alpha_i) + Pi/2] G_ij(h_i) + [g/(2 alpha_j) + Pi/2] G_ij(h_j)}
inline Vector2d direct_force(const Direct& s, size_t i) {
  Vector2d t(0, 0);
  for (size_t j = 0; j < s.grains.size(); ++j) {
    const double half_pi = 0.5 * direct_pi(s, i, j), star = riemann(s.flux) ? direct_two_shock(s, i, j) : 0;
    const auto pressure = [&](size_t k) {  // p / (rho^2 alpha), at the pair's contact with p* = g d*^2 / 2
      const double share = riemann(s.flux) ? star * star / (s.rho[k] * s.rho[k]) : 1;
      return share * s.gravity / (2 * s.alpha[k]) + half_pi;
    };
    t += s.grains[j].m * (pressure(i) * s.slope(i, j, s.h[i]) + pressure(j) * s.slope(i, j, s.h[j]));
  }
  return t;
}

// max_j |v_ij . n| over the particles within both supports
inline double direct_signal(const Direct& s, size_t i) {
  double fastest = 0;
  for (size_t j = 0; j < s.grains.size(); ++j) {
    const Vector2d x_ij = s.x(i) - s.x(j);
    if (j != i && x_ij.norm() < 2 * std::max(s.h[i], s.h[j]))
      fastest = std::max(fastest, std::abs((s.v(i) - s.v(j)).dot(x_ij.normalized())));
  }
  return fastest;
}

}  // namespace freshet::test
