#include "cellgrid/pairs.hpp"

namespace freshet {

namespace {

template <int D>
struct Nearby {
  Rows rows;
  VecField<double, D> x;
  Field<double> h;
  double half;  // of the support / h

  template <class Put>
  KOKKOS_INLINE_FUNCTION void operator()(int i, const Put& put) const {
    const Vec<double, D> xi = at(x, i);
    double y = 0;
    if constexpr (D == 2) y = xi.y;
    const double most = rows.largest_h(xi.x, xi.x, y, y);
    rows.for_each_run(xi.x, xi.x, y, y, half * (h(i) + most), [&](int begin, int end) {
      for (int j = begin; j < end; ++j) {
        const Vec<double, D> d = at(x, j) - xi;
        const double limit = half * (h(i) + h(j));
        if (j != i && dot(d, d) < limit * limit) put(j);
      }
    });
  }
};

}  // namespace

template <int D>
void Pairs::build(int particles, const PairRequest<D>& request) {
  list(particles, Nearby<D>{request.rows, request.x, request.h, 0.5 * request.factor});
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
