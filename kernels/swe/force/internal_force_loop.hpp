// The pair loop of internal_force.hpp.
#pragma once
#include "cellgrid/parallel/launch.hpp"
#include "kernels/swe/force/force_request.hpp"
#include "kernels/swe/single_precision.hpp"

namespace freshet::swe {

namespace {

template <class V, int D>
struct ForceSums {
  Vec<V, D> t;
  V signal{0.0};
};
template <class F, int D, class... V>
KOKKOS_FORCEINLINE_FUNCTION auto each(const F& f, const ForceSums<V, D>&... a)
    -> ForceSums<decltype(f(a.signal...)), D> {
  return {each(f, a.t...), f(a.signal...)};
}

template <class V, int D>
struct Here {
  Vec<V, D> x, v;
  V rho, h, inv_h, pressure, celerity, weight_per_mass;
  Sym<V, D> strain;
  Vec<V, D> depth_slope;
};
template <class F, class V, int D>
KOKKOS_FORCEINLINE_FUNCTION auto each(const F& f, const Here<V, D>& a) -> Here<decltype(f(a.rho)), D> {
  return {each(f, a.x),      each(f, a.v),          f(a.rho),      f(a.h),
          f(a.inv_h),        f(a.pressure),         f(a.celerity), f(a.weight_per_mass),
          each(f, a.strain), each(f, a.depth_slope)};
}

// The neighbour's end of a pair; what a stabilisation does not use is not loaded.
template <class V, int D>
struct There {
  Vec<V, D> v;
  V m, rho, h, inv_h, pressure, celerity, weight;
  Sym<V, D> strain;
  Vec<V, D> depth_slope;
};

// apart: x_ij
template <class K, class Stabilise, class V, int D>
KOKKOS_FORCEINLINE_FUNCTION void add_pair(const K& kernel, const Stabilise& stabilise, const Here<V, D>& i,
                                          const There<V, D>& j, const Distance<V, D>& apart,
                                          ForceSums<V, D>& sum) {
  const Vec<V, D>& x_ij = apart.x;
  const PairLength<V> length_ij = length(apart, i.rho + j.rho);
  const V inv = length_ij.per_factor, inv_r = length_ij.per_r,
          r = length_ij.r;  // inv = 1 / ((rho_i + rho_j) r)
  const V q_i = r * i.inv_h, q_j = r * j.inv_h;
  PairState<V> pair{dot(i.v - j.v, x_ij),
                    0.0,
                    0.0,
                    i.celerity + j.celerity,
                    inv,
                    apart.square,
                    i.h + j.h,
                    i.rho,
                    j.rho,
                    0.0,
                    0.0,
                    i.pressure,
                    j.pressure};
  if constexpr (Stabilise::velocity_gradient) {
    pair.slope_i = quadratic(i.strain, x_ij);
    pair.slope_j = quadratic(j.strain, x_ij);
  }
  if constexpr (Stabilise::depth_gradient) {
    pair.depth_slope_i = dot(i.depth_slope, x_ij);
    pair.depth_slope_j = dot(j.depth_slope, x_ij);
  }
  const PairPressure<V> pressure = stabilise(pair);
  const V from_i = pressure.i * (j.m * i.weight_per_mass) * kernel.slope(q_i);
  const V from_j = pressure.j * j.weight * kernel.slope(q_j);
  sum.t += ((from_i + from_j) * inv_r) * x_ij;
  sum.signal = larger_where(smaller(q_i, q_j) < V(kernel.support), sum.signal, size_of(pair.jump) * inv_r);
}

template <int D, class K, class Stabilise, bool single>
struct InternalForce {
  K kernel;
  ClusterSet clusters;
  NeighbourView near;
  WallView<D> walls;
  Particles<D> p;
  Stabilise stabilise;

