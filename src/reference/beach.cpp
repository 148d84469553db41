#include "src/reference/beach.hpp"

#include <algorithm>
#include <cmath>

namespace freshet {
namespace {

// Numbers of the transform, all without units: wave numbers to the end of the spectrum of any hump that does
// not break, nodes in sigma (the root of the depth) to far beyond the humps.
constexpr int wave_numbers = 400, nodes = 2000;
constexpr double wave_step = 0.2, farthest = 3.6;  // of the sum over k; sigma
constexpr int most_iterations = 60;

struct Node {
  double x, depth, u;  // units of the transform
};

// phi = 2 int F(k) J0(k sigma) sin(k lambda / 2) dk solves 4 sigma phi_ll = (sigma phi_s)_s; then
// u = int k F J1 sin dk / sigma, level = phi_lambda - u^2 / 2, where sigma^2 = x + level and lambda = t - u.
class Hodograph {
 public:
  explicit Hodograph(const Beach& beach) : spectrum_(wave_numbers) {
    constexpr double ds = farthest / nodes;
    for (int i = 0; i < wave_numbers; ++i) {
      double sum = 0;
      for (int j = 0; j < nodes; ++j) {  // midpoints: the integrand falls off at both ends
        const double s = (j + 0.5) * ds;
        sum += start(beach, s * s) * s * ::j0(wave(i) * s) * ds;
      }
      spectrum_[static_cast<std::size_t>(i)] = sum * wave(i) * wave_step;
    }
  }

  // The state at depth sigma^2 and time t: lambda = t - u by fixed-point iteration, which contracts unless
  // the wave breaks.
  Node at(double sigma, double t) const {
    double u = 0;
    for (int n = 0; n < most_iterations; ++n) {
      const double next = velocity(sigma, t - u), change = std::abs(next - u);
      u = next;
      if (change < 1e-13) break;
    }
    return {sigma * sigma - level(sigma, t - u, u), sigma * sigma, u};
  }

 private:
  static double wave(int i) { return (i + 0.5) * wave_step; }
  static double start(const Beach& beach, double s) {
    double level = 0;
    for (const BeachHump& hump : beach.humps)
      level += hump.height * std::exp(-hump.steepness * (s - hump.at) * (s - hump.at));
    return level;
  }

  double velocity(double sigma, double lambda) const {
    double sum = 0;
    for (int i = 0; i < wave_numbers; ++i) {
      const double k = wave(i), j1_by_sigma = sigma > 0 ? ::j1(k * sigma) / sigma : 0.5 * k;
      sum += spectrum_[static_cast<std::size_t>(i)] * j1_by_sigma * std::sin(0.5 * k * lambda);
    }
    return sum;
  }
  double level(double sigma, double lambda, double u) const {
    double sum = 0;
    for (int i = 0; i < wave_numbers; ++i)
      sum +=
          spectrum_[static_cast<std::size_t>(i)] * ::j0(wave(i) * sigma) * std::cos(0.5 * wave(i) * lambda);
    return sum - 0.5 * u * u;
  }

  std::vector<double> spectrum_;  // k F(k) dk
};

class BeachWave : public Exact {
 public:
  BeachWave(const Beach& beach, double gravity)
      : hodograph_(beach), slope_(beach.slope), length_(beach.length),
        speed_(std::sqrt(gravity * beach.slope * beach.length)) {}

  FlowState at(double x, double, double t) const override {
    if (t != time_ || profile_.empty()) make_profile(t);
    const double place = x / length_;
    const auto next = std::lower_bound(profile_.begin(), profile_.end(), place,
                                       [](const Node& n, double p) { return n.x < p; });
    if (next == profile_.begin()) return {0, profile_[0].u * speed_, 0};
    if (next == profile_.end()) return {slope_ * x, 0, 0};  // beyond the waves
    const Node &a = *(next - 1), &b = *next;
    const double f = (place - a.x) / (b.x - a.x);
    return {(a.depth + f * (b.depth - a.depth)) * slope_ * length_, (a.u + f * (b.u - a.u)) * speed_, 0};
  }

  Shore shore(double t) const {
    const Node edge = hodograph_.at(0, t * speed_ / length_);
    return {edge.x * length_, edge.u * speed_};
  }

 private:
  void make_profile(double t) const {
    profile_.clear();
    for (int j = 0; j <= nodes; ++j)
      profile_.push_back(hodograph_.at(farthest * j / nodes, t * speed_ / length_));
    time_ = t;
  }

  Hodograph hodograph_;
  double slope_, length_, speed_;  // 1, m, m/s
  mutable double time_ = 0;        // s, of the profile
  mutable std::vector<Node> profile_;
};

}  // namespace

std::unique_ptr<Exact> beach_wave(const Beach& beach, double gravity) {
  return std::make_unique<BeachWave>(beach, gravity);
}

Shore beach_shore(const Beach& beach, double gravity, double t) { return BeachWave(beach, gravity).shore(t); }

}  // namespace freshet
