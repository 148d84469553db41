// What an open boundary of a scene imposes, as the laws of kernels/open/states.hpp.
#pragma once
#include <functional>

#include "kernels/open/in_time.hpp"
#include "src/scene/scene.hpp"

namespace freshet {

// The law at a time [s].
std::function<OpenLaw(double)> law_of(const OpenBoundary& boundary);

// The same with its series on the device.
LawInTime law_in_time(const OpenBoundary& boundary);

}  // namespace freshet