  template <class V>
  KOKKOS_FORCEINLINE_FUNCTION There<V, D> there(int j) const {
    There<V, D> t{broadcast<V>(at(p.v_pred, j)),
                  p.m(j),
                  p.rho(j),
                  p.h(j),
                  p.inv_h(j),
                  p.pressure(j),
                  p.celerity(j),
                  p.weight(j),
                  {},
                  {}};
    if constexpr (Stabilise::velocity_gradient) t.strain = broadcast<V>(p.strain, j);
    if constexpr (Stabilise::depth_gradient) t.depth_slope = broadcast<V>(at(p.depth_slope, j));
    return t;
  }

  KOKKOS_FORCEINLINE_FUNCTION There<Twin, D> there(int a, int b, Twin keep) const {
    using S = StateSlot;
    const TwinRecord<16> j(p.single.state(a), p.single.state(b));
    There<Twin, D> t{two_vectors<S::v, D>(j),
                     keep * j.get<S::m>(),
                     j.get<S::rho>(),
                     j.get<S::h>(),
                     j.get<S::inv_h>(),
                     j.get<S::pressure>(),
                     j.get<S::celerity>(),
                     keep * j.get<S::weight>(),
                     {},
                     {}};
    if constexpr (Stabilise::velocity_gradient) t.strain = two_matrices<S::strain, D>(j);
    if constexpr (Stabilise::depth_gradient) t.depth_slope = two_vectors<S::depth_slope, D>(j);
    return t;
  }

  KOKKOS_FORCEINLINE_FUNCTION static Here<Twin, D> in_single(const Here<Lane, D>& i) {
    return each(Twice{}, i);
  }

  KOKKOS_FORCEINLINE_FUNCTION ForceSums<Lane, D> all(int c, const Here<Lane, D>& i) const {
    if constexpr (single) {
      const ForceSums<Twin, D> sum = walk_single(c, i.x, in_single(i));
      return {each(Folded{}, sum.t), folded_largest(sum.signal)};
    } else {
      return by_register<Lane>(i, [&](const auto& some, int part) FRESHET_INLINE_LAMBDA {
        return walk_some(near.of(c, part), some, [](int) { return true; });
      });
    }
  }

  KOKKOS_FORCEINLINE_FUNCTION ForceSums<Twin, D> walk_single(int c, const Vec<Lane, D> x,
                                                             const Here<Twin, D> i) const {
    ForceSums<Twin, D> sum;
    for_each_twin(near, c, [&](int a, int b, Twin keep) {
      add_pair(kernel, stabilise, i, there(a, b, keep), distance(apart(x, p.x, a, b)), sum);
    });
    return sum;
  }

  template <class Counts>
  KOKKOS_FORCEINLINE_FUNCTION ForceSums<Lane, D> walk(int c, const Here<Lane, D>& i,
                                                      const Counts& counts) const {
    return by_register<Lane>(
        i, [&](const auto& some, int) FRESHET_INLINE_LAMBDA { return walk_some(near.of(c), some, counts); });
  }
  // The sums over the neighbours that count. A local result and a copy of i: what has an address known
  // elsewhere would be written and read again at every pair.
  template <class V, class Counts>
  KOKKOS_FORCEINLINE_FUNCTION ForceSums<V, D> walk_some(const NearList& neighbours, const Here<V, D> i,
                                                        const Counts& counts) const {
    ForceSums<V, D> sum;
    const auto apart = [&](int j) FRESHET_INLINE_LAMBDA { return distance(i.x - broadcast<V>(at(p.x, j))); };
    for_each_distance<V>(neighbours, apart, [&](int j, const Distance<V, D>& x_ij) FRESHET_INLINE_LAMBDA {
      if (counts(j)) add_pair(kernel, stabilise, i, there<V>(j), x_ij, sum);
    });
    return sum;
  }

