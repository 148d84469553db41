// perf_finite_volumes [CELLS ...]: the circular dam break of cases/dam_break_radial.toml by finite volumes on
// a Cartesian grid, one thread: what a mesh code of equal cost reaches. MUSCL with the monotonised central
// limiter in depth and velocity, HLL flux, Heun in time, Courant number 0.45. For each number of cells along
// a side prints cells, steps, seconds of processor time of the time loop (one thread), and the errors of the
// depth within 640 m of the centre at 50 s against the radial reference of the same case: relative L1 and L2.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "src/reference/radial.hpp"

namespace {

constexpr double gravity = 9.81, half_box = 643.5, end_time = 50, courant = 0.45, compared = 640;
constexpr freshet::RadialDam dam{10, 5, 100};

template <class T>
T least(T a, T b) {
  return b < a ? b : a;
}
template <class T>
T most(T a, T b) {
  return a < b ? b : a;
}

// Depth [m] and discharges per width [m2/s], with two cells more on each side.
struct Water {
  std::vector<double> d, p, q;
  explicit Water(std::size_t cells) : d(cells), p(cells), q(cells) {}
};

// Half of the limited difference across a cell, monotonised central.
double half_slope(double a, double b, double c) {
  const double left = 2 * (b - a), right = 2 * (c - b), middle = 0.5 * (c - a);
  const double up = most(0.0, least(middle, least(left, right))),
               down = least(0.0, most(middle, most(left, right)));
  return 0.5 * (up + down);
}

struct Flux {
  double d, n, t;  // of depth, normal and tangential discharge
};

Flux hll(double dl, double ul, double vl, double dr, double ur, double vr) {
  const double cl = std::sqrt(gravity * dl), cr = std::sqrt(gravity * dr);
  const double sl = least(0.0, least(ul - cl, ur - cr)), sr = most(0.0, most(ul + cl, ur + cr)),
               per = 1 / (sr - sl);
  const double fl = dl * ul, fr = dr * ur, gl = fl * ul + 0.5 * gravity * dl * dl,
               gr = fr * ur + 0.5 * gravity * dr * dr;
  const double mass = (sr * fl - sl * fr + sl * sr * (dr - dl)) * per;
  return {mass, (sr * gl - sl * gr + sl * sr * (fr - fl)) * per, mass > 0 ? mass * vl : mass * vr};
}

class Grid {
 public:
  explicit Grid(int n)
      : n_(n), wide_(n + 4), dx_(2 * half_box / n), now_(size()), next_(size()), rate_(size()) {
    for (int j = 0; j < wide_; ++j)
      for (int i = 0; i < wide_; ++i) {
        const double x = centre(i), y = centre(j);
        now_.d[at(i, j)] = x * x + y * y < dam.radius * dam.radius ? dam.inner : dam.outer;
      }
  }

  int run() {
    int steps = 0;
    for (double t = 0; t < end_time; ++steps) {
      const double dt = least(stable_dt(), end_time - t);
      find_rates(now_);
      add(now_, dt, next_);
      find_rates(next_);
      add(next_, dt, next_);
      average();
      t = end_time - t <= dt ? end_time : t + dt;
    }
    return steps;
  }

  // Relative L1 and L2 of the depth against the reference.
  std::array<double, 2> errors(const freshet::RadialProfile& exact) const {
    double l1 = 0, l2 = 0, sum = 0, squares = 0;
    for (int j = 2; j < n_ + 2; ++j)
      for (int i = 2; i < n_ + 2; ++i) {
        const double x = centre(i), y = centre(j);
        if (x * x + y * y >= compared * compared) continue;
        const double depth = exact.at(x, y).depth, off = now_.d[at(i, j)] - depth;
        l1 += std::abs(off), l2 += off * off, sum += depth, squares += depth * depth;
      }
    return {l1 / sum, std::sqrt(l2 / squares)};
  }

 private:
  std::size_t size() const { return static_cast<std::size_t>(wide_) * static_cast<std::size_t>(wide_); }
  std::size_t at(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(wide_) + static_cast<std::size_t>(i);
  }
  double centre(int i) const { return (i - 1.5) * dx_ - half_box; }

  double stable_dt() const {
    double fastest = 0;
    for (std::size_t k = 0; k < size(); ++k) {
      const double per = 1 / now_.d[k], c = std::sqrt(gravity * now_.d[k]);
      fastest = most(fastest, c + most(std::abs(now_.p[k]), std::abs(now_.q[k])) * per);
    }
    return courant * dx_ / fastest;
  }

