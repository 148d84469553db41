// A second opinion on flows along a channel: the shallow water equations of unit width over a bed with
// Manning friction, by finite volumes. MUSCL with minmod, hydrostatic reconstruction (Audusse et al. 2004),
// HLL flux, Heun in time: nothing in common with the particles. tests/unit/reference/channel.cpp holds it
// against exact solutions.
#pragma once
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace freshet::test {

struct Channel {
  double low, high;  // m, walls at both ends
  int cells;
  double gravity, manning;                          // m/s2, s/m^(1/3)
  std::function<double(double)> bed, depth, speed;  // m, m at t = 0, m/s at t = 0 (absent = at rest)
  std::function<double(double)>
      inflow{};  // m2/s into the low end, as a function of t; enters at critical depth
};

class ChannelFlow {
 public:
  explicit ChannelFlow(const Channel& channel) : c_(channel), dx_((c_.high - c_.low) / c_.cells) {
    for (auto* all : {&bed_, &velocity_, &surface_, &now_.depth, &now_.discharge}) all->resize(size());
    for (int i = 0; i < c_.cells; ++i) {
      bed_[at(i)] = c_.bed(x(i));
      now_.depth[at(i)] = std::max(0.0, c_.depth(x(i)));
      now_.discharge[at(i)] = c_.speed ? now_.depth[at(i)] * c_.speed(x(i)) : 0;
    }
    reflect(bed_, 1);
  }

  double time() const { return t_; }  // s
  double depth(double place) const { return between(now_.depth, place); }
  double discharge(double place) const { return between(now_.discharge, place); }   // m2/s
  double level(double place) const { return depth(place) + between(bed_, place); }  // m
  // Water beyond a place [m2].
  double volume_beyond(double place) const {
    double sum = 0;
    for (int i = 0; i < c_.cells; ++i)
      if (x(i) > place) sum += now_.depth[at(i)] * dx_;
    return sum;
  }
  // Highest bed level [m] under more than `least` of water.
  double highest_wet_bed(double least) const {
    double highest = -1e300;
    for (int i = 0; i < c_.cells; ++i)
      if (now_.depth[at(i)] > least) highest = std::max(highest, bed_[at(i)]);
    return highest;
  }

  // One step, but not beyond `end`.
  void step(double end) {
    const double dt = std::min(0.4 * dx_ / fastest(), end - t_);
    feed_ = c_.inflow ? c_.inflow(t_) : 0;
    ahead_ = now_;
    advance(ahead_, dt);
    advance(ahead_, dt);
    for (std::size_t i = 0; i < size(); ++i) {
      now_.depth[i] = std::max(0.0, 0.5 * (now_.depth[i] + ahead_.depth[i]));
      now_.discharge[i] = slowed(0.5 * (now_.discharge[i] + ahead_.discharge[i]), now_.depth[i], dt);
    }
    t_ = end - t_ <= dt ? end : t_ + dt;
  }

 private:
  static constexpr int ghosts = 2;
  static constexpr double dry = 1e-6;  // m: thinner water does not move
  using Cells = std::vector<double>;
  struct Water {
    Cells depth, discharge;  // m, m2/s
  };
  struct Sides {
    Cells left, right;  // values at a cell's two sides
  };

  std::size_t size() const { return static_cast<std::size_t>(c_.cells + 2 * ghosts); }
  static std::size_t at(int cell) { return static_cast<std::size_t>(cell + ghosts); }
  double x(int cell) const { return c_.low + (cell + 0.5) * dx_; }

  double between(const Cells& all, double place) const {
    const double from = std::clamp((place - c_.low) / dx_ - 0.5, 0.0, c_.cells - 1.0);
    const int cell = std::min(static_cast<int>(from), c_.cells - 2);
    return all[at(cell)] + (from - cell) * (all[at(cell + 1)] - all[at(cell)]);
  }

  void reflect(Cells& all, double sign) const {
    for (int k = 0; k < ghosts; ++k) {
      all[at(-1 - k)] = sign * all[at(k)];
      all[at(c_.cells + k)] = sign * all[at(c_.cells - 1 - k)];
    }
  }

  static double speed(double depth, double discharge) { return depth > dry ? discharge / depth : 0; }

  double fastest() const {
    double most = c_.inflow ? 5.0 : 1e-9;  // m/s: a dry channel must notice that inflow begins
    for (std::size_t i = 0; i < size(); ++i)
      most = std::max(
          most, std::abs(speed(now_.depth[i], now_.discharge[i])) + std::sqrt(c_.gravity * now_.depth[i]));
    return most;
  }

  static void reconstruct(const Cells& all, Sides& s) {
    s.left = s.right = all;
    for (std::size_t i = 1; i + 1 < all.size(); ++i) {
      const double below = all[i] - all[i - 1], above = all[i + 1] - all[i];
      const double slope = below * above <= 0 ? 0 : std::abs(below) < std::abs(above) ? below : above;
      s.left[i] -= slope / 2;
      s.right[i] += slope / 2;
    }
  }

  struct Flux {
    double mass, momentum;  // m2/s, m3/s2
  };
  Flux hll(double dl, double ul, double dr, double ur) const {
    const double g = c_.gravity, cl = std::sqrt(g * dl), cr = std::sqrt(g * dr);
    const double sl = std::min({ul - cl, ur - cr, 0.0}), sr = std::max({ul + cl, ur + cr, 0.0}),
                 width = std::max(sr - sl, 1e-12);
    const Flux l{dl * ul, dl * ul * ul + 0.5 * g * dl * dl}, r{dr * ur, dr * ur * ur + 0.5 * g * dr * dr};
    return {(sr * l.mass - sl * r.mass + sl * sr * (dr - dl)) / width,
            (sr * l.momentum - sl * r.momentum + sl * sr * (dr * ur - dl * ul)) / width};
  }

  // The state before the low end where water is let in.
  void feed(Water& w) const {
    for (int k = 0; k < ghosts; ++k) {
      w.depth[at(-1 - k)] = std::cbrt(feed_ * feed_ / c_.gravity);
      w.discharge[at(-1 - k)] = feed_;
    }
  }

  // What the water at hand looks like at the sides of its cells.
  void look(Water& w) {
    reflect(w.depth, 1);
    reflect(w.discharge, -1);
    if (feed_ > 0) feed(w);
    for (std::size_t i = 0; i < size(); ++i) {
      velocity_[i] = speed(w.depth[i], w.discharge[i]);
      surface_[i] = w.depth[i] + bed_[i];
    }
    reconstruct(w.depth, d_);
    reconstruct(velocity_, u_);
    reconstruct(surface_, z_);
  }

  // Explicit Euler without friction.
  void advance(Water& w, double dt) {
    look(w);
    for (int face = 0; face <= c_.cells; ++face) cross(at(face - 1), at(face), w, dt / dx_);
    for (int cell = 0; cell < c_.cells; ++cell) {
      const std::size_t i = at(cell);
      const double rise = (z_.right[i] - d_.right[i]) - (z_.left[i] - d_.left[i]);
      w.discharge[i] -= dt / dx_ * c_.gravity * 0.5 * (d_.left[i] + d_.right[i]) * rise;
      w.depth[i] = std::max(0.0, w.depth[i]);
    }
  }

  // What goes through the face from cell l to cell r; ratio = dt/dx.
  void cross(std::size_t l, std::size_t r, Water& w, double ratio) const {
    const double bed = std::max(z_.right[l] - d_.right[l], z_.left[r] - d_.left[r]),
                 half_g = 0.5 * c_.gravity;
    const double dl = std::max(0.0, z_.right[l] - bed), dr = std::max(0.0, z_.left[r] - bed);
    Flux flux = hll(dl, u_.right[l], dr, u_.left[r]);
    if (feed_ > 0 && r == at(0)) flux.mass = feed_;
    w.depth[l] -= ratio * flux.mass;
    w.depth[r] += ratio * flux.mass;
    w.discharge[l] -= ratio * (flux.momentum + half_g * (d_.right[l] * d_.right[l] - dl * dl));
    w.discharge[r] += ratio * (flux.momentum + half_g * (d_.left[r] * d_.left[r] - dr * dr));
  }

  // Manning friction, implicit.
  double slowed(double discharge, double depth, double dt) const {
    if (depth <= dry) return 0;
    const double k = c_.gravity * c_.manning * c_.manning / std::pow(depth, 7.0 / 3.0);
    return 2 * discharge / (1 + std::sqrt(1 + 4 * k * dt * std::abs(discharge)));
  }

  Channel c_;
  double dx_, t_ = 0, feed_ = 0;
  Cells bed_, velocity_, surface_;
  Water now_, ahead_;
  Sides d_, u_, z_;  // depth, velocity, surface
};

}  // namespace freshet::test
