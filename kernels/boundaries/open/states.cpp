#include "kernels/boundaries/open/states.hpp"

namespace freshet {

ExteriorState exterior_state(const OpenLaw& law, const InnerState& inner, const OpenStrip& strip) {
  return std::visit([&](const auto& kind) { return imposed(kind, inner, strip); }, law);
}

}  // namespace freshet
