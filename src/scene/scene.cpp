#include "src/scene/scene.hpp"

#include <algorithm>

namespace freshet {

double Series::at(double time) const {
  if (t.empty()) return 0;
  const auto after = std::upper_bound(t.begin(), t.end(), time);
  if (after == t.begin()) return value.front();
  if (after == t.end()) return value.back();
  const std::size_t i = after - t.begin();
  const double part = (time - t[i - 1]) / (t[i] - t[i - 1]);
  return value[i - 1] + part * (value[i] - value[i - 1]);
}

}  // namespace freshet
