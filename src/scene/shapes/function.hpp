// Numbers by place and by time. A function may keep state: call each from one thread at a time.
#pragma once
#include <functional>
#include <vector>

namespace freshet {

using Function = std::function<double(double, double)>;  // of x, y

// A piecewise linear function of time; constant before its first and after its last entry.
struct Series {
  std::vector<double> t;      // s, strictly increasing
  std::vector<double> value;  // SI
  double at(double time) const;
};

}  // namespace freshet
