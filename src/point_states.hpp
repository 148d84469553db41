// What was sampled of shallow water, as the run loop asks for it.
#pragma once
#include "kernels/water/sampling.hpp"
#include "src/method.hpp"

namespace freshet {

inline std::vector<PointState> point_states(const std::vector<SampledDepth>& found) {
  std::vector<PointState> states;
  for (const SampledDepth& f : found) states.push_back({f.bed, f.depth, f.reached != 0});
  return states;
}

}  // namespace freshet
