// Incompressible flow by the Finite Pointset Method (thesis ch. 5, corrected): the recipe of one step.
#pragma once
#include "kernels/fpm/points/points.hpp"
#include "kernels/fpm/pressure/projection.hpp"
#include "src/methods/fpm/area_keeper.hpp"
#include "src/methods/fpm/grading.hpp"
#include "src/methods/fpm/pressure_probes.hpp"
#include "src/methods/method.hpp"

namespace freshet::fpm {

class FinitePointset : public Method {
 public:
  explicit FinitePointset(const Scene& scene);

  std::string name() const override { return "fpm"; }
  int dimension() const override { return 2; }
  double stable_dt() const override;
  void step(double t, double dt) override;
  FieldSet& fields() override { return points_; }
  const FieldSet& fields() const override { return points_; }
  const Rows& rows() const override { return order_.rows(); }
  Totals totals() const override;
  Mechanics mechanics() const override;
  StepReport report() const override { return report_; }
  std::map<std::string, Work> work() const override;
  std::vector<std::string> features() const override;
  std::vector<std::string> notes() const override;
  std::vector<Reading> read(const std::vector<Gauge>& gauges) const override;
  ScalarState scalars() const override;
  void restore(const ScalarState& scalars) override;

  // Pa, at every point: the pressure that goes with the velocities (Projection::pressure_of_flow); before the
  // first step the points' own.
  Field<double> flow_pressure() const;

  const PoissonReport& pressure_report() const { return pressure_; }

 private:
  Flow declare(const FieldList& fields) const;
  void make_fields();
  Flow bind() const;
  void manage_points();
  void size_supports();
  void require_solved(const ProjectionReport& projected);

  Scene scene_;
  FieldSet points_;
  RowOrder order_;
  Period period_;
  Tank tank_;
  std::optional<Grading> grading_;
  PointKeeper management_;
  NeighbourFinder<2> finder_;
  mutable Projection projection_;  // pressures of gauges are solved for with its rows
  AreaKeeper keeper_;
  StepReport report_;
  PoissonReport pressure_;
  linear::BiCgStabReport viscosity_;
  PointCount counts_;
  long limited_ = 0,
       moved_ = 0;  // points x steps, since t = 0: held within their neighbours' velocities; all
  mutable PressureProbes probes_;
  mutable Field<double> area_, flow_pressure_;
  double last_dt_ = 0;  // s, 0 before the first step
  int next_id_ = 0;

 public:
  void place();
  Field<double> cell_areas() const;  // m2, of each point
  void seat_on_walls();
};

}  // namespace freshet::fpm
