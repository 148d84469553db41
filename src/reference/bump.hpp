// Steady flow without friction over a parabolic bump, exact (Goutal and Maurel 1997; Vacondio 2010,
// section 4.3): one discharge, constant energy on either side of a jump, and the jump where both sides have
// the same momentum.
#pragma once
#include <memory>
#include <optional>

#include "src/reference/exact.hpp"

namespace freshet {

struct Bump {
  double height, centre, half_width;  // m: b = height (1 - ((x - centre)/half_width)^2) where it is positive
  double level(double x) const;       // m
};

struct BumpFlow {
  double velocity;  // m/s, at the inflow on the left
  // m; given: supercritical inflow that stays so; else the crest is critical
  std::optional<double> inflow_depth;
  // m; given: a jump brings the flow to this depth, if it fits on the bump
  std::optional<double> outflow_depth;
};

class SteadyBumpFlow : public Exact {
 public:
  SteadyBumpFlow(const Bump& bump, const BumpFlow& flow, double gravity);
  FlowState at(double x, double y, double t) const override;

  double discharge() const { return discharge_; }                     // m2/s
  const std::optional<double>& jump() const { return jump_; }         // m, where it stands
  double depth_before() const { return depth(*jump_, head_, true); }  // m, at the jump
  double depth_behind() const { return depth(*jump_, head_behind_, false); }

 private:
  double depth(double x, double head, bool supercritical) const;
  double momentum(double depth) const;
  void find_jump();

  Bump bump_;
  double gravity_, discharge_ = 0;
  double head_ = 0, head_behind_ = 0;  // m, of energy, above the channel's bed
  bool supercritical_ = false;         // at the inflow
  std::optional<double> jump_;
};

}  // namespace freshet
