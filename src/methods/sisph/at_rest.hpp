// Formulation E of semi-implicit SPH: particles at rest, wet or dry. One step:
//   velocity before the pressure at n+1 (along particle paths, or carried by the mass fluxes), a linear or
//   (with drying) piecewise linear system for the free surface, fluxes and depths from it, the pressure at
//   n+1; repeated (Picard).
#pragma once
#include "kernels/sisph/open/open.hpp"
#include "kernels/sisph/open/rim.hpp"
#include "kernels/sisph/pairs/active.hpp"
#include "kernels/sisph/pairs/closure.hpp"
#include "kernels/sisph/velocity/conservative.hpp"
#include "kernels/sisph/velocity/mass_flux.hpp"
#include "kernels/sisph/velocity/semi_lagrangian.hpp"
#include "kernels/sisph/velocity/viscosity.hpp"
#include "src/methods/sisph/solver.hpp"

namespace freshet::sisph {

template <int D>
class EulerianSph : public SemiImplicitSph<D> {
 public:
  explicit EulerianSph(const Scene& scene);

  double stable_dt() const override;
  void step(double t, double dt) override;
  Totals totals() const override;
  std::vector<std::string> features() const override;
  ScalarState scalars() const override;
  void restore(const ScalarState& scalars) override;

 public:  // device lambdas may not live in private members
  void push(const VecField<double, D>& from, double impulse, const VecField<double, D>& to);
  void slow_down(const VecField<double, D>& v);
  void blend(double dt);
  void accept(double dt, bool closed);

 private:
  using Base = SemiImplicitSph<D>;
  using Base::held_, Base::level_of_bed_, Base::g_n2_, Base::drag_, Base::passed_, Base::speed_,
      Base::celerity_;
  using Base::scene_, Base::kernel_, Base::support_, Base::particles_, Base::order_, Base::report_;
  using Base::water;

  Work product_work() const override;
  std::optional<PairSource<D>> pair_source() const;
  void build_momentum();
  void build_friction();
  void build_openings();
  std::vector<RimPlace<D>> rim_places() const;
  TracedWater<D> traced() const;
  void meet_boundaries(double t, double dt);
  void require_water(const std::string& who_needs) const;
  void carry_along_paths(double t, double dt);
  void carry_by_fluxes(double t, double dt);
  void find_slope(const Field<double>& depth, bool drying);
  void find_push(double theta, bool drying);
  void extend_slope(const Field<double>& depth);
  void find_viscous(double dt);
  void add_viscous(const VecField<double, D>& v);
  void solve_surface(double dt, bool drying);

  bool conservative_ = false;  // the pressure of the momentum
  Geometry<D> geometry_;
  ClosureReport closure_;
  FreeSurface<D> surface_;
  ActiveSlices<D> active_;
  Rim<D> rim_;
  std::optional<SemiLagrangian<D>> paths_;
  std::optional<MassFlux<D>> fluxes_;
  std::optional<OpenRim<D>> open_;
  std::optional<Viscosity<D>> viscosity_;
  VecField<double, D> slope_, explicit_, carried_, before_, end_;  // grad eta; velocities, m/s
  VelocityGradient<D> velocity_gradient_;
};

}  // namespace freshet::sisph
