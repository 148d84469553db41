#include "kernels/swe/motion.hpp"

#include "cellgrid/parallel/launch.hpp"

namespace freshet::swe {
namespace {

// exp(z) for the prediction of the density: second order, positive for |z| < 2.
KOKKOS_FORCEINLINE_FUNCTION Lane growth(Lane z) {
  const Lane half = 0.5 * clamp(z, Lane(-0.5), Lane(0.5));
  return (1.0 + half) / (1.0 - half);
}

// What the bed adds to a = -t, storing its level: -B (g + v.k v - t.B) / (1 + B.B); classical: -g B, without
// curvature.
template <int D>
KOKKOS_FORCEINLINE_FUNCTION Vec<Lane, D> bed_acceleration(const BedTerm<D>& bed, const Lanes& me,
                                                          const Particles<D>& f, const Vec<Lane, D>& a,
                                                          Lane g) {
  if (!bed.variational) {
    const BedPoint<Lane, D> b = bed.spline.sloped_at(me.load(f.x));
    me.store(bed.level, b.b);
    return -g * b.slope;
  }
  const BedPoint<Lane, D> b = bed.spline.at(me.load(f.x));
  me.store(bed.level, b.b);
  const Lane push =
      (g + quadratic(b.curvature, me.load(f.v_pred)) + dot(a, b.slope)) / (1.0 + dot(b.slope, b.slope));
  return -push * b.slope;
}

// Time in which a particle moves by less than 2 h, from its speed and its acceleration: v t + a t^2/2 <= 2 h.
template <int D>
KOKKOS_FORCEINLINE_FUNCTION Lane free_path(Lane h, const Vec<Lane, D>& v, const Vec<Lane, D>& a) {
  return 2.0 * h / (root(dot(v, v)) + root(h * root(dot(a, a))) + 1e-100);
}

}  // namespace

template <int D>
void kick_and_drift(const Particles<D>& p, const MotionOptions<D>& options, int n, double dt) {
  const Particles<D> f = p;
  const LengthBounds bounds = options.bounds;
  const bool friction = options.friction.has_value();
  const ImposedLanes imposed = options.imposed;
  const Field<double> drag_field = options.drag;
  launch(
      "swe::kick_and_drift", Range(0, blocks(n)), KOKKOS_LAMBDA(int b) {
        const Lanes me = block(b, n);
        const Lane moved = imposed(me), half_dt = 0.5 * dt;
        const Vec<Lane, D> half_kick = half_dt * me.load(f.a);
        Vec<Lane, D> v = me.load(f.v) + half_kick;
        const Lane drag = friction ? (1.0 - moved) * me.load(drag_field) : Lane(0.0);
        if (friction) v = slowed<D>(v, drag, half_dt);
        Vec<Lane, D> v_pred = v + half_kick;
        if (friction) v_pred = slowed<D>(v_pred, drag, half_dt);
        me.store(f.v, v);
        me.store(f.v_pred, v_pred);
        me.store(f.x, me.load(f.x) + Lane(dt) * v);
        const Lane before = me.load(f.rho), rho = before * growth(dt * me.load(f.growth) / before),
                   h0 = me.load(f.h0);
        me.store(f.rho, rho);
        const Lane h = smoothing_length<D>(me.load(f.kh), rho);
        me.store(f.h, select(Lane(0.5) < moved, h, clamp(h, bounds.floor * h0, bounds.cap * h0)));
      });
}

template <int D>
double accelerate_and_kick(const Particles<D>& p, const MotionOptions<D>& options, int n, double kick_dt) {
  const Particles<D> f = p;
  const bool with_bed = options.bed.has_value(), friction = options.friction.has_value();
  const std::optional<BedTerm<D>> bed = options.bed;
  const std::optional<Friction> roughness = options.friction;
  const Lane g = options.gravity;
  const Field<double> drag_field = options.drag;
  const ImposedLanes imposed = options.imposed;
  const bool walled = options.walled;
  double crossing = 0;
  Kokkos::parallel_reduce(
      "swe::accelerate", Range(0, blocks(n)),
      KOKKOS_LAMBDA(int block_index, double& least) {
        const Lanes me = block(block_index, n);
        const Lane h = me.load(f.h);
        Lane time = h / (me.load(f.celerity) + me.load(f.signal));
        Vec<Lane, D> a = Lane(-1.0) * me.load(f.t);
        if (with_bed) a += bed_acceleration<D>(*bed, me, f, a, g);
        const Lane free = 1.0 - imposed(me);
        a = free * a;
        me.store(f.a, a);
        Vec<Lane, D> v = me.load(f.v) + Lane(kick_dt) * a;
        if (friction) {
          const Lane drag = roughness->drag(me.load(f.rho), me.load(f.x));
          me.store(drag_field, drag);
          v = slowed<D>(v, free * drag, Lane(kick_dt));
        }
        me.store(f.v, v);
        if (walled) time = smaller(time, free_path(h, v, a));
        least = smaller(least, smallest(time));
      },
      Kokkos::Min<double>(crossing));
  return crossing;
}

template void kick_and_drift<1>(const Particles<1>&, const MotionOptions<1>&, int, double);
template void kick_and_drift<2>(const Particles<2>&, const MotionOptions<2>&, int, double);
template double accelerate_and_kick<1>(const Particles<1>&, const MotionOptions<1>&, int, double);
template double accelerate_and_kick<2>(const Particles<2>&, const MotionOptions<2>&, int, double);

}  // namespace freshet::swe
