#include "kernels/fpm/pressure/projection.hpp"

#include "cellgrid/parallel/launch.hpp"
#include "kernels/fpm/pressure/spray.hpp"

namespace freshet::fpm {
namespace {

// Velocities of points nearer than edge_reach supports to walls and surface are drawn by this part towards
// the fitted ones in each step: next to one-sided stencils the projection lets waves of two spacings grow (by
// up to 5 % in a step on disordered points).
constexpr double edge_smoothing = 0.1, edge_reach = 0.5;

// A residual is good enough that leaves velocities of this part x tolerance of the flow's (1e-8 of them with
// a tolerance of 1e-9): water that stands still is solved for to the tolerance itself.
constexpr double velocity_share = 10;

KOKKOS_FORCEINLINE_FUNCTION bool is_wall(int kind) { return kind != in_fluid; }

// A film: wall points with a free surface this near have no pressure. Between 0 there and that of a wall
// point half a spacing away, a tenth of a spacing apart, slopes threw points off walls at ten times their
// speed.
constexpr double film_thickness = 0.11, film_reach = 0.32;  // x support: 0.35 and 1 spacing

KOKKOS_INLINE_FUNCTION bool in_film(const Neighbourhood<2>& around, const Flow& flow, int cluster, int i) {
  const Vec<double, 2> n = at(flow.normal, i);
  const double h = around.h(i), far = film_reach * h;
  bool found = false;
  around.near.for_each(cluster, [&](int j) {
    if (found || flow.surface(j) == 0 || is_wall(flow.kind(j))) return;
    const Vec<double, 2> d = around.period.shortest(at(flow.x, j) - at(flow.x, i));
    found = dot(d, d) < far * far && dot(d, n) < film_thickness * h;
  });
  return found;
}

// Of velocities next to air, differences with positive weights alone [1/m2 x v]: no stress across the
// surface. The fitted one there is one-sided and has growing modes whatever the time step.
KOKKOS_INLINE_FUNCTION Vec<Lane, 2> surface_laplacian(const StencilView<2>& stencils, int c,
                                                      const VecField<double, 2>& v) {
  const Lanes me = stencils.around.clusters(c);
  const Vec<Lane, 2> here = me.load(v);
  Vec<Lane, 2> sum;
  Lane spread{1e-300};
  stencils.around.for_each(c, [&](int j, const Terms<Lane, 2>& m, const Lane& w) {
    sum += w * (broadcast(at(v, j)) - here);
    spread += w * (m[1] * m[1] + m[2] * m[2]);
  });
  const Lane per_h = 1.0 / me.load(stencils.around.h);
  return (4.0 * per_h * per_h / spread) * sum;
}

KOKKOS_INLINE_FUNCTION Vec<Lane, 2> viscous_laplacian(const StencilView<2>& stencils, const Flow& flow,
                                                      int c) {
  const Lanes me = stencils.around.clusters(c);
  const Lane open =
      lanes_of<Lane>([&](int lane) { return lane < me.count && flow.surface(me.first + lane) ? 1.0 : 0.0; });
  const Vec<Lane, 2> inside = stencils.laplacian(c, flow.v);
  if (!any(Lane(0.0) < open)) return inside;
  return inside + open * (surface_laplacian(stencils, c, flow.v) - inside);
}

// v* at the points of one cluster.
template <bool Viscous>
struct Predictor {
  StencilView<2> stencils;
  FlowRule rule;
  Flow flow;
  Backward time;

