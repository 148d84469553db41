// One incompressible step after the points have moved (docs/formulas/fpm.md (F13) to (F20)): second-order
// backward differences along the paths, pressure by projection. With r = dt / dt before (0 in the first
// step), c0 = (1 + r)^2 / (1 + 2 r), c1 = -r^2 / (1 + 2 r), tau = dt (1 + r) / (1 + 2 r):
//   q = fitted p, 0 on the surface;  v* = c0 v + c1 v_old + tau (-grad q / rho + nu lap v + f)
//   lap phi = rho (div v* - expansion) / tau;  walls: n . grad phi = rho n . v* / tau;  surface: phi = -q
//   v = v* - tau grad phi / rho, at walls held;  p = q + phi;  filtered: v next to walls and surface towards
//   its fit
// Viscosity taken implicitly: v* = ... + tau nu lap v* (viscosity.hpp). The term - rho nu div v* that (5.8)
// has in p then is left out: with it still water is not stable (e-fold in 0.15 s at nu = 1 m2/s).
#pragma once
#include "kernels/fpm/pressure/elliptic.hpp"
#include "kernels/fpm/pressure/pressure_scheme.hpp"
#include "kernels/fpm/pressure/viscosity.hpp"
#include "kernels/fpm/stencils/stencils.hpp"
#include "kernels/fpm/tank.hpp"

namespace freshet::fpm {

struct FlowRule {
  double density = 1000;   // kg/m3
  double viscosity = 0;    // m2/s
  Vec<double, 2> force{};  // m/s2
  PressureScheme scheme;
  bool slip = true;  // walls; false: they hold the tangential velocity too
  // of the pressure equation: of its right side, or 10 x this of the flow's velocities
  double tolerance = 1e-9;
  bool implicit = false;  // viscosity
};

// A flow's fields; scratch: those below the line.
struct Flow {
  VecField<double, 2> x, v, v_old;
  Field<double> p;
  Field<double> phi;               // the last change of p: the first guess of the next
  Field<int> kind, side, surface;  // PointMarks
  // ----
  VecField<double, 2> v_star, normal;
  Field<double> q, source, flux, value;
  Field<int> row;
  int points = 0;
  double expansion = 0;  // 1/s, divergence that v is given; 0 but where area is to be given back

  void declare(const FieldList& field) {
    field(x, "x", "y", "m", Carry::state);
    field(v, "u", "v", "m/s", Carry::state);
    field(v_old, "u_old", "v_old", "m/s", Carry::state);
    field(p, "p", "Pa", Carry::state);
    field(phi, "phi", "Pa", Carry::state);
    field(v_star, "u_star", "v_star", "m/s", Carry::no);
    field(normal, "normal_x", "normal_y", "1", Carry::no);
    field(q, "q", "Pa", Carry::no);
    field(value, "given", "Pa", Carry::no);
    field(source, "source", "Pa/m2", Carry::no);
    field(flux, "flux", "Pa/m", Carry::no);
    field(row, "row", "1", Carry::no);
  }
};

// The velocity [m/s] of point i that walls leave of v: without its part through the wall, nothing in corners
// and where walls do not slip.
KOKKOS_FORCEINLINE_FUNCTION Vec<double, 2> held(const Flow& flow, int i, const Vec<double, 2>& v, bool slip) {
  if (flow.kind(i) == in_fluid) return v;
  const Vec<double, 2> n = at(flow.normal, i);
  return slip && flow.kind(i) == on_wall ? v - dot(v, n) * n : Vec<double, 2>{};
}

// Factors of the backward difference.
struct Backward {
  double c0, c1, tau;
  Backward(double dt, double ratio)
      : c0((1 + ratio) * (1 + ratio) / (1 + 2 * ratio)), c1(-ratio * ratio / (1 + 2 * ratio)),
        tau(dt * (1 + ratio) / (1 + 2 * ratio)) {}
};

struct ProjectionReport {
  PoissonReport poisson;
  linear::BiCgStabReport viscosity;  // where it is implicit
  int poor = 0;                      // points whose neighbours do not determine all derivatives
  int limited = 0;                   // points whose speed was held to the largest around (spray.hpp)
};

// x += dt (v + r/2 (v - v_old)), to second order where the accelerations of this step are those of the last;
// wrapped into the period.
void advect(const Flow& flow, const Period& period, double dt, double ratio);

// The fastest point [m/s].
double fastest(const Flow& flow);

class Projection {
 public:
  Projection(const FlowRule& rule, const TankView& tank) : rule_(rule), tank_(tank) {}

  // The points must be sorted, listed and flagged.
  ProjectionReport advance(const Neighbourhood<2>& around, const Rows& rows, const Flow& flow,
                           const Backward& time);

  // The pressure [Pa] that goes with the velocities as they are, of the points of the last step:
  //   lap p = - rho (grad v : grad v^T),  walls: n . grad p = rho n . (f + nu lap v),  surface: p = 0
  // The step's own p holds besides what takes off, within one step, the divergence that contacts, new points
  // and flags brought: impulses over dt.
  PoissonReport pressure_of_flow(const Flow& flow, const Field<double>& pressure);

  // Whether these are the points of the last step.
  bool knows(const Flow& flow) const { return stencils_.view().around.points == flow.points; }

  const Stencils<2>& stencils() const { return stencils_; }
  const linear::ClusterMatrix& pressure_matrix() const { return poisson_.matrix(); }

 public:
  void find_rows(const Neighbourhood<2>& around, const Flow& flow);
  void guess_pressure(const Flow& flow);
  void predict(const Flow& flow, const Backward& time);
  linear::BiCgStabReport diffuse(const Flow& flow, const Backward& time);
  void hold_walls(const Flow& flow);
  void find_sources(const Flow& flow, const Backward& time);
  void correct(const Flow& flow, const Backward& time);
  void settle(const Flow& flow);
  void smooth_edges(const Flow& flow);
  double pressure_scale(const Flow& flow);
  double residual_of_speed(const Neighbourhood<2>& around, const Flow& flow, const Backward& time);

 private:
  FlowRule rule_;
  TankView tank_;
  Stencils<2> stencils_;
  Poisson<2> poisson_;
  ImplicitViscosity viscosity_;
};

}  // namespace freshet::fpm
