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
  Lane rho, inv_h, pressure, celerity, weight_per_mass;
  Sym<Lane, D> strain;
};

template <int D, class Stabilise>
struct InternalForce {
  ClusterSet clusters;
  NeighbourView near;
  WallView<D> walls;
  Particles<D> p;
  Stabilise stabilise;

  KOKKOS_FORCEINLINE_FUNCTION void add_pair(const Here<D>& i, int j, ForceSums<D>& sum) const {
    const Vec<Lane, D> x_ij = i.x - broadcast(at(p.x, j)), v_ij = i.v - broadcast(at(p.v_pred, j));
    const Lane r2 = dot(x_ij, x_ij) + tiny_square, rho_sum = i.rho + p.rho(j);
    const Lane inv = rsqrt(rho_sum * rho_sum * r2);  // 1 / ((rho_i + rho_j) r)
    const Lane inv_r = inv * rho_sum, r = r2 * inv_r;
    const Lane q_i = r * i.inv_h, q_j = r * p.inv_h(j);
    PairJump<Lane> pair{dot(v_ij, x_ij), Lane(0.0), Lane(0.0), i.celerity + p.celerity(j), inv};
    if constexpr (Stabilise::gradient) {
      pair.slope_i = quadratic(i.strain, x_ij);
      pair.slope_j = quadratic(broadcast(p.strain, j), x_ij);
    }
    const Lane half_pi = stabilise(pair);
    const Lane from_i = (i.pressure + half_pi) * (p.m(j) * i.weight_per_mass) * Kernel<D>::slope(q_i);
    const Lane from_j = (p.pressure(j) + half_pi) * p.weight(j) * Kernel<D>::slope(q_j);
    sum.t += ((from_i + from_j) * inv_r) * x_ij;
    sum.signal = larger(sum.signal, reach_mask(smaller(q_i, q_j)) * larger(pair.jump, -pair.jump) * inv_r);
  }

  // 1 within the support, 0 beyond.
  static KOKKOS_FORCEINLINE_FUNCTION Lane reach_mask(Lane q) {
    return select(q < Lane(Kernel<D>::support), Lane(1.0), Lane(0.0));
  }

  // The force of the neighbours' images: what i's image feels from the neighbours, mirrored back.
  KOKKOS_INLINE_FUNCTION void add_images(int c, const Here<D>& i, ForceSums<D>& sum) const {
    walls.for_each_image(c, i.x, [&](const Image<D>& image, Lane weight, const WallSegment& segment) {
      Here<D> other = i;
      other.x = image(i.x);
      other.v = image.turn(i.v);
      if constexpr (Stabilise::gradient) other.strain = image.turn(i.strain);
      ForceSums<D> felt;
      near.for_each(c, [&](int j) {
        if (walls.mirrors(segment, at(p.x, j))) add_pair(other, j, felt);
      });
      sum.t += weight * image.turn_back(felt.t);
      sum.signal = larger(sum.signal, weight * felt.signal);
    });
  }

  // Virtual particles: i's own state and slopes, the normal velocity mirrored.
  KOKKOS_INLINE_FUNCTION void add_wall_point(const Here<D>& i, int k, Lane mass, ForceSums<D>& sum) const {
    const Vec<Lane, D> to_wall = i.x - broadcast(at(walls.x, k)), normal_velocity = broadcast(walls.projector, k) * i.v;
    const Lane r2 = dot(to_wall, to_wall) + tiny_square, inv_r = rsqrt(r2);
    const Lane closing = 2.0 * dot(to_wall, normal_velocity), slope = quadratic(i.strain, to_wall);
    for (const double s : {2.0, 4.0}) {
      const Lane dw = Kernel<D>::slope(s * r2 * inv_r * i.inv_h);
      const PairJump<Lane> pair{s * closing, s * s * slope, s * s * slope, 2.0 * i.celerity, inv_r * (1.0 / s) / (2.0 * i.rho)};
      const Lane full = 2.0 * (i.pressure + stabilise(pair));
      sum.t += (full * mass * i.weight_per_mass * dw * inv_r) * to_wall;
      const Lane inside = select(dw < Lane(0.0), Lane(1.0), Lane(0.0));
      sum.signal = larger(sum.signal, inside * larger(closing, -closing) * inv_r);
    }
  }

  KOKKOS_INLINE_FUNCTION void operator()(int c) const {
    const Lanes me = clusters(c);
    const Lane m = me.load(p.m);
    Here<D> i{me.load(p.x), me.load(p.v_pred), me.load(p.rho), me.load(p.inv_h), me.load(p.pressure), me.load(p.celerity),
              me.load(p.weight) / m, {}};
    if constexpr (Stabilise::gradient) i.strain = me.load(p.strain);
    ForceSums<D> sum;
    near.for_each(c, [&](int j) { add_pair(i, j, sum); });
    if (walls.on && walls.mirror) {
      add_images(c, i, sum);
    } else if (walls.on) {
      const Lane mass = D == 1 ? m : m * me.load(p.h0) * i.inv_h;
      walls.near.for_each(c, [&](int k) { add_wall_point(i, k, mass, sum); });
    }
    me.store(p.t, sum.t);
    me.store(p.signal, sum.signal);
  }
};

}  // namespace

template <int D>
void internal_force(const ClusterSet& clusters, const NeighbourView& near, const WallView<D>& walls, const Particles<D>& p,
                    const AnyStabilisation& stabilisation) {
  std::visit(
      [&](const auto& stabilise) {
        using Stabilise = std::decay_t<decltype(stabilise)>;
        Kokkos::parallel_for("swe::force", Range(0, clusters.size()),
                             InternalForce<D, Stabilise>{clusters, near, walls, p, stabilise});
      },
      stabilisation);
}

template void internal_force<1>(const ClusterSet&, const NeighbourView&, const WallView<1>&, const Particles<1>&,
                                const AnyStabilisation&);
template void internal_force<2>(const ClusterSet&, const NeighbourView&, const WallView<2>&, const Particles<2>&,
                                const AnyStabilisation&);

}  // namespace freshet::swe
