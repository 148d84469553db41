// The sums over a cluster's neighbours and its walls that the density iteration is made of.
#pragma once
#include "kernels/swe/density/density.hpp"
#include "kernels/swe/density/least_squares.hpp"
#include "kernels/swe/single_precision.hpp"

namespace freshet::swe {
namespace {

// sum_j m_j F (v_j - v_i) (x) (x_j - x_i), and its trace.
template <class V, int D>
struct Gradient;
template <class V>
struct Gradient<V, 1> {
  V xx{0.0};
  KOKKOS_FORCEINLINE_FUNCTION Gradient& operator+=(const Gradient& b) { return xx += b.xx, *this; }
  KOKKOS_FORCEINLINE_FUNCTION void add(const Vec<V, 1>& fd, const Vec<V, 1>& dv) { xx += fd.x * dv.x; }
  KOKKOS_FORCEINLINE_FUNCTION V divergence() const { return xx; }
};
template <class V>
struct Gradient<V, 2> {
  V ux{0.0}, uy{0.0}, vx{0.0}, vy{0.0};
  KOKKOS_FORCEINLINE_FUNCTION Gradient& operator+=(const Gradient& b) {
    return ux += b.ux, uy += b.uy, vx += b.vx, vy += b.vy, *this;
  }
  KOKKOS_FORCEINLINE_FUNCTION void add(const Vec<V, 2>& fd, const Vec<V, 2>& dv) {
    ux += fd.x * dv.x;
    uy += fd.y * dv.x;
    vx += fd.x * dv.y;
    vy += fd.y * dv.y;
  }
  KOKKOS_FORCEINLINE_FUNCTION V divergence() const { return ux + vy; }
};
template <class F, class... V>
KOKKOS_FORCEINLINE_FUNCTION auto each(const F& f, const Gradient<V, 1>&... a)
    -> Gradient<decltype(f(a.xx...)), 1> {
  return {f(a.xx...)};
}
template <class F, class... V>
KOKKOS_FORCEINLINE_FUNCTION auto each(const F& f, const Gradient<V, 2>&... a)
    -> Gradient<decltype(f(a.ux...)), 2> {
  return {f(a.ux...), f(a.uy...), f(a.vx...), f(a.vy...)};
}

// What a walk over the neighbours is for: density and its derivative by h; also d rho/dt; also grad v.
enum class Want { density, rate, gradient };

template <class V, int D>
struct PairSums {
  V density{0.0};        // sum m W
  V moment{0.0};         // sum m F r^2, F = -W'/r
  V closing{0.0};        // sum m F v_ji . x_ji
  Sym<V, D> spread;      // sum m F x_ji (x) x_ji: its trace is the moment
  Gradient<V, D> slope;  // sum m F v_ji (x) x_ji: its divergence is the closing

  // Number by number: a sum that is copied as a whole stays in memory while it is summed (g++ 12).
  KOKKOS_FORCEINLINE_FUNCTION PairSums& operator+=(const PairSums& b) {
    return density += b.density, moment += b.moment, closing += b.closing, spread += b.spread,
           slope += b.slope, *this;
  }
};

template <class F, int D, class... V>
KOKKOS_FORCEINLINE_FUNCTION auto each(const F& f, const PairSums<V, D>&... a)
    -> PairSums<decltype(f(a.density...)), D> {
  return {f(a.density...), f(a.moment...), f(a.closing...), each(f, a.spread...), each(f, a.slope...)};
}

template <int D>
struct Sums : PairSums<Lane, D> {
  WallSums<Lane, D> wall;
};

// One pair, all from one 1/r. apart: x_ji. (Of a structured binding g++ 12 stores a copy in every pair.)
template <Want want, class K, class V, int D>
KOKKOS_FORCEINLINE_FUNCTION void add_pair(const K& kernel, const Distance<V, D>& apart, const Vec<V, D>& v_ji,
                                          V m, V inv_h, PairSums<V, D>& sum) {
  const Vec<V, D>& x_ji = apart.x;
  const PairLength<V> length_ji = length(apart);
  const V inv_r = length_ji.per_r, r = length_ji.r;
  const auto k = kernel.at(r * inv_h);
  const V m_dw = -m * k.dw;
  sum.density += m * k.w;
  if constexpr (want == Want::gradient) {
    const Vec<V, D> f_x = (m_dw * inv_r) * x_ji;
    add_square(sum.spread, f_x, x_ji);
    sum.slope.add(f_x, v_ji);
  } else {
    sum.moment += m_dw * r;
    if constexpr (want == Want::rate) sum.closing += m_dw * inv_r * dot(v_ji, x_ji);
  }
}

// What a cluster's particles bring to their sums.
template <int D>
struct Self {
  Vec<Lane, D> x, v;
  Lane m, h0;
};

// Where the sums are taken.
template <class V, int D>
struct Seen {
  Vec<V, D> x, v;
  V inv_h;
};
template <class F, class V, int D>
KOKKOS_FORCEINLINE_FUNCTION auto each(const F& f, const Seen<V, D>& a) -> Seen<decltype(f(a.inv_h)), D> {
  return {each(f, a.x), each(f, a.v), f(a.inv_h)};
}

template <int D, class K, bool single>
struct SumDensity {
  K kernel;
  ClusterSet clusters;
  NeighbourView near;
  WallView<D> walls;
  Particles<D> p;

  KOKKOS_INLINE_FUNCTION Self<D> here(const Lanes& me) const {
    return {me.load(p.x), me.load(p.v_pred), me.load(p.m), me.load(p.h0)};
  }

