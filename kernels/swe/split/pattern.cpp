#include "kernels/swe/split/pattern.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernels/swe/particles.hpp"

namespace freshet::swe {
namespace {

constexpr int nodes = 24;

// Gauss-Legendre on [-1, 1]; the roots of P_n by Newton.
struct Gauss {
  std::array<double, nodes> at{}, weight{};
  Gauss() {
    for (int k = 0; k < nodes; ++k) {
      double x = std::cos(pi * (k + 0.75) / (nodes + 0.5)), slope = 1;
      for (int turns = 0; turns < 100; ++turns) {
        double before = 1, here = x;
        for (int n = 2; n <= nodes; ++n)
          std::swap(before, here), here = ((2 * n - 1) * x * before - (n - 1) * here) / n;
        slope = nodes * (x * here - before) / (x * x - 1);
        x -= here / slope;
      }
      at[k] = x;
      weight[k] = 2 / ((1 - x * x) * slope * slope);
    }
  }
};

// Integral over [low, high], cut where the integrand's pieces meet.
template <class F>
double integral(double low, double high, std::vector<double> cuts, const F& f) {
  static const Gauss gauss;
  cuts.push_back(low), cuts.push_back(high);
  for (double& cut : cuts) cut = std::clamp(cut, low, high);
  std::sort(cuts.begin(), cuts.end());
  double sum = 0;
  for (std::size_t p = 0; p + 1 < cuts.size(); ++p) {
    const double half = 0.5 * (cuts[p + 1] - cuts[p]), middle = 0.5 * (cuts[p + 1] + cuts[p]);
    if (half > 0)
      for (int k = 0; k < nodes; ++k) sum += half * gauss.weight[k] * f(middle + half * gauss.at[k]);
  }
  return sum;
}

template <int D>
double kernel(double r, double h) {
  return Kernel<D>::at(std::abs(r) / h).w / power<D>(h);
}

// The mean of W(|x - d|, h) over the circle |x| = r, times 2 pi.
double around(double r, double d, double h) {
  std::vector<double> cuts;
  for (const double q : {h, 2 * h}) {
    const double cosine = d > 0 && r > 0 ? (r * r + d * d - q * q) / (2 * r * d) : 2;
    if (std::abs(cosine) < 1) cuts.push_back(std::acos(cosine));
  }
  return 2 * integral(0, pi, cuts, [=](double a) {
           return kernel<2>(std::sqrt(std::max(0.0, r * r + d * d - 2 * r * d * std::cos(a))), h);
         });
}

// The corners of the pattern, in h_N.
template <int D>
std::vector<std::array<double, 2>> ring(double eps, double turn) {
  if (D == 1) return {{-eps, 0}, {eps, 0}};
  std::vector<std::array<double, 2>> corners;
  for (int k = 0; k < 6; ++k)
    corners.push_back({eps * std::cos(turn + k * pi / 3), eps * std::sin(turn + k * pi / 3)});
  return corners;
}

}  // namespace

template <>
double kernel_product<1>(double ha, double hb, double d) {
  return integral(-2 * ha, 2 * ha, {-ha, 0, ha, d - 2 * hb, d - hb, d, d + hb, d + 2 * hb},
                  [=](double x) { return kernel<1>(x, ha) * kernel<1>(x - d, hb); });
}

template <>
double kernel_product<2>(double ha, double hb, double d) {
  const std::vector<double> cuts{ha, d, d + hb, d + 2 * hb, std::abs(d - hb), std::abs(d - 2 * hb)};
  return integral(0, 2 * ha, cuts, [=](double r) { return r * kernel<2>(r, ha) * around(r, d, hb); });
}

template <int D>
SplitPattern split_pattern(int count, double alpha, double eps, double turn) {
  const auto corners = ring<D>(eps, turn);
  const double n = static_cast<double>(corners.size());
  const auto product = [](double ha, double hb, double d) { return kernel_product<D>(ha, hb, d); };
  const double c = product(1, 1, 0), b0 = product(1, alpha, 0), b1 = product(1, alpha, eps);
  const double a00 = product(alpha, alpha, 0), a01 = product(alpha, alpha, eps);
  double a11 = 0;
  for (const auto& corner : corners)
    a11 += product(alpha, alpha, std::hypot(corner[0] - corners[0][0], corner[1] - corners[0][1])) / n;
  const bool middle = count == static_cast<int>(corners.size()) + 1;
  const double best = (a00 - a01 - b0 + b1) / (a00 - 2 * a01 + a11),
               s = middle ? std::clamp(best, 0.0, 1.0) : 1.0;
  SplitPattern pattern;
  if (s < 1) pattern.daughters.push_back({{0, 0}, 1 - s});
  if (s > 0)
    for (const auto& corner : corners) pattern.daughters.push_back({{corner[0], corner[1]}, s / n});
  pattern.error =
      c - 2 * ((1 - s) * b0 + s * b1) + (1 - s) * (1 - s) * a00 + 2 * s * (1 - s) * a01 + s * s * a11;
  return pattern;
}

template SplitPattern split_pattern<1>(int, double, double, double);
template SplitPattern split_pattern<2>(int, double, double, double);

}  // namespace freshet::swe
