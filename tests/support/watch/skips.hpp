// What a step of a scene launches and which fields it has, against a bare scene: flat, frictionless, without
// walls.
#pragma once
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/support/run/scenes.hpp"
#include "tests/support/watch/recording.hpp"

namespace freshet::test {

using Names = std::set<std::string>;

// A drop that spreads.
inline Scene drop(int dimension = 2) {
  Scene scene = bare_scene(dimension, {-1, -1}, {1, 1}, 0.05);
  scene.water.depth = [](double x, double y) { return 0.5 - x * x - y * y; };
  scene.water.wet_above = 0.05;
  return scene;
}

// The launches of one step of a bare scene, in their order. fields: how many the sort carries.
inline std::vector<std::string> bare_step(int fields) {
  std::vector<std::string> labels{"swe::kick_and_drift", "cellgrid::extent", "cellgrid::mark",
                                  "cellgrid::keep",      "cellgrid::clear",  "cellgrid::count",
                                  "cellgrid::scan",      "cellgrid::place",  "cellgrid::settle"};
  labels.insert(labels.end(), static_cast<size_t>(fields), "cellgrid::permute");
  for (const char* label :
       {"cellgrid::count_clusters", "cellgrid::cut_clusters", "cellgrid::largest_h", "cellgrid::tile_h",
        "cellgrid::reach", "cellgrid::list", "swe::density", "swe::force", "swe::accelerate"})
    labels.emplace_back(label);
  return labels;
}

inline int sorted_fields(const FieldSet& fields) {
  int count = 0;
  for (const auto& f : fields.reals()) count += is_sorted(f.carry);
  for (const auto& f : fields.integers()) count += is_sorted(f.carry);
  return count;
}

inline Names field_names(const Scene& scene) {
  const Flow flow(scene);
  Names names;
  for (const auto& f : flow.method->fields().reals()) names.insert(f.name);
  for (const auto& f : flow.method->fields().integers()) names.insert(f.name);
  return names;
}

inline Names minus(Names a, const Names& b) {
  for (const auto& name : b) a.erase(name);
  return a;
}

// The launches of the fourth step, in their order.
inline std::vector<std::string> launches(const Scene& scene) {
  Flow flow(scene);
  flow.many_steps(3);
  const Recording recording;
  flow.many_steps(1);
  return recording.launches;
}

// Labels of a step of this scene beyond those of the bare one.
inline Names extra_labels(const Scene& scene) {
  const auto all = launches(scene), bare = bare_step(1);
  return minus({all.begin(), all.end()}, {bare.begin(), bare.end()});
}

}  // namespace freshet::test
