// Dam break over a dry flat bed (Ritter 1892): water of depth left at x < dam, dry beyond.
#pragma once
#include <memory>

#include "src/reference/exact.hpp"

namespace freshet {

std::unique_ptr<Exact> ritter(double left_depth, double dam, double gravity);  // m, m, m/s2

}  // namespace freshet
