#include "src/reference/eddy.hpp"

#include <cmath>

namespace freshet {
namespace {

class SteadyEddy : public Exact {
 public:
  SteadyEddy(const Eddy& eddy, double gravity) : eddy_(eddy), gravity_(gravity) {}

  FlowState at(double x, double y, double) const override {
    const double rx = (x - eddy_.x0) / eddy_.radius, ry = (y - eddy_.y0) / eddy_.radius;
    const double turning = eddy_.speed * std::exp(0.5 * (1 - rx * rx - ry * ry));
    return {eddy_.level - turning * turning / (2 * gravity_), -turning * ry, turning * rx};
  }

 private:
  Eddy eddy_;
  double gravity_;
};

}  // namespace

std::unique_ptr<Exact> eddy(const Eddy& eddy, double gravity) {
  return std::make_unique<SteadyEddy>(eddy, gravity);
}

}  // namespace freshet
