// Open boundaries (docs/formulas/sisph.md (I28) to (I31)): particles behind the line (the rim) hold a state
// that is found anew each step, at their own place:
//   R = v.n + 2 c of the characteristic that leaves, traced back from the rim particle (any Courant number),
//   plus the bed's slope and the friction on its way, (v.n + dt g S0.n) / (1 + dt gamma) in the velocity
//   part; depth and velocity from R and the law of the boundary at time t + s / c, s the distance behind the
//   line; an imposed level falls along the flow with the slope of friction, so that uniform flow stays
//   uniform.
// n points outwards. The rim's level is Dirichlet's condition of the matrix. Its velocity in the fluxes is
// the one before the pressure at n+1, v^{n+1} + theta g dt grad eta / (1 + dt gamma).
#pragma once
#include <vector>

#include "kernels/sisph/open/rim_laws.hpp"
#include "kernels/sisph/surface/surface.hpp"

namespace freshet::sisph {

template <int D>
struct RimPlace {
  int particle, opening;
  double outside;    // m, behind the line
  double width;      // m of the line that it stands for, in the first row behind it; else 0
  Vec<double, D> n;  // outwards
};

// The water as it is traced.
template <int D>
struct TracedWater {
  Rows rows;
  VecField<double, D> x;
  Layer<D> water;
  Field<double> g_n2;  // g n^2 of the friction; empty without
  double gravity, spacing;
};

// What the rim's velocities in the fluxes are made of.
template <int D>
struct RimPush {
  VecField<double, D> v, slope;  // at n; grad eta
  double theta, impulse;         // impulse: theta g dt
  Field<double> drag;            // dt gamma, or empty
};

template <int D>
class OpenRim {
 public:
  OpenRim(std::vector<LawInTime> laws, const std::vector<RimPlace<D>>& places, const TracedWater<D>& traced);

  // The rim's state at t + dt from the water at t.
  void find(const TracedWater<D>& traced, double t, double dt);
  // Into the surface's iterate: level and depth at n+1.
  void impose(const Field<double>& bed, const Field<double>& level, const Field<double>& depth) const;
  // grad eta of the rim.
  void extend(const TracedWater<D>& traced, const VecField<double, D>& slope) const;
  // Into the velocity before the pressure: theta (v' + impulse slope) + (1 - theta) v.
  void set_before(const RimPush<D>& push, const VecField<double, D>& before) const;
  void set_end(const VecField<double, D>& end) const;
  // Adds what the laws' states carry through the lines in a step: a trapezium, a rectangle in the first one.
  void account(double dt);
  OpenFlux flux() const;  // since t = 0: what the water that crosses is held against
  int size() const { return count_; }

  // The restart state: slow means of v.n and c at the feet; the flux since t = 0 and that of the last step's
  // end.
  std::vector<double> means() const { return laws_.means(); }
  void set_means(const std::vector<double>& means) { laws_.set_means(means); }
  std::vector<double> fluxes() const;
  void set_fluxes(const std::vector<double>& fluxes);

  // Part of find().
  void turn_velocities();

 private:
  int count_;
  RimLaws laws_;
  Field<int> particle_;
  VecField<double, D> n_, velocity_;             // velocity_: at n+1
  Field<double> foot_depth_, foot_out_, depth_;  // of the foot: depth, v.n with sources; depth_: at n+1
  VecField<double, D> foot_v_;
  Field<double> width_;                   // m, of the line
  Kokkos::View<OpenFlux*, Memory> flux_;  // since t = 0; of the last step's end, m3/s
  bool started_ = false;                  // there was a step
};

}  // namespace freshet::sisph
