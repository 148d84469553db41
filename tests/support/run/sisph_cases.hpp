// The 1-D and 2-D cases of SISPH, run with any particle number and step, and scenes of particles that move.
#pragma once
#include <cmath>

#include "src/reference/exact.hpp"
#include "tests/support/run/run_case.hpp"
#include "tests/support/run/scenes.hpp"

namespace freshet::test {

using Keys = std::vector<std::string>;

struct CaseError {
  double depth_l2;  // m, root mean square over the particles of the domain
  Results summary;
  StepReport report;
};

inline CaseError case_error(const std::string& name, const Keys& keys) {
  const Scene scene = read_case(name, keys);
  const CaseRun r = finish_case(name, keys);
  double sum = 0;
  for (std::size_t i = 0; i < r.fluid.size(); ++i) {
    const double d = r.fluid.depth[i] -
                     std::max(0.0, scene.compare.exact->at(r.fluid.x[i], r.fluid.y[i], scene.end_time).depth);
    sum += d * d;
  }
  return {std::sqrt(sum / static_cast<double>(r.fluid.size())), r.summary, r.method->report()};
}

// So many particles from -1 to 1 m, and the step [s].
inline Keys at(int particles, double dt, Keys more = {}) {
  more.push_back("water.spacing=" + std::to_string(2.0 / particles));
  more.push_back("time.dt=" + std::to_string(dt));
  return more;
}

inline Scene moving_scene(int dimension, const freshet::Point& low, const freshet::Point& high,
                          double spacing) {
  Scene scene = bare_scene(dimension, low, high, spacing);
  scene.method = "sisph";
  scene.sisph.moving = true;
  scene.sph.eta = scene.sisph.smoothing;
  return scene;
}

}  // namespace freshet::test
