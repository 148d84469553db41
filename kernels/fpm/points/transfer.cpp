#include "kernels/fpm/points/transfer.hpp"

#include "cellgrid/parallel/launch.hpp"

namespace freshet::fpm {
namespace {

KOKKOS_FORCEINLINE_FUNCTION Terms<double, 2> scaled_basis(const Vec<double, 2>& d, double per_h) {
  return basis(Vec<double, 2>{per_h * d.x, per_h * d.y});
}

}  // namespace

void Transfer::find(const Near& near, const VecField<double, 2>& places, const Field<double>& h, int count) {
  if (factors_.extent_int(0) < count)
    factors_ = decltype(factors_)(Kokkos::ViewAllocateWithoutInitializing("fpm.transfer"),
                                  static_cast<std::size_t>(count + count / 2));
  near_ = near, places_ = places, count_ = count, h_ = h;
  const auto factors = factors_;
  launch(
      "fpm::transfer_factors", Range(0, count), KOKKOS_LAMBDA(int k) {
        Moments<double, 2> moments;
        const double per_h = 1 / h(k);
        near.for_each(at(places, k), h(k), [&](int, const Vec<double, 2>& d, double r2) {
          moments.add(weight(r2 * per_h * per_h), scaled_basis(d, per_h));
        });
        factors(k) = value_factors(moments);
      });
}

void Transfer::apply(const Field<double>& field, const Field<double>& value,
                     const Field<double>& slack) const {
  const Near near = near_;
  const VecField<double, 2> places = places_;
  const auto factors = factors_;
  const Field<double> h = h_;
  launch(
      "fpm::transfer", Range(0, count_), KOKKOS_LAMBDA(int k) {
        double sum = 0, low = 1e300, high = -1e300;
        const double per_h = 1 / h(k);
        near.for_each(at(places, k), h(k), [&](int j, const Vec<double, 2>& d, double r2) {
          sum += weight(r2 * per_h * per_h) * dot(factors(k), scaled_basis(d, per_h)) * field(j);
          low = smaller(low, field(j)), high = larger(high, field(j));
        });
        const double beyond = slack(k) * (high - low);
        value(k) = low <= high ? clamp(sum, low - beyond, high + beyond) : 0.0;
      });
}

}  // namespace freshet::fpm
