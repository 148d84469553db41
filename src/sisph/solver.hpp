// Semi-implicit SPH for the shallow water equations (Bankole 2016, ch. 5-7, corrected): formulation E, particles at rest; or L,
// particles that move with the water (moving.cpp, kernels/sisph/moving/moving.hpp).
// Gravity waves are implicit, so the celerity does not bound the step. One step:
//   velocity before the pressure at n+1 (along particle paths, or carried by the mass fluxes), a linear or (with drying)
//   piecewise linear system for the free surface, fluxes and depths from it, the pressure at n+1; repeated (Picard).
#pragma once
#include <optional>

#include "kernels/ground/bed_spline.hpp"
#include "kernels/ground/nearest_table.hpp"
#include "kernels/sisph/moving/moving.hpp"
#include "kernels/sisph/open/open.hpp"
#include "kernels/sisph/open/rim.hpp"
#include "kernels/sisph/pairs/active.hpp"
#include "kernels/sisph/pairs/closure.hpp"
#include "kernels/sisph/velocity/conservative.hpp"
#include "kernels/sisph/velocity/friction.hpp"
#include "kernels/sisph/velocity/mass_flux.hpp"
#include "kernels/sisph/velocity/semi_lagrangian.hpp"
#include "kernels/sisph/velocity/viscosity.hpp"
#include "kernels/water/sampling.hpp"
#include "src/method.hpp"

namespace freshet::sisph {

struct Start;  // a particle at t = 0 (setup.cpp)

template <int D>
class Solver : public Method {
 public:
  explicit Solver(const Scene& scene);
  ~Solver() override;

  std::string name() const override { return "sisph"; }
  int dimension() const override { return D; }
  double stable_dt() const override;
  void step(double t, double dt) override;
  FieldSet& fields() override { return particles_; }
  const FieldSet& fields() const override { return particles_; }
  const Rows& rows() const override { return order_.rows(); }
  Totals totals() const override;
  Mechanics mechanics() const override;
  StepReport report() const override { return report_; }
  std::vector<PointState> sample(const std::vector<Point>& points) const override;
  void raise_wet_levels(const Shores& shores) const override;
  std::vector<std::string> features() const override;
  std::vector<std::string> notes() const override;
  ScalarState scalars() const override;
  void restore(const ScalarState& scalars) override;

 private:
  void place_particles();
  void make_fields();
  void fill_fields(const std::vector<Start>& start);
  void build_momentum();
  void build_friction();
  void build_openings();
  MirrorWalls<D> mirror_walls() const;
  void start_moving();
  void roughen();
  void move_with_water(double t, double dt);
  MovingReport try_to_move(double dt);
  bool holds(const MovingReport& r, double dt) const;
  void shorten(double t, double dt, const MovingReport& r);
  void settle_order();
  double longest_step() const;
  double moving_dt() const;
  PathWeights path(double dt) const;
  Swarm<D> swarm() const;
  std::vector<RimPlace<D>> rim_places() const;
  TracedWater<D> traced() const;
  void meet_boundaries(double t, double dt);
  void require_water(const std::string& who_needs) const;
  void carry_along_paths(double t, double dt);
  void carry_by_fluxes(double t, double dt);
  void find_slope(const Field<double>& depth, bool drying);
  void find_push(double theta, bool drying);
  void extend_slope(const Field<double>& depth);

 public:
  void build_geometry();
  void find_friction(double dt);
  void slow_down(const VecField<double, D>& v);
  void find_viscous(double dt);
  void add_viscous(const VecField<double, D>& v);
  void push(const VecField<double, D>& from, double impulse, const VecField<double, D>& to);
  void blend(double dt);
  void solve_surface(double dt, bool drying);
  void accept(double dt, bool closed);
  void measure_speeds();

 private:
  Water<D> water() const;
  SortedWater<D> sorted_water() const;

  Scene scene_;
  AnyKernel<D> kernel_;
  double support_;   // of the kernel, x l
  double cell_ = 0;  // m^D, that a particle covers on average
  bool conservative_ = false;  // the pressure of the momentum
  int held_ = 0;     // particles beside the domain
  FieldSet particles_;
  RowOrder order_;
  std::optional<BedSpline<D>> bed_;
  Field<double> level_of_bed_;  // m, per particle
  Geometry<D> geometry_;
  ClosureReport closure_;
  std::optional<FreeSurface<D>> surface_;
  std::optional<ActiveSlices<D>> active_;
  std::optional<SemiLagrangian<D>> paths_;
  std::optional<MassFlux<D>> fluxes_;
  std::optional<Rim<D>> rim_;
  std::optional<OpenRim<D>> open_;
  std::optional<Viscosity<D>> viscosity_;
  std::optional<MovingWater<D>> moving_;  // formulation L; else absent
  double last_dt_ = 0;                    // s, of the step before: for paths that remember
  double allowed_ = 1e300;                // s, of moving particles: what has held lately, and something more
  long shortened_ = 0;                    // steps tried again with half their length
  NearestTable ground_;                   // g n^2 by place; empty where it is the same everywhere
  Field<double> g_n2_, drag_;  // friction: g n^2 of the ground, dt gamma; empty without
  VecField<double, D> slope_, explicit_, carried_, before_, end_;  // grad eta; velocities, m/s
  VelocityGradient<D> velocity_gradient_;
  StepReport report_;
  Totals passed_;         // inflow and outflow since t = 0
  double speed_ = 0, celerity_ = 0;  // m/s, largest
  mutable Sampler<D> sampler_;
};

}  // namespace freshet::sisph