  // The fluxes through the faces along a direction (step: from a cell to the next), added to the rates of
  // both sides. The outer two cells keep their state: nothing reaches them. n, t: normal and tangential
  // velocity.
  void add_fluxes(const double* d, const double* n, const double* t, std::size_t step, double* rate_n,
                  double* rate_t) {
    const std::size_t faces = static_cast<std::size_t>(step == 1 ? n_ + 1 : n_);
    const double per = 1 / dx_;
    double* __restrict fd = flux_d_.data(), * __restrict fn = flux_n_.data(), * __restrict ft = flux_t_.data();
    double* rate_d = rate_.d.data();
    for (int j = 2; j < n_ + 2; ++j) {
      const std::size_t first = at(2, j);
      for (std::size_t i = 0; i < faces; ++i) {
        const std::size_t r = first + i, l = r - step, ll = l - step, rr = r + step;
        const Flux f = hll(d[l] + half_slope(d[ll], d[l], d[r]), n[l] + half_slope(n[ll], n[l], n[r]),
                           t[l] + half_slope(t[ll], t[l], t[r]), d[r] - half_slope(d[l], d[r], d[rr]),
                           n[r] - half_slope(n[l], n[r], n[rr]), t[r] - half_slope(t[l], t[r], t[rr]));
        fd[i] = per * f.d, fn[i] = per * f.n, ft[i] = per * f.t;
      }
      for (std::size_t i = 0; i < faces; ++i)
        rate_d[first + i - step] -= fd[i], rate_n[first + i - step] -= fn[i],
            rate_t[first + i - step] -= ft[i];
      for (std::size_t i = 0; i < faces; ++i)
        rate_d[first + i] += fd[i], rate_n[first + i] += fn[i], rate_t[first + i] += ft[i];
    }
  }

  void find_rates(const Water& w) {
    for (std::vector<double>* r : {&rate_.d, &rate_.p, &rate_.q}) r->assign(size(), 0.0);
    for (std::vector<double>* f : {&flux_d_, &flux_n_, &flux_t_}) f->resize(static_cast<std::size_t>(wide_));
    for (std::vector<double>* v : {&u_, &v_}) v->resize(size());
    for (std::size_t k = 0; k < size(); ++k) u_[k] = w.p[k] / w.d[k], v_[k] = w.q[k] / w.d[k];
    add_fluxes(w.d.data(), u_.data(), v_.data(), 1, rate_.p.data(), rate_.q.data());
    add_fluxes(w.d.data(), v_.data(), u_.data(), static_cast<std::size_t>(wide_), rate_.q.data(),
               rate_.p.data());
  }

  void add(const Water& from, double dt, Water& to) const {
    for (int j = 2; j < n_ + 1; ++j)
      for (std::size_t k = at(2, j); k < at(n_ + 2, j); ++k) {
        to.d[k] = from.d[k] + dt * rate_.d[k];
        to.p[k] = from.p[k] + dt * rate_.p[k];
        to.q[k] = from.q[k] + dt * rate_.q[k];
      }
    keep_rim(from, to);
  }

  void keep_rim(const Water& from, Water& to) const {
    for (int j = 0; j < wide_; ++j)
      for (int i = 0; i < wide_; ++i) {
        if (j >= 2 && j < n_ + 1 && i == 2) i = n_ + 2;
        to.d[at(i, j)] = from.d[at(i, j)], to.p[at(i, j)] = from.p[at(i, j)],
                   to.q[at(i, j)] = from.q[at(i, j)];
      }
  }

  void average() {
    for (std::size_t k = 0; k < size(); ++k) {
      now_.d[k] = 0.5 * (now_.d[k] + next_.d[k]);
      now_.p[k] = 0.5 * (now_.p[k] + next_.p[k]);
      now_.q[k] = 0.5 * (now_.q[k] + next_.q[k]);
    }
  }

  int n_, wide_;
  double dx_;
  Water now_, next_, rate_;
  std::vector<double> flux_d_, flux_n_, flux_t_, u_, v_;
};

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> sizes;
  for (int k = 1; k < argc; ++k) sizes.push_back(std::atoi(argv[k]));
  if (sizes.empty()) sizes = {117, 234, 468};
  const freshet::RadialProfile exact = freshet::radial_dam_profile(dam, end_time, gravity);
  std::printf("cells,steps,seconds,depth_l1_rel,depth_l2_rel\n");
  for (const int n : sizes) {
    Grid grid(n);
    const std::clock_t start = std::clock();
    const int steps = grid.run();
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    const auto [l1, l2] = grid.errors(exact);
    std::printf("%d,%d,%.4g,%.6g,%.6g\n", n * n, steps, seconds, l1, l2);
  }
}
