#include "kernels/swe/single_precision.hpp"

#include "cellgrid/parallel/launch.hpp"

namespace freshet::swe {
namespace {

KOKKOS_FORCEINLINE_FUNCTION float single(double a) { return static_cast<float>(a); }

template <int N>
KOKKOS_FORCEINLINE_FUNCTION void put_pair(SingleRecord<N>& to, int k, const Vec<double, 1>& a) {
  to.value[k] = single(a.x);
}
template <int N>
KOKKOS_FORCEINLINE_FUNCTION void put_pair(SingleRecord<N>& to, int k, const Vec<double, 2>& a) {
  to.value[k] = single(a.x);
  to.value[k + 1] = single(a.y);
}
KOKKOS_FORCEINLINE_FUNCTION void put_strain(SingleRecord<16>& to, const SymField<double, 1>& s, int i) {
  to.value[StateSlot::strain] = single(s.xx(i));
}
KOKKOS_FORCEINLINE_FUNCTION void put_strain(SingleRecord<16>& to, const SymField<double, 2>& s, int i) {
  to.value[StateSlot::strain] = single(s.xx(i));
  to.value[StateSlot::strain + 1] = single(s.xy(i));
  to.value[StateSlot::strain + 2] = single(s.yy(i));
}

template <int D>
struct CopyState {
  Particles<D> p;
  bool strain, depth_slope;

  KOKKOS_INLINE_FUNCTION void operator()(int i) const {
    SingleRecord<16>& to = p.single.state(i);
    put_pair(to, StateSlot::v, at(p.v_pred, i));
    to.value[StateSlot::m] = single(p.m(i));
    to.value[StateSlot::rho] = single(p.rho(i));
    to.value[StateSlot::h] = single(p.h(i));
    to.value[StateSlot::inv_h] = single(p.inv_h(i));
    to.value[StateSlot::pressure] = single(p.pressure(i));
    to.value[StateSlot::celerity] = single(p.celerity(i));
    to.value[StateSlot::weight] = single(p.weight(i));
    if (strain) put_strain(to, p.strain, i);
    if (depth_slope) put_pair(to, StateSlot::depth_slope, at(p.depth_slope, i));
  }
};

}  // namespace

template <int D>
void copy_motion(const Particles<D>& p, int size) {
  launch(
      "swe::copy_motion", Range(0, size), KOKKOS_LAMBDA(int i) {
        SingleRecord<4>& to = p.single.motion(i);
        put_pair(to, 0, at(p.v_pred, i));
        to.value[2] = single(p.m(i));
      });
}

template <int D>
void copy_state(const Particles<D>& p, int size) {
  const bool strain = p.strain.xx.extent(0) > 0, depth_slope = p.depth_slope.x.extent(0) > 0;
  launch("swe::copy_state", Range(0, size), CopyState<D>{p, strain, depth_slope});
}

template void copy_motion<1>(const Particles<1>&, int);
template void copy_motion<2>(const Particles<2>&, int);
template void copy_state<1>(const Particles<1>&, int);
template void copy_state<2>(const Particles<2>&, int);

}  // namespace freshet::swe
