#include "src/reference/radial.hpp"

#include <algorithm>
#include <cmath>

namespace freshet {
namespace {

constexpr int ghosts = 2;
constexpr double cfl = 0.4;
constexpr double dry = 1e-9;  // of the deepest water: thinner water does not move

struct RadialWater {
  std::vector<double> depth, discharge;  // m, m2/s
};

struct Flux {
  double mass, momentum;  // m2/s, m3/s2
};

// Slope times width, zero at extremes (van Leer).
double limited(double left, double right) {
  return left * right > 0 ? 2 * left * right / (left + right) : 0.0;
}

// HLL flux with the wave speeds of two rarefactions, those of the exact dry fronts beside dry states.
Flux hll(double dl, double ul, double dr, double ur, double g) {
  const double cl = std::sqrt(g * dl), cr = std::sqrt(g * dr);
  const double u = 0.5 * (ul + ur) + cl - cr, c = std::max(0.0, 0.5 * (cl + cr) + 0.25 * (ul - ur));
  const double sl = dl > 0 ? std::min(ul - cl, dr > 0 ? u - c : ul - cl) : ur - 2 * cr;
  const double sr = dr > 0 ? std::max(ur + cr, dl > 0 ? u + c : ur + cr) : ul + 2 * cl;
  const Flux l{dl * ul, dl * ul * ul + 0.5 * g * dl * dl}, r{dr * ur, dr * ur * ur + 0.5 * g * dr * dr};
  if (sl >= 0) return l;
  if (sr <= 0) return r;
  const double width = 1 / (sr - sl);
  return {(sr * l.mass - sl * r.mass + sl * sr * (dr - dl)) * width,
          (sr * l.momentum - sl * r.momentum + sl * sr * (dr * ur - dl * ul)) * width};
}

class RadialSweep {
 public:
  RadialSweep(const std::function<double(double)>& initial, double extent, int rings, double gravity,
              bool plane = false)
      : plane_(plane), n_(rings), ring_(extent / rings), g_(gravity), now_(empty()), speed_(now_.depth),
        depth_slope_(now_.depth), speed_slope_(now_.depth), flux_(now_.depth.size()) {
    for (int k = 0; k < n_; ++k) now_.depth[at(k)] = mean(initial, k);
    least_ = dry * *std::max_element(now_.depth.begin(), now_.depth.end());
  }

  void run(double end) {
    for (double t = 0; t < end;) {
      prepare(now_);
      const double dt = std::min(cfl * ring_ / fastest(), end - t);
      heun(dt);
      t += dt;
    }
    prepare(now_);
  }

  RadialProfile profile() const {
    const auto inside = [this](const std::vector<double>& all) {
      return std::vector<double>(all.begin() + ghosts, all.end() - ghosts);
    };
    return {ring_, inside(now_.depth), inside(speed_)};
  }

 private:
  static std::size_t at(int k) { return static_cast<std::size_t>(k + ghosts); }
  double radius(int face) const { return plane_ ? 1 : face * ring_; }
  RadialWater empty() const {
    const std::vector<double> zero(static_cast<std::size_t>(n_ + 2 * ghosts));
    return {zero, zero};
  }

  // Mean over the ring, weighted by the circumference.
  double mean(const std::function<double(double)>& initial, int k) const {
    constexpr int parts = 16;
    double sum = 0, weight = 0;
    for (int p = 0; p < parts; ++p) {
      const double r = (k + (p + 0.5) / parts) * ring_;
      sum += initial(r) * (plane_ ? 1 : r);
      weight += plane_ ? 1 : r;
    }
    return sum / weight;
  }

