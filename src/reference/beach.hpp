// Waves on a plane beach by the hodograph transform of Carrier and Greenspan (1958), as Carrier, Wu and Yeh
// (2003) use it for water that starts at rest: exact for the nonlinear shallow-water equations as long as
// nothing breaks.
#pragma once
#include <memory>
#include <vector>

#include "src/reference/exact.hpp"

namespace freshet {

// In the units of Carrier, Wu and Yeh: lengths along x by `length`, levels by slope x length.
struct BeachHump {
  double height, steepness, at;  // height exp(-steepness (s - at)^2), s = distance from the shore plus level
};

struct Beach {
  double slope, length;  // 1, m: bed b = -slope x; the still shore is at x = 0, x grows seawards
  std::vector<BeachHump> humps;
};

// Depth and velocity (positive seawards). The last time asked for is kept: at() costs a search while the time
// stays the same. One thread at a time.
std::unique_ptr<Exact> beach_wave(const Beach& beach, double gravity);

// Where the shore lies at time t, as x [m], and how fast it moves [m/s].
struct Shore {
  double x, u;
};
Shore beach_shore(const Beach& beach, double gravity, double t);

}  // namespace freshet
