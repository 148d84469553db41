#include "kernels/swe/force/internal_force_loop.hpp"

namespace freshet::swe {

template void sum_force<1, false>(const ForceRequest<1>&);

}  // namespace freshet::swe