  // Symmetric about the centre, constant beyond the rim; velocities and limited slopes.
  void prepare(RadialWater& w) {
    for (int k = 0; k < ghosts; ++k) {
      w.depth[at(-1 - k)] = w.depth[at(k)];
      w.discharge[at(-1 - k)] = -w.discharge[at(k)];
      w.depth[at(n_ + k)] = w.depth[at(n_ - 1)];
      w.discharge[at(n_ + k)] = w.discharge[at(n_ - 1)];
    }
    for (std::size_t k = 0; k < w.depth.size(); ++k)
      speed_[k] = w.depth[k] > least_ ? w.discharge[k] / w.depth[k] : 0.0;
    for (std::size_t k = 1; k + 1 < w.depth.size(); ++k) {
      depth_slope_[k] = limited(w.depth[k] - w.depth[k - 1], w.depth[k + 1] - w.depth[k]);
      speed_slope_[k] = limited(speed_[k] - speed_[k - 1], speed_[k + 1] - speed_[k]);
    }
  }

  double fastest() const {
    double most = 0;
    for (std::size_t k = 0; k < speed_.size(); ++k)
      most = std::max(most, std::abs(speed_[k]) + std::sqrt(g_ * now_.depth[k]));
    return most;
  }

  void find_fluxes(const RadialWater& w) {
    for (std::size_t k = ghosts; k < w.depth.size() - ghosts + 1; ++k)
      flux_[k] = hll(w.depth[k - 1] + 0.5 * depth_slope_[k - 1], speed_[k - 1] + 0.5 * speed_slope_[k - 1],
                     w.depth[k] - 0.5 * depth_slope_[k], speed_[k] - 0.5 * speed_slope_[k], g_);
  }

  // to = from + dt (-d(r F)/dr + source) / r; the pressure on the sides of the ring balances that on its ends
  // in still water.
  void advance(const RadialWater& from, double dt, RadialWater& to) {
    find_fluxes(from);
    for (int k = 0; k < n_; ++k) {
      const std::size_t i = at(k);
      const double in = radius(k), out = radius(k + 1), share = dt / (0.5 * (in + out) * ring_);
      const double side = plane_ ? 0 : 0.5 * g_ * from.depth[i] * from.depth[i] * ring_;
      to.depth[i] = std::max(0.0, from.depth[i] - share * (out * flux_[i + 1].mass - in * flux_[i].mass));
      to.discharge[i] =
          from.discharge[i] - share * (out * flux_[i + 1].momentum - in * flux_[i].momentum - side);
      if (to.depth[i] <= least_) to.discharge[i] = 0;
    }
  }

  void heun(double dt) {
    RadialWater ahead = now_;
    advance(now_, dt, ahead);
    prepare(ahead);
    advance(ahead, dt, ahead_);
    for (std::size_t k = 0; k < now_.depth.size(); ++k) {
      now_.depth[k] = 0.5 * (now_.depth[k] + ahead_.depth[k]);
      now_.discharge[k] = 0.5 * (now_.discharge[k] + ahead_.discharge[k]);
    }
  }

  bool plane_;  // else rings
  int n_;
  double ring_, g_, least_ = 0;
  RadialWater now_, ahead_ = empty();
  std::vector<double> speed_, depth_slope_, speed_slope_;
  std::vector<Flux> flux_;
};

// Seen from the uniform flow the hump starts at rest.
class Hump : public Exact {
 public:
  Hump(const GaussianHump& hump, double gravity, int rings) : hump_(hump), gravity_(gravity), rings_(rings) {}

  FlowState at(double x, double y, double t) const override {
    const double rx = x - hump_.x0 - hump_.u * t, ry = hump_.plane ? 0 : y - hump_.y0 - hump_.v * t;
    if (t <= 0) return {initial(std::hypot(rx, ry)), hump_.u, hump_.v};
    if (t != time_) solve(t);
    const FlowState state = profile_.at(rx, ry);
    return {state.depth, state.u + hump_.u, state.v + hump_.v};
  }

