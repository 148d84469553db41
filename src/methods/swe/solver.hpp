// Explicit SPH for the shallow water equations (Vacondio 2010, ch. 1-4): the recipe of one step.
#pragma once
#include "cellgrid/particles/sums.hpp"
#include "kernels/swe/density/density.hpp"
#include "kernels/swe/force/internal_force.hpp"
#include "kernels/swe/motion.hpp"
#include "kernels/swe/open/boundary.hpp"
#include "kernels/swe/split/refinement.hpp"
#include "src/methods/shallow_water.hpp"

namespace freshet::swe {

template <int D>
class ExplicitSph : public ShallowWater<D> {
 public:
  // start: other particles than the scene's cells (relax.hpp).
  explicit ExplicitSph(const Scene& scene, const std::vector<Placed>& start = {});

  std::string name() const override { return "sph-swe"; }
  double stable_dt() const override;
  void step(double t, double dt) override;
  Totals totals() const override;
  Mechanics mechanics() const override;
  std::map<std::string, Work> work() const override;  // src/methods/swe/work.cpp
  std::vector<std::string> features() const override;
  ScalarState scalars() const override;
  void restore(const ScalarState& scalars) override;

 public:  // device lambdas may not live in private members
  void fill_boundaries();
  void place_particles(const std::vector<Placed>& start);

 private:
  using Base = ShallowWater<D>;
  using Base::scene_, Base::kernel_, Base::support_, Base::particles_, Base::order_, Base::bed_,
      Base::report_;

  void build_ground();
  void build_walls();
  void build_boundaries();
  void build_refinement();  // src/methods/swe/refine.cpp
  Particles<D> declare(const FieldList& fields) const;
  void make_fields();
  void make_room();  // for single_
  Particles<D> bind() const;
  MotionOptions<D> motion() const;
  Cost motion_cost() const;
  Field<int> kind() const;
  std::optional<BedTerm<D>> bed_term() const;
  void find_neighbours();  // sorts and lists
  void list_neighbours();
  void refine();  // splits and merges
  void close_density(double ahead);
  void evaluate(double kick_dt, double ahead);
  WallView<D> wall_view() const { return walls_ ? walls_->view() : WallView<D>{}; }

  double margin_;        // growth of h within a step that the neighbour list covers; more makes it again
  SingleCopies single_;  // of a scene with mixed precision
  ClusterSet clusters_;
  NeighbourList neighbours_;
  AnyStabilisation stabilise_;
  bool gradient_ = false, depth_gradient_ = false;
  double imposed_alpha_ = 1;
  bool variational_ = false;  // the bed's part in a step (BedTerm)
  std::optional<Friction> friction_;
  std::optional<Walls<D>> walls_;
  std::vector<BufferedLine<D>> boundaries_;
  std::optional<Refinement<D>> refinement_;
  double crossing_time_ = 0;  // s, least h / (c + signal)
  int next_id_ = 0;
};

}  // namespace freshet::swe
