// The smoothing kernels that a scene may name.
#pragma once

namespace freshet {

enum class KernelName { cubic, quartic, quintic, gaussian, wendland };

}  // namespace freshet
