// Semi-implicit SPH for the shallow water equations (Bankole 2016, ch. 5-7, corrected): gravity waves are
// implicit, so the celerity does not bound the step. What its two formulations share: where particles start,
// walls, the state of the water and what is told of it. E, particles at rest: at_rest.hpp; L, those that move
// with it: moving.hpp.
#pragma once
#include "cellgrid/particles/sums.hpp"
#include "kernels/sisph/particles.hpp"
#include "kernels/sisph/velocity/friction.hpp"
#include "src/methods/shallow_water.hpp"

namespace freshet::sisph {

template <int D>
class SemiImplicitSph : public ShallowWater<D> {
 public:
  std::string name() const override { return "sisph"; }
  std::map<std::string, Work> work() const override;  // of the linear solver
  Totals totals() const override;
  Mechanics mechanics() const override;
  ScalarState scalars() const override;
  void restore(const ScalarState& scalars) override;

 protected:
  using Base = ShallowWater<D>;
  using Base::scene_, Base::kernel_, Base::support_, Base::particles_, Base::order_, Base::bed_,
      Base::report_;

  explicit SemiImplicitSph(const Scene& scene);
  MirrorWalls<D> mirror_walls() const;
  WaterFields<D> bind() const;
  Layer<D> water() const;
  std::vector<Point> places() const;  // m, of the particles
  double longest_step() const;        // s, as far as the waves and the user go
  std::vector<std::string> features_with(const std::vector<std::string>& formulation,
                                         const std::vector<std::string>& sides) const;

 public:                  // device lambdas may not live in private members
  Geometry<D> measure();  // sorts; fills the masses
  void measure_speeds();

 protected:
  virtual Work product_work() const = 0;
  double cell_ = 0;                  // m^D, that a particle covers on average
  int held_ = 0;                     // particles beside the domain
  Field<double> level_of_bed_;       // m, per particle
  Field<double> g_n2_, drag_;        // friction: g n^2 of the ground, dt gamma; empty without
  Totals passed_;                    // inflow and outflow since t = 0
  double speed_ = 0, celerity_ = 0;  // m/s, largest

 private:
  WaterFields<D> declare(const FieldList& fields) const;
  void place_particles();
};

}  // namespace freshet::sisph