  template <Want want>
  KOKKOS_INLINE_FUNCTION Sums<D> sum(int c, const Self<D>& i, Lane rho, Lane h) const {
    const Lane inv_h = 1.0 / h;
    const PairSums<Lane, D> pairs = all<want>(c, i.x, i.v, inv_h);
    Sums<D> s;
    s += pairs;
    if constexpr (want == Want::gradient) s.moment = trace(s.spread), s.closing = s.slope.divergence();
    const Lane per_volume = power<D>(inv_h);
    s.density *= per_volume;
    if (walls.on && walls.mirror) add_images(c, i, inv_h, s.wall);
    else if (walls.on) add_walls(c, i, walls.virtual_mass(i.m, i.h0 * inv_h, rho), inv_h, s.wall);
    return s;
  }

  template <Want want>
  KOKKOS_FORCEINLINE_FUNCTION PairSums<Lane, D> all(int c, const Vec<Lane, D> x, const Vec<Lane, D> v,
                                                    const Lane inv_h) const {
    if constexpr (single) return each(Folded{}, walk_single<want>(c, x, each(Twice{}, v), twice(inv_h)));
    else
      return by_register<Lane>(Seen<Lane, D>{x, v, inv_h},
                               [&](const auto& some, int part) FRESHET_INLINE_LAMBDA {
                                 return walk_some<want>(near.of(c, part), some, [](int) { return true; });
                               });
  }

  // Signs of x and v are those of x_ij and v_ij: only their products count.
  template <Want want>
  KOKKOS_FORCEINLINE_FUNCTION PairSums<Twin, D> walk_single(int c, const Vec<Lane, D> x, const Vec<Twin, D> v,
                                                            const Twin inv_h) const {
    PairSums<Twin, D> s;
    for_each_twin(near, c, [&](int a, int b, Twin keep) {
      const TwinRecord<4> j(p.single.motion(a), p.single.motion(b));
      add_pair<want>(kernel, distance(apart(x, p.x, a, b)), v - two_vectors<0, D>(j),
                     keep * j.template get<2>(), inv_h, s);
    });
    return s;
  }

  template <Want want, class Counts>
  KOKKOS_FORCEINLINE_FUNCTION PairSums<Lane, D> walk(int c, const Vec<Lane, D>& x, const Vec<Lane, D>& v,
                                                     Lane inv_h, const Counts& counts) const {
    return by_register<Lane>(Seen<Lane, D>{x, v, inv_h}, [&](const auto& some, int) FRESHET_INLINE_LAMBDA {
      return walk_some<want>(near.of(c), some, counts);
    });
  }
  // The sums over the neighbours that count, as seen from x moving at v. A local result, a copy of what sees:
  // sums whose address is known elsewhere would be written to memory at every pair.
  template <Want want, class V, class Counts>
  KOKKOS_FORCEINLINE_FUNCTION PairSums<V, D> walk_some(const NearList& neighbours, const Seen<V, D> i,
                                                       const Counts& counts) const {
    PairSums<V, D> s;
    const auto apart = [&](int j) FRESHET_INLINE_LAMBDA { return distance(broadcast<V>(at(p.x, j)) - i.x); };
    for_each_distance<V>(neighbours, apart, [&](int j, const Distance<V, D>& x_ji) FRESHET_INLINE_LAMBDA {
      if (!counts(j)) return;
      Vec<V, D> v_ji;
      if constexpr (want != Want::density) v_ji = broadcast<V>(at(p.v_pred, j)) - i.v;
      add_pair<want>(kernel, x_ji, v_ji, V(p.m(j)), i.inv_h, s);
    });
    return s;
  }

  // Whether the sums depend on the particle's own depth beside its h: through virtual particles that follow
  // it.
  KOKKOS_INLINE_FUNCTION bool follow_depth(int c) const {
    return walls.on && !walls.mirror && walls.near.length(c) > 0;
  }

  // What the neighbours' images add: the cluster's own image sees the neighbours.
  KOKKOS_INLINE_FUNCTION void add_images(int c, const Self<D>& i, Lane inv_h, WallSums<Lane, D>& wall) const {
    const Lane per_volume = power<D>(inv_h);
    walls.for_each_image(c, i.x, [&](const Image<D>& image, Lane weight, const WallPiece& piece) {
      const Vec<Lane, D> x_image = image(i.x);
      const double limit = kernel.support / smallest(inv_h) + walls.foremost(piece, x_image);
      if (limit <= 0) return;
      const PairSums<Lane, D> s = walk<Want::rate>(
          c, x_image, image.turn(i.v), inv_h, [&](int j) { return walls.mirrors(piece, at(p.x, j), limit); });
      wall.density += weight * per_volume * s.density;
      wall.moment += weight * per_volume * inv_h * s.moment;
      wall.approach += weight * per_volume * inv_h * s.closing;
    });
  }

  KOKKOS_INLINE_FUNCTION void add_walls(int c, const Self<D>& i, Lane mass, Lane inv_h,
                                        WallSums<Lane, D>& s) const {
    walls.near.for_each(c, [&](int k) {
      const Vec<Lane, D> normal_velocity = broadcast(walls.projector, k) * i.v;
      add_wall(kernel, walls.stretch, i.x - broadcast(at(walls.x, k)), normal_velocity, inv_h,
               mass * walls.share(k), s);
    });
  }
};

}  // namespace
}  // namespace freshet::swe
