// How high water has come at a place [m]; -1e300: there was none.
//   bed:  under the highest wet particle: where its centre stands
//   line: where its surface meets the bed: bed + min(depth, spacing |grad b|), the surface of that water, no higher than the bed a spacing
//         up the slope. Particles at rest are wet or dry, so that `bed` rises in steps of spacing |grad b|; `line` does not.
#pragma once

namespace freshet {

struct WetLevels {
  double bed = -1e300, line = -1e300;
};

}  // namespace freshet