 private:
  double initial(double r) const {
    return hump_.level + hump_.amplitude * std::exp(-0.5 * r * r / (hump_.sigma * hump_.sigma));
  }
  // Seven sigma away the hump is below 3e-11 of itself; its waves are at most as fast as that of the highest
  // water.
  void solve(double t) const {
    const double extent =
        7 * hump_.sigma + 1.1 * std::sqrt(gravity_ * (hump_.level + std::max(0.0, hump_.amplitude))) * t;
    const auto start = [this](double r) { return initial(r); };
    profile_ = hump_.plane ? plane_flow(start, extent, t, rings_, gravity_)
                           : radial_flow(start, extent, t, rings_, gravity_);
    time_ = t;
  }

  GaussianHump hump_;
  double gravity_;
  int rings_;
  mutable double time_ = 0;  // s, of the profile
  mutable RadialProfile profile_;
};

class RadialDamBreak : public Exact {
 public:
  RadialDamBreak(const RadialDam& dam, double gravity, int rings)
      : dam_(dam), gravity_(gravity), rings_(rings) {}

  FlowState at(double x, double y, double t) const override {
    const double rx = x - dam_.x0, ry = y - dam_.y0;
    if (t <= 0) return {std::hypot(rx, ry) < dam_.radius ? dam_.inner : dam_.outer, 0, 0};
    if (t != time_) {
      profile_ = radial_dam_profile(dam_, t, gravity_, rings_);
      time_ = t;
    }
    return profile_.at(rx, ry);
  }

 private:
  RadialDam dam_;
  double gravity_;
  int rings_;
  mutable double time_ = 0;  // s, of the profile
  mutable RadialProfile profile_;
};

}  // namespace

FlowState RadialProfile::at(double rx, double ry) const {
  const double r = std::hypot(rx, ry), place = r / ring - 0.5;
  const int last = static_cast<int>(depth.size()) - 1;
  if (place >= last)
    return {depth.back(), speed.back() * (r > 0 ? rx / r : 0), speed.back() * (r > 0 ? ry / r : 0)};
  const int k = std::max(0, static_cast<int>(place));
  const auto i = static_cast<std::size_t>(k);
  if (place < 0) return {depth[0], speed[0] * rx / (0.5 * ring), speed[0] * ry / (0.5 * ring)};
  const double f = place - k, u = (1 - f) * speed[i] + f * speed[i + 1];
  return {(1 - f) * depth[i] + f * depth[i + 1], u * rx / r, u * ry / r};
}

double RadialProfile::front(double least_depth) const {
  for (std::size_t k = depth.size(); k-- > 0;)
    if (depth[k] >= least_depth) return (static_cast<double>(k) + 0.5) * ring;
  return 0;
}

RadialProfile radial_flow(const std::function<double(double)>& initial, double extent, double t, int rings,
                          double gravity) {
  RadialSweep sweep(initial, extent, rings, gravity);
  sweep.run(t);
  return sweep.profile();
}

RadialProfile plane_flow(const std::function<double(double)>& initial, double extent, double t, int rings,
                         double gravity) {
  RadialSweep sweep(initial, extent, rings, gravity, true);
  sweep.run(t);
  return sweep.profile();
}

std::unique_ptr<Exact> gaussian_hump(const GaussianHump& hump, double gravity, int rings) {
  return std::make_unique<Hump>(hump, gravity, rings);
}

// No wave is faster than the tip on a dry bed, 2 c.
RadialProfile radial_dam_profile(const RadialDam& dam, double t, double gravity, int rings) {
  const double extent = 1.02 * (dam.radius + 2 * std::sqrt(gravity * dam.inner) * t);
  return radial_flow([&dam](double r) { return r < dam.radius ? dam.inner : dam.outer; }, extent, t, rings,
                     gravity);
}

std::unique_ptr<Exact> radial_dam_break(const RadialDam& dam, double gravity, int rings) {
  return std::make_unique<RadialDamBreak>(dam, gravity, rings);
}

}  // namespace freshet
