#include "src/reference/exact.hpp"

#include <algorithm>
#include <cmath>

#include "cellgrid/parallel/types.hpp"

namespace freshet {
namespace {

// A rarefaction to the left, a constant middle state, a shock to the right.
class Stoker : public Exact {
 public:
  Stoker(double left, double right, double dam, double gravity)
      : left_(left), right_(right), dam_(dam), gravity_(gravity),
        middle_(stoker_middle(left, right, gravity)) {}

  FlowState at(double x, double, double t) const override {
    if (t <= 0) return {x < dam_ ? left_ : right_, 0, 0};
    const double speed = (x - dam_) / t;
    const double c_left = std::sqrt(gravity_ * left_);
    if (speed <= -c_left) return {left_, 0, 0};
    if (speed <= middle_.u - std::sqrt(gravity_ * middle_.depth)) {
      const double c = (2 * c_left - speed) / 3;
      return {c * c / gravity_, 2 * (c_left + speed) / 3, 0};
    }
    if (speed <= middle_.shock) return {middle_.depth, middle_.u, 0};
    return {right_, 0, 0};
  }

 private:
  double left_, right_, dam_, gravity_;
  StokerMiddle middle_;
};

double bowl_level(const Bowl& bowl, double x, double y) {
  return bowl.depth0 * ((x * x + y * y) / (bowl.radius * bowl.radius) - 1);
}

// The surface is a plane that turns with w = sqrt(2 g z0) / L; the velocity is the same everywhere
// (thesis 2.61).
class ThackerPlanar : public Exact {
 public:
  ThackerPlanar(const Bowl& bowl, double xi, double gravity)
      : bowl_(bowl), xi_(xi), omega_(std::sqrt(2 * gravity * bowl.depth0) / bowl.radius) {}

  FlowState at(double x, double y, double t) const override {
    const double rx = x - bowl_.x0, ry = y - bowl_.y0, c = std::cos(omega_ * t), s = std::sin(omega_ * t);
    const double surface =
        2 * xi_ * bowl_.depth0 / (bowl_.radius * bowl_.radius) * (rx * c - ry * s - xi_ / 2);
    return {std::max(0.0, surface - bowl_level(bowl_, rx, ry)), -xi_ * omega_ * s, -xi_ * omega_ * c};
  }
  double period() const override { return 2 * pi / omega_; }

 private:
  Bowl bowl_;
  double xi_, omega_;
};

class ThackerSloshing : public Exact {
 public:
  ThackerSloshing(const Bowl& bowl, double xi, double gravity)
      : bowl_(bowl), xi_(xi), omega_(std::sqrt(2 * gravity * bowl.depth0) / bowl.radius) {}

  FlowState at(double x, double, double t) const override {
    const double off = (x - bowl_.x0 - xi_ * std::cos(omega_ * t)) / bowl_.radius;
    return {std::max(0.0, bowl_.depth0 * (1 - off * off)), -xi_ * omega_ * std::sin(omega_ * t), 0};
  }
  double period() const override { return 2 * pi / omega_; }

 private:
  Bowl bowl_;
  double xi_, omega_;
};

// The surface is a paraboloid that bulges and flattens with w = sqrt(8 g z0) / L.
class ThackerRadial : public Exact {
 public:
  ThackerRadial(const Bowl& bowl, double amplitude, double gravity)
      : bowl_(bowl), a_(amplitude), omega_(std::sqrt(8 * gravity * bowl.depth0) / bowl.radius) {}

  FlowState at(double x, double y, double t) const override {
    const double rx = x - bowl_.x0, ry = y - bowl_.y0,
                 r2 = (rx * rx + ry * ry) / (bowl_.radius * bowl_.radius);
    const double denominator = 1 - a_ * std::cos(omega_ * t), root = std::sqrt(1 - a_ * a_);
    const double surface =
        bowl_.depth0 * (root / denominator - 1 - r2 * (root * root / (denominator * denominator) - 1));
    const double rate = omega_ * a_ * std::sin(omega_ * t) / (2 * denominator);
    return {std::max(0.0, surface - bowl_level(bowl_, rx, ry)), rate * rx, rate * ry};
  }
  double period() const override { return 2 * pi / omega_; }

 private:
  Bowl bowl_;
  double a_, omega_;
};

class StillWater : public Exact {
 public:
  StillWater(double level, std::function<double(double, double)> bed) : level_(level), bed_(std::move(bed)) {}
  FlowState at(double x, double y, double) const override {
    return {std::max(0.0, level_ - (bed_ ? bed_(x, y) : 0.0)), 0, 0};
  }

 private:
  double level_;
  std::function<double(double, double)> bed_;
};

}  // namespace

// The depth at which the velocity behind the rarefaction, 2 (c_l - c), equals that behind the shock; the
// difference falls monotonically from the right depth to the left one, so bisection finds the only root to
// the last bit.
StokerMiddle stoker_middle(double left_depth, double right_depth, double gravity) {
  const auto behind_rarefaction = [&](double d) {
    return 2 * (std::sqrt(gravity * left_depth) - std::sqrt(gravity * d));
  };
  const auto behind_shock = [&](double d) {
    return (d - right_depth) * std::sqrt(0.5 * gravity * (1 / d + 1 / right_depth));
  };
  double low = right_depth, high = left_depth;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (behind_rarefaction(middle) > behind_shock(middle) ? low : high) = middle;
  }
  const double depth = 0.5 * (low + high), u = behind_rarefaction(depth);
  return {depth, u, depth * u / (depth - right_depth)};
}

std::unique_ptr<Exact> stoker(double left_depth, double right_depth, double dam, double gravity) {
  return std::make_unique<Stoker>(left_depth, right_depth, dam, gravity);
}

std::unique_ptr<Exact> thacker_planar(const Bowl& bowl, double xi, double gravity) {
  return std::make_unique<ThackerPlanar>(bowl, xi, gravity);
}

std::unique_ptr<Exact> thacker_sloshing(const Bowl& bowl, double xi, double gravity) {
  return std::make_unique<ThackerSloshing>(bowl, xi, gravity);
}

std::unique_ptr<Exact> thacker_radial(const Bowl& bowl, double amplitude, double gravity) {
  return std::make_unique<ThackerRadial>(bowl, amplitude, gravity);
}

std::unique_ptr<Exact> still_water(double level, std::function<double(double, double)> bed) {
  return std::make_unique<StillWater>(level, std::move(bed));
}

}  // namespace freshet
