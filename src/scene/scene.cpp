#include "src/scene/scene.hpp"

#include <algorithm>
#include <cmath>

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

OpenLaw OpenBoundary::at(double time) const {
  OpenLaw now = law;
  const auto value = [&](std::size_t k) { return k < imposed.size() ? imposed[k].series.at(time) : 0; };
  std::visit([&](auto& l) { l.set(value(0), value(1)); }, now);
  return now;
}

Scene::Scene() = default;
Scene::Scene(const Scene&) = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(const Scene&) = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

Point Transect::at(double place) const {
  if (one_dimensional) return {place, 0};
  const double dx = line[1][0] - line[0][0], dy = line[1][1] - line[0][1], part = place / std::hypot(dx, dy);
  return {line[0][0] + part * dx, line[0][1] + part * dy};
}

}  // namespace freshet
