// Formulation L of semi-implicit SPH: particles that move with the water (kernels/sisph/moving/moving.hpp). A
// step is taken in as many parts as it takes for each to hold.
#pragma once
#include "kernels/sisph/moving/moving.hpp"
#include "src/methods/sisph/solver.hpp"

namespace freshet::sisph {

template <int D>
class LagrangianSph : public SemiImplicitSph<D> {
 public:
  explicit LagrangianSph(const Scene& scene);

  double stable_dt() const override;
  void step(double t, double dt) override;
  std::vector<std::string> features() const override;
  std::vector<std::string> notes() const override;
  ScalarState scalars() const override;
  void restore(const ScalarState& scalars) override;

 public:  // device lambdas may not live in private members
  void find_friction(double dt);

 private:
  using Base = SemiImplicitSph<D>;
  using Base::held_, Base::g_n2_, Base::drag_, Base::celerity_;
  using Base::scene_, Base::kernel_, Base::support_, Base::particles_, Base::order_, Base::bed_,
      Base::report_;

  Work product_work() const override { return moving_.product_work(); }
  MovingOptions options() const;
  void require_water() const;
  void lay_friction();
  MovingReport try_to_move(double dt);
  bool holds(const MovingReport& r, double dt) const;
  void shorten(double t, double dt, const MovingReport& r);
  void settle_order();
  PathWeights path(double dt) const;
  Swarm<D> swarm() const;

  MovingWater<D> moving_;
  NearestTable ground_;     // g n^2 by place; empty where it is the same everywhere
  double last_dt_ = 0;      // s, of the step before: for paths that remember
  double allowed_ = 1e300;  // s: what has held lately, and something more
  long shortened_ = 0;      // steps tried again with half their length
};

}  // namespace freshet::sisph
