// The loop of internal_force.hpp, compiled once per dimension so that the two sets of variants compile side by side.
#pragma once
#include "cellgrid/balanced.hpp"
#include "kernels/swe/internal_force.hpp"

namespace freshet::swe {
namespace {

template <int D>
struct ForceSums {
  Vec<Lane, D> t;
  Lane signal{0.0};
};

template <int D>
struct Here {
  Vec<Lane, D> x, v;
  Lane rho, h, inv_h, pressure, celerity, weight_per_mass;
  Sym<Lane, D> strain;
  Vec<Lane, D> depth_slope;
};

template <int D, class K, class Stabilise>
struct InternalForce {
  K kernel;
  ClusterSet clusters;
  NeighbourView near;
  WallView<D> walls;
  Particles<D> p;
  Stabilise stabilise;

  KOKKOS_FORCEINLINE_FUNCTION void add_pair(const Here<D>& i, int j, ForceSums<D>& sum) const {
    const Vec<Lane, D> x_ij = i.x - broadcast(at(p.x, j)), v_ij = i.v - broadcast(at(p.v_pred, j));
    const Lane r2 = dot(x_ij, x_ij) + tiny_square, rho_j = p.rho(j), rho_sum = i.rho + rho_j;
    const Lane inv = rsqrt(rho_sum * rho_sum * r2);  // 1 / ((rho_i + rho_j) r)
    const Lane inv_r = inv * rho_sum, r = r2 * inv_r;
    const Lane q_i = r * i.inv_h, q_j = r * p.inv_h(j);
    PairState<Lane> pair{dot(v_ij, x_ij), 0.0, 0.0, i.celerity + p.celerity(j), inv, r2, i.h + p.h(j), i.rho, rho_j, 0.0, 0.0,
                         i.pressure, p.pressure(j)};
    if constexpr (Stabilise::velocity_gradient) {
      pair.slope_i = quadratic(i.strain, x_ij);
      pair.slope_j = quadratic(broadcast(p.strain, j), x_ij);
    }
    if constexpr (Stabilise::depth_gradient) {
      pair.depth_slope_i = dot(i.depth_slope, x_ij);
      pair.depth_slope_j = dot(broadcast(at(p.depth_slope, j)), x_ij);
    }
    const PairPressure<Lane> pressure = stabilise(pair);
    const Lane from_i = pressure.i * (p.m(j) * i.weight_per_mass) * kernel.slope(q_i);
    const Lane from_j = pressure.j * p.weight(j) * kernel.slope(q_j);
    sum.t += ((from_i + from_j) * inv_r) * x_ij;
    sum.signal = larger_where(smaller(q_i, q_j) < Lane(kernel.support), sum.signal, size_of(pair.jump) * inv_r);
  }

  // The sums over the neighbours that count. A local result and a copy of i: what has an address known elsewhere would be
  // written and read again at every pair.
  template <class Counts>
  KOKKOS_FORCEINLINE_FUNCTION ForceSums<D> walk(int c, const Here<D> i, const Counts& counts) const {
    ForceSums<D> sum;
    near.for_each(c, [&](int j) {
      if (counts(j)) add_pair(i, j, sum);
    });
    return sum;
  }

  // The force of the neighbours' images: what i's image feels from the neighbours, mirrored back.
  KOKKOS_INLINE_FUNCTION void add_images(int c, const Here<D>& i, ForceSums<D>& sum) const {
    walls.for_each_image(c, i.x, [&](const Image<D>& image, Lane weight, const WallSegment& segment) {
      Here<D> other = i;
      other.x = image(i.x);
      other.v = image.turn(i.v);
      if constexpr (Stabilise::velocity_gradient) other.strain = image.turn(i.strain);
      if constexpr (Stabilise::depth_gradient) other.depth_slope = image.turn(i.depth_slope);
      const double ahead = walls.foremost(segment, other.x), reach = kernel.support * largest(i.h);
      const ForceSums<D> felt = walk(c, other, [&](int j) {
        return walls.mirrors(segment, at(p.x, j), larger(reach, kernel.support * p.h(j)) + ahead);
      });
      sum.t += weight * image.turn_back(felt.t);
      sum.signal = larger(sum.signal, weight * felt.signal);
    });
  }

  // Virtual particles: i's own state and slopes, the velocity mirrored.
  KOKKOS_INLINE_FUNCTION void add_wall_point(const Here<D>& i, int k, Lane mass, ForceSums<D>& sum) const {
    const Vec<Lane, D> to_wall = i.x - broadcast(at(walls.x, k)), normal_velocity = broadcast(walls.projector, k) * i.v;
    const Lane r2 = dot(to_wall, to_wall) + tiny_square, inv_r = rsqrt(r2);
    const Lane closing = 2.0 * dot(to_wall, normal_velocity), slope = quadratic(i.strain, to_wall);
    for (int n = 0; n < walls.stretch.count; ++n) {
      const double s = walls.stretch.factor[n];
      const Lane dw = kernel.slope(s * r2 * inv_r * i.inv_h);
      const PairState<Lane> pair{s * closing, s * s * slope, s * s * slope, 2.0 * i.celerity, inv_r * (1.0 / s) / (2.0 * i.rho),
                                 s * s * r2,  2.0 * i.h,     i.rho,         i.rho,            0.0, 0.0, i.pressure, i.pressure};
      sum.t += (walls.pushes(s) * stabilise(pair).i * mass * i.weight_per_mass * dw * inv_r) * to_wall;
      sum.signal = larger_where(dw < Lane(0.0), sum.signal, size_of(closing) * inv_r);
    }
  }

  KOKKOS_INLINE_FUNCTION void operator()(int c) const {
    const Lanes me = clusters(c);
    const Lane m = me.load(p.m);
    Here<D> i{me.load(p.x), me.load(p.v_pred), me.load(p.rho), me.load(p.h), me.load(p.inv_h), me.load(p.pressure),
              me.load(p.celerity), me.load(p.weight) / m, {}, {}};
    if constexpr (Stabilise::velocity_gradient) i.strain = me.load(p.strain);
    if constexpr (Stabilise::depth_gradient) i.depth_slope = me.load(p.depth_slope);
    const ForceSums<D> pairs = walk(c, i, [](int) { return true; });
    ForceSums<D> sum = pairs;
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

template <int D>
void internal_force(const AnyKernel<D>& kernel, const ClusterSet& clusters, const NeighbourView& near, const WallView<D>& walls,
                    const Particles<D>& p, const AnyStabilisation& stabilisation) {
  std::visit(
      [&](const auto& k, const auto& stabilise) {
        using Force = InternalForce<D, std::decay_t<decltype(k)>, std::decay_t<decltype(stabilise)>>;
        Kokkos::parallel_for("swe::force", balanced(clusters.size()), Force{k, clusters, near, walls, p, stabilise});
      },
      kernel, stabilisation);
}

}  // namespace freshet::swe
