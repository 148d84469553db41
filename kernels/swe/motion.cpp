#include "kernels/swe/motion.hpp"

namespace freshet::swe {
namespace {

// exp(z) for the prediction of the density: second order, positive for |z| < 2.
KOKKOS_FORCEINLINE_FUNCTION double growth(double z) {
  const double half = 0.5 * clamp(z, -0.5, 0.5);
  return (1 + half) / (1 - half);
}

}  // namespace

template <int D>
void kick_and_drift(const Particles<D>& p, const MotionOptions<D>& options, int n, double dt) {
  const Particles<D> f = p;
  const LengthBounds bounds = options.bounds;
  const bool friction = options.friction.has_value(), imposed = options.imposed;
  const Field<double> drag = options.drag;
  const Field<int> kind = options.kind;
  Kokkos::parallel_for("swe::kick_and_drift", Range(0, n), KOKKOS_LAMBDA(int i) {
        const bool moved = imposed && kind(i) != 0;
        const Vec<double, D> half_kick = (0.5 * dt) * at(f.a, i);
        Vec<double, D> v = at(f.v, i) + half_kick;
        if (friction && !moved) v = slowed<D>(v, drag(i), 0.5 * dt);
        Vec<double, D> v_pred = v + half_kick;
        if (friction && !moved) v_pred = slowed<D>(v_pred, drag(i), 0.5 * dt);
        put(f.v, i, v);
        put(f.v_pred, i, v_pred);
        put(f.x, i, at(f.x, i) + dt * v);
        const double rho = f.rho(i) * growth(dt * f.rate(i) / f.rho(i));
        f.rho(i) = rho;
        const double h = smoothing_length<D>(f.kh(i), rho);
        f.h(i) = moved ? h : clamp(h, bounds.floor * f.h0(i), bounds.cap * f.h0(i));
      });
}

template <int D>
double accelerate_and_kick(const Particles<D>& p, const MotionOptions<D>& options, int n, double kick_dt) {
  const Particles<D> f = p;
  const bool with_bed = options.bed.has_value(), friction = options.friction.has_value(), imposed = options.imposed;
  const std::optional<Bed<D>> bed = options.bed;
  const std::optional<Friction> roughness = options.friction;
  const bool variational = with_bed && bed->variational;
  const double g = options.gravity;
  const Field<double> drag = options.drag;
  const Field<int> kind = options.kind;
  double crossing = 0;
  Kokkos::parallel_reduce(
      "swe::accelerate", Range(0, n),
      KOKKOS_LAMBDA(int i, double& least) {
        least = smaller(least, f.h(i) / (f.celerity(i) + f.signal(i)));
        if (imposed && kind(i) != 0) {
          put(f.a, i, Vec<double, D>());
          if (with_bed) bed->level(i) = bed->spline.at(at(f.x, i)).b;
          return;
        }
        Vec<double, D> a = -1.0 * at(f.t, i);
        if (with_bed) {
          const BedPoint<D> b = bed->spline.at(at(f.x, i));
          bed->level(i) = b.b;
          // a = -t - B (g + v.k v - t.B) / (1 + B.B); without the curvature terms -t - g B.
          const double push = variational ? (g + quadratic(b.curvature, at(f.v_pred, i)) + dot(a, b.slope)) / (1 + dot(b.slope, b.slope)) : g;
          a += -push * b.slope;
        }
        put(f.a, i, a);
        Vec<double, D> v = at(f.v, i) + kick_dt * a;
        if (friction) {
          drag(i) = roughness->drag(f.rho(i));
          v = slowed<D>(v, drag(i), kick_dt);
        }
        put(f.v, i, v);
      },
      Kokkos::Min<double>(crossing));
  return crossing;
}

template void kick_and_drift<1>(const Particles<1>&, const MotionOptions<1>&, int, double);
template void kick_and_drift<2>(const Particles<2>&, const MotionOptions<2>&, int, double);
template double accelerate_and_kick<1>(const Particles<1>&, const MotionOptions<1>&, int, double);
template double accelerate_and_kick<2>(const Particles<2>&, const MotionOptions<2>&, int, double);

}  // namespace freshet::swe
