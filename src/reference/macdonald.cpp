#include "src/reference/macdonald.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace freshet {
namespace {

class MacDonald : public Exact {
 public:
  explicit MacDonald(ChannelFlow flow) : flow_(std::move(flow)) {}
  FlowState at(double x, double, double) const override {
    const double depth = flow_.depth(x, 0);
    return {depth, flow_.discharge / depth, 0};
  }

 private:
  ChannelFlow flow_;
};

// A function of x given at equal steps from 0; between and beyond them linear.
struct Ramp {
  double step;                // m
  std::vector<double> value;  // at least two
  double at(double x) const {
    const double last = static_cast<double>(value.size()) - 2,
                 cell = std::clamp(std::floor(x / step), 0.0, last);
    const auto i = static_cast<std::size_t>(cell);
    return value[i] + (x / step - cell) * (value[i + 1] - value[i]);
  }
};

// m, lost from 0 to x by friction: the midpoint rule.
Ramp lost_head(const ChannelFlow& flow, double manning, double length) {
  constexpr int steps = 20000;
  Ramp lost{length / steps, {0}};
  for (int i = 0; i < steps; ++i)
    lost.value.push_back(lost.value.back() + lost.step * std::pow(manning * flow.discharge, 2) *
                                                 std::pow(flow.depth((i + 0.5) * lost.step, 0), -10.0 / 3));
  return lost;
}

}  // namespace

std::unique_ptr<Exact> macdonald(const ChannelFlow& flow) { return std::make_unique<MacDonald>(flow); }

std::function<double(double, double)> macdonald_bed(const ChannelFlow& flow, double manning, double length,
                                                    double gravity) {
  const auto energy = [flow, gravity](double x) {
    const double depth = flow.depth(x, 0);
    return depth + std::pow(flow.discharge / depth, 2) / (2 * gravity);
  };
  const Ramp lost = lost_head(flow, manning, length);
  const double head = energy(length) + lost.value.back();  // m, at x = 0
  return [=](double x, double) { return head - lost.at(x) - energy(x); };
}

}  // namespace freshet
