#include "cellgrid/parallel/launch.hpp"
#include "kernels/fpm/pressure/projection.hpp"

namespace freshet::fpm {
namespace {

// The equation's and the walls' right sides at the points of one cluster.
struct FindSources {
  StencilView<2> stencils;
  FlowRule rule;
  Flow flow;

  KOKKOS_INLINE_FUNCTION void operator()(int c) const {
    const Lanes me = stencils.around.clusters(c);
    const Vec<Lane, 2> du = stencils.gradient(c, flow.v_star.x), dv = stencils.gradient(c, flow.v_star.y),
                       n = me.load(flow.normal);
    Vec<Lane, 2> force = broadcast(rule.force);
    if (rule.viscosity > 0) force += Lane(rule.viscosity) * stencils.laplacian(c, flow.v);
    me.store(flow.source, Lane(-rule.density) * (du.x * du.x + 2.0 * du.y * dv.x + dv.y * dv.y));
    me.store(flow.flux, Lane(rule.density) * dot(n, force));
  }
};

}  // namespace

PoissonReport Projection::pressure_of_flow(const Flow& flow, const Field<double>& pressure) {
  const TimedRegion region("fpm::flow_pressure");
  const StencilView<2> view = stencils_.view();
  stencils_.fit(flow.v.x, flow.v_star.x);
  stencils_.fit(flow.v.y, flow.v_star.y);
  const bool slip = rule_.slip;
  launch(
      "fpm::flow_walls", Range(0, flow.points),
      KOKKOS_LAMBDA(int i) { put(flow.v_star, i, held(flow, i, at(flow.v_star, i), slip)); });
  launch("fpm::flow_sources", Range(0, view.around.clusters.size()), FindSources{view, rule_, flow});
  launch(
      "fpm::flow_guess", Range(0, flow.points), KOKKOS_LAMBDA(int i) {
        pressure(i) = flow.p(i);
        flow.value(i) = 0;
      });
  linear::BiCgStabOptions options;
  options.tolerance = rule_.tolerance;
  options.floor = 1e-12 * root(linear::dot(flow.points, flow.p, flow.p));
  return poisson_.solve({flow.source, flow.flux, flow.value}, pressure, options);
}

}  // namespace freshet::fpm
