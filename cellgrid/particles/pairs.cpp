#include "cellgrid/particles/pairs.hpp"

namespace freshet {

template <int D>
void Pairs::build(int particles, const PairRequest<D>& request) {
  list(particles, request.rows, Nearby<D>(request));
}

template <>
VecField<double, 1> Pairs::vector_coefficient<1>(const std::string& label) const {
  return {coefficient(label + "_x")};
}
template <>
VecField<double, 2> Pairs::vector_coefficient<2>(const std::string& label) const {
  return {coefficient(label + "_x"), coefficient(label + "_y")};
}

template void Pairs::build<1>(int, const PairRequest<1>&);
template void Pairs::build<2>(int, const PairRequest<2>&);

}  // namespace freshet
