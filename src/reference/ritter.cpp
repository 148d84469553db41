#include "src/reference/ritter.hpp"

#include <algorithm>
#include <cmath>

namespace freshet {
namespace {

// One rarefaction from the still water (speed -c) to the tip (speed 2 c).
class Ritter : public Exact {
 public:
  Ritter(double left, double dam, double gravity) : left_(left), dam_(dam), gravity_(gravity) {}

  FlowState at(double x, double, double t) const override {
    if (t <= 0) return {x < dam_ ? left_ : 0, 0, 0};
    const double speed = (x - dam_) / t, c_left = std::sqrt(gravity_ * left_);
    if (speed <= -c_left) return {left_, 0, 0};
    const double c = std::max(0.0, (2 * c_left - speed) / 3);
    return {c * c / gravity_, 2 * (c_left + speed) / 3, 0};
  }

 private:
  double left_, dam_, gravity_;
};

}  // namespace

std::unique_ptr<Exact> ritter(double left_depth, double dam, double gravity) {
  return std::make_unique<Ritter>(left_depth, dam, gravity);
}

}  // namespace freshet
