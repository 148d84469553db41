// Explicit SPH for the shallow water equations (Vacondio 2010, ch. 1-4): the recipe of one step.
#pragma once
#include <memory>
#include <optional>

#include "cellgrid/sums.hpp"
#include "kernels/swe/density/density.hpp"
#include "kernels/swe/force/internal_force.hpp"
#include "kernels/swe/motion.hpp"
#include "kernels/swe/open/boundary.hpp"
#include "kernels/swe/split/refinement.hpp"
#include "kernels/water/sampling.hpp"
#include "src/method.hpp"

namespace freshet::swe {

template <int D>
class Solver : public Method {
 public:
  explicit Solver(const Scene& scene);
  ~Solver() override;

  std::string name() const override { return "sph-swe"; }
  int dimension() const override { return D; }
  double stable_dt() const override;
  void step(double t, double dt) override;
  FieldSet& fields() override { return particles_; }
  const FieldSet& fields() const override { return particles_; }
  const Rows& rows() const override { return order_.rows(); }
  Totals totals() const override;
  Mechanics mechanics() const override;
  StepReport report() const override { return report_; }
  std::map<std::string, Work> work() const override;  // src/swe/work.cpp
  std::vector<PointState> sample(const std::vector<Point>& points) const override;
  void raise_wet_levels(const Shores& shores) const override;
  std::vector<std::string> features() const override;
  ScalarState scalars() const override;
  void restore(const ScalarState& scalars) override;

 public:
  void fill_boundaries();
  void place_particles();

 private:
  void build_bed();
  void build_friction();
  void build_walls();
  void build_boundaries();
  void build_refinement();  // src/swe/refine.cpp
  Function initial_depth() const;
  void make_fields();
  void make_room();  // for single_
  Particles<D> bind() const;
  MotionOptions<D> motion() const;
  Cost motion_cost() const;
  Field<int> kind() const;
  std::optional<Bed<D>> bed() const;
  void find_neighbours();  // sorts and lists
  void list_neighbours();
  void refine();  // splits and merges
  void close_density(double ahead);
  void evaluate(double kick_dt, double ahead);
  WallView<D> wall_view() const { return walls_ ? walls_->view() : WallView<D>{}; }

  Scene scene_;
  AnyKernel<D> kernel_;
  double support_;  // of the kernel, x h
  double margin_;   // growth of h within a step that the neighbour list covers; more makes it again
  FieldSet particles_;
  SingleCopies single_;  // of a scene with mixed precision
  RowOrder order_;
  ClusterSet clusters_;
  NeighbourList neighbours_;
  AnyStabilisation stabilise_;
  bool gradient_ = false, depth_gradient_ = false;
  double imposed_alpha_ = 1;
  std::optional<Bed<D>> bed_;
  std::optional<Friction> friction_;
  std::optional<Walls<D>> walls_;
  std::vector<OpenBoundary<D>> boundaries_;
  std::optional<Refinement<D>> refinement_;
  StepReport report_;
  mutable Sampler<D> sampler_;
  double crossing_time_ = 0;  // s, least h / (c + signal)
  int next_id_ = 0;
};

}  // namespace freshet::swe
