// How a step guesses the pressure before it projects (kernels/fpm/pressure/projection.hpp).
#pragma once
#include <vector>

namespace freshet::fpm {

// name: a scene's word for it. The first is the default; the printed ones are unstable, kept to show it.
struct PressureScheme {
  const char* name = "filtered";
  // q = the fitted pressure of the step before, the velocity near edges drawn towards its fit
  bool fitted = true;
  bool incremental = false;  // q = the pressure of the step before as it is; neither: q = 0
  bool as_printed = false;   // v* = 0 and n . grad phi = 0 on walls
};

inline std::vector<PressureScheme> pressure_schemes() {
  return {{},
          {"incremental", false, true, true},
          {"plain", false, false, false},
          {"projection", false, false, true}};
}

}  // namespace freshet::fpm
