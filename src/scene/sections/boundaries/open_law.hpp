// What an open boundary of a scene imposes, its series on the device.
#pragma once
#include "kernels/boundaries/open/in_time.hpp"
#include "src/scene/scene.hpp"

namespace freshet {

LawInTime law_in_time(const OpenBoundary& boundary);

}  // namespace freshet