  // The force of the neighbours' images: what i's image feels from the neighbours, mirrored back.
  KOKKOS_INLINE_FUNCTION void add_images(int c, const Here<Lane, D>& i, ForceSums<Lane, D>& sum) const {
    walls.for_each_image(c, i.x, [&](const Image<D>& image, Lane weight, const WallPiece& piece) {
      Here<Lane, D> other = i;
      other.x = image(i.x);
      other.v = image.turn(i.v);
      if constexpr (Stabilise::velocity_gradient) other.strain = image.turn(i.strain);
      if constexpr (Stabilise::depth_gradient) other.depth_slope = image.turn(i.depth_slope);
      const double ahead = walls.foremost(piece, other.x), reach = kernel.support * largest(i.h);
      const ForceSums<Lane, D> felt = walk(c, other, [&](int j) {
        return walls.mirrors(piece, at(p.x, j), larger(reach, kernel.support * p.h(j)) + ahead);
      });
      sum.t += weight * image.turn_back(felt.t);
      sum.signal = larger(sum.signal, weight * felt.signal);
    });
  }

  // Virtual particles: i's own state and slopes, the velocity mirrored.
  KOKKOS_INLINE_FUNCTION void add_wall_point(const Here<Lane, D>& i, int k, Lane mass,
                                             ForceSums<Lane, D>& sum) const {
    const Vec<Lane, D> to_wall = i.x - broadcast(at(walls.x, k)),
                       normal_velocity = broadcast(walls.projector, k) * i.v;
    const Lane r2 = dot(to_wall, to_wall) + tiny_square, inv_r = rsqrt(r2);
    const Lane closing = 2.0 * dot(to_wall, normal_velocity), slope = quadratic(i.strain, to_wall);
    for (int n = 0; n < walls.stretch.count; ++n) {
      const double s = walls.stretch.factor[n];
      const Lane dw = kernel.slope(s * r2 * inv_r * i.inv_h);
      const PairState<Lane> pair{s * closing,
                                 s * s * slope,
                                 s * s * slope,
                                 2.0 * i.celerity,
                                 inv_r * (1.0 / s) / (2.0 * i.rho),
                                 s * s * r2,
                                 2.0 * i.h,
                                 i.rho,
                                 i.rho,
                                 0.0,
                                 0.0,
                                 i.pressure,
                                 i.pressure};
      sum.t += (walls.pushes(s) * stabilise(pair).i * mass * i.weight_per_mass * dw * inv_r) * to_wall;
      sum.signal = larger_where(dw < Lane(0.0), sum.signal, size_of(closing) * inv_r);
    }
  }

  KOKKOS_INLINE_FUNCTION void operator()(int c) const {
    const Lanes me = clusters(c);
    const Lane m = me.load(p.m);
    Here<Lane, D> i{
        me.load(p.x),        me.load(p.v_pred),   me.load(p.rho),        me.load(p.h), me.load(p.inv_h),
        me.load(p.pressure), me.load(p.celerity), me.load(p.weight) / m, {},           {}};
    if constexpr (Stabilise::velocity_gradient) i.strain = me.load(p.strain);
    if constexpr (Stabilise::depth_gradient) i.depth_slope = me.load(p.depth_slope);
    const ForceSums<Lane, D> pairs = all(c, i);
    ForceSums<Lane, D> sum = pairs;
    if (walls.on && walls.mirror) {
      add_images(c, i, sum);
    } else if (walls.on) {
      const Lane mass = walls.virtual_mass(m, me.load(p.h0) * i.inv_h, i.rho);
      walls.near.for_each(c, [&](int k) { add_wall_point(i, k, mass * walls.share(k), sum); });
    }
    me.store(p.t, sum.t);
    me.store(p.signal, sum.signal);
  }
};

}  // namespace

template <int D, bool single>
void sum_force(const ForceRequest<D>& request) {
  std::visit(
      [&](const auto& k, const auto& stabilise) {
        using Force = InternalForce<D, std::decay_t<decltype(k)>, std::decay_t<decltype(stabilise)>, single>;
        launch("swe::force", balanced(request.clusters.size()),
               Force{k, request.clusters, request.near, request.walls, request.p, stabilise});
      },
      request.kernel, request.stabilisation);
}

}  // namespace freshet::swe