  KOKKOS_INLINE_FUNCTION void operator()(int c) const {
    const Lanes me = stencils.around.clusters(c);
    Vec<Lane, 2> a = broadcast(rule.force);
    a += Lane(-1 / rule.density) * stencils.gradient(c, flow.q);
    if constexpr (Viscous) a += Lane(rule.viscosity) * viscous_laplacian(stencils, flow, c);
    me.store(flow.v_star,
             Lane(time.c0) * me.load(flow.v) + Lane(time.c1) * me.load(flow.v_old) + Lane(time.tau) * a);
  }
};

}  // namespace

void advect(const Flow& flow, const Period& period, double dt, double ratio) {
  launch(
      "fpm::advect", Range(0, flow.points), KOKKOS_LAMBDA(int i) {
        const Vec<double, 2> v = at(flow.v, i), mean = v + (0.5 * ratio) * (v - at(flow.v_old, i));
        put(flow.x, i, period.wrap(at(flow.x, i) + dt * mean));
      });
}

double fastest(const Flow& flow) {
  double v2 = 0;
  Kokkos::parallel_reduce(
      "fpm::fastest", Range(0, flow.points),
      KOKKOS_LAMBDA(int i, double& most) { most = larger(most, dot(at(flow.v, i), at(flow.v, i))); },
      Kokkos::Max<double>(v2));
  return root(v2);
}

ProjectionReport Projection::advance(const Neighbourhood<2>& around, const Rows& rows, const Flow& flow,
                                     const Backward& time) {
  ProjectionReport report;
  {
    const TimedRegion region("fpm::derivatives");
    report.poor = stencils_.find(around).poor;
    find_rows(around, flow);
    guess_pressure(flow);
    predict(flow, time);
    if (rule_.implicit) report.viscosity = diffuse(flow, time);
    hold_walls(flow);
    find_sources(flow, time);
  }
  {
    const TimedRegion region("fpm::pressure");
    poisson_.assemble(stencils_.view(), rows, {flow.row, flow.normal});
    linear::BiCgStabOptions options;
    options.tolerance = rule_.tolerance;
    options.floor = 1e-12 * pressure_scale(flow);  // round-off of the pressure itself
    options.enough = velocity_share * rule_.tolerance * residual_of_speed(around, flow, time);
    report.poisson = poisson_.solve({flow.source, flow.flux, flow.value}, flow.phi, options);
  }
  correct(flow, time);
  report.limited = limit_spray(around, flow, rule_.force, time.tau);
  settle(flow);
  if (rule_.scheme.fitted) smooth_edges(flow);
  return report;
}

// What each point's row of the pressure equation is.
void Projection::find_rows(const Neighbourhood<2>& around, const Flow& flow) {
  const TankView tank = tank_;
  launch(
      "fpm::find_rows", Range(0, around.clusters.size()), KOKKOS_LAMBDA(int c) {
        const Lanes me = around.clusters(c);
        for (int i = me.first; i < me.first + me.count; ++i) {
          const bool wall = is_wall(flow.kind(i));
          put(flow.normal, i, wall ? tank.normal(flow.side(i), flow.kind(i)) : Vec<double, 2>{});
          flow.row(i) = flow.surface(i) || (wall && in_film(around, flow, c, i)) ? row_value
                        : wall                                                   ? row_flux
                                                                                 : row_equation;
        }
      });
}

void Projection::guess_pressure(const Flow& flow) {
  const PressureScheme scheme = rule_.scheme;
  if (scheme.fitted) stencils_.fit(flow.p, flow.q);
  launch(
      "fpm::guess_pressure", Range(0, flow.points), KOKKOS_LAMBDA(int i) {
        if (scheme.incremental) flow.q(i) = flow.p(i);
        if (!(scheme.fitted || scheme.incremental) || flow.row(i) == row_value) flow.q(i) = 0;
        flow.value(i) = -flow.q(i);
        if (!scheme.fitted) flow.phi(i) = 0;
      });
}

void Projection::predict(const Flow& flow, const Backward& time) {
  const Range clusters(0, stencils_.view().around.clusters.size());
  if (rule_.viscosity > 0 && !rule_.implicit)
    launch("fpm::predict", clusters, Predictor<true>{stencils_.view(), rule_, flow, time});
  else launch("fpm::predict", clusters, Predictor<false>{stencils_.view(), rule_, flow, time});
}

linear::BiCgStabReport Projection::diffuse(const Flow& flow, const Backward& time) {
  return viscosity_.solve(stencils_.view(), {flow.kind, flow.surface, flow.normal, rule_.slip, time.c1 == 0},
                          rule_.viscosity * time.tau, flow.v_star, flow.v);
}

// The printed schemes'.
void Projection::hold_walls(const Flow& flow) {
  if (!rule_.scheme.as_printed) return;
  launch(
      "fpm::hold_walls", Range(0, flow.points), KOKKOS_LAMBDA(int i) {
        if (is_wall(flow.kind(i))) put(flow.v_star, i, Vec<double, 2>{});
      });
}

void Projection::find_sources(const Flow& flow, const Backward& time) {
  const StencilView<2> view = stencils_.view();
  const double factor = rule_.density / time.tau;
  launch(
      "fpm::sources", Range(0, view.around.clusters.size()), KOKKOS_LAMBDA(int c) {
        const Lanes me = view.around.clusters(c);
        me.store(flow.source, factor * (view.divergence(c, flow.v_star) - Lane(flow.expansion)));
        me.store(flow.flux, factor * dot(me.load(flow.normal), me.load(flow.v_star)));
      });
}

void Projection::correct(const Flow& flow, const Backward& time) {
  const StencilView<2> view = stencils_.view();
  const double factor = time.tau / rule_.density;
  launch(
      "fpm::correct", Range(0, view.around.clusters.size()), KOKKOS_LAMBDA(int c) {
        const Lanes me = view.around.clusters(c);
        me.store(flow.v_star, me.load(flow.v_star) - Lane(factor) * view.gradient(c, flow.phi));
      });
}

void Projection::settle(const Flow& flow) {
  const bool slip = rule_.slip;
  launch(
      "fpm::new_state", Range(0, flow.points), KOKKOS_LAMBDA(int i) {
        put(flow.v_old, i, at(flow.v, i));
        put(flow.v, i, held(flow, i, at(flow.v_star, i), slip));
        flow.p(i) = flow.row(i) == row_value ? 0.0 : flow.q(i) + flow.phi(i);
      });
}

void Projection::smooth_edges(const Flow& flow) {
  const StencilView<2> view = stencils_.view();
  const bool slip = rule_.slip;
  launch(
      "fpm::smooth_edges", Range(0, view.around.clusters.size()), KOKKOS_LAMBDA(int c) {
        const Lanes me = view.around.clusters(c);
        const Vec<Lane, 2> v = me.load(flow.v);
        const Lane edge = view.around.any_near(
            c, edge_reach, [&](int j) { return flow.surface(j) == 1 || is_wall(flow.kind(j)); });
        Vec<Lane, 2> change;
        if (any(Lane(0.0) < edge))
          change = (edge_smoothing * edge) * (Vec<Lane, 2>{view.fit(c, flow.v.x), view.fit(c, flow.v.y)} - v);
        me.store(flow.v_star, v + change);
      });
  launch(
      "fpm::hold_edges", Range(0, flow.points),
      KOKKOS_LAMBDA(int i) { put(flow.v, i, held(flow, i, at(flow.v_star, i), slip)); });
}

// A residual r of a row with s per source leaves the divergence tau r / (rho s), over a support the velocity
// h tau r / (rho s): the root of the sum of squares of the residuals that leave each point its own speed
// [Pa].
double Projection::residual_of_speed(const Neighbourhood<2>& around, const Flow& flow, const Backward& time) {
  const Field<double> per_source = poisson_.per_source(), h = around.h;
  const double sum = sum_of_particles<1>(
      "fpm::speed", flow.points, KOKKOS_LAMBDA(int i) {
        const double share = per_source(i) / h(i);
        return Addends<1>{{share * share * dot(at(flow.v, i), at(flow.v, i))}};
      })[0];
  return rule_.density / time.tau * root(sum);
}

// Root of the sum of squares of q [Pa].
double Projection::pressure_scale(const Flow& flow) { return root(linear::dot(flow.points, flow.q, flow.q)); }

}  // namespace freshet::fpm
