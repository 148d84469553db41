#include "kernels/swe/force/internal_force_loop.hpp"

namespace freshet::swe {

template void sum_force<2, true>(const ForceRequest<2>&);

}  // namespace freshet::swe
