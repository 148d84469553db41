#include "kernels/fpm/pressure/viscosity.hpp"

#include "cellgrid/parallel/launch.hpp"

namespace freshet::fpm {
namespace {

constexpr double equation_weight = 100;  // as for the pressure

// The rows of one cluster, without what walls do to the directions.
struct AssembleViscousRows {
  StencilView<2> stencils;
  ViscousPlaces places;
  linear::ClusterMatrix matrix;
  Field<double> per_b;
  double k;

  // Which lanes have a row with a flux, and which are held at their right side.
  struct RowParts {
    Lane flux{0.0}, free{1.0};
    bool any_flux = false;
  };
  KOKKOS_INLINE_FUNCTION RowParts parts_of(const Lanes& me) const {
    RowParts parts;
    for (int l = 0; l < lanes; ++l) {
      const int i = me.particle(l), kind = places.kind(i);
      const bool held = kind == in_corner || (kind == on_wall && !places.slip),
                 flux = !held && (kind == on_wall || places.surface(i));
      if (held) set_lane(parts.free, l, 0.0);
      if (flux) set_lane(parts.flux, l, 1.0);
      parts.any_flux = parts.any_flux || flux;
    }
    return parts;
  }

  // Factors of the fitted value under the equation and the flux, and what the equation's right side counts.
  struct FluxRow {
    Terms<Lane, 2> beta;
    Lane per_b;
  };
  KOKKOS_INLINE_FUNCTION FluxRow flux_row(int c, const Lanes& me) const {
    Moments<Lane, 2> moments;
    Vec<Lane, 2> inwards;
    stencils.around.for_each(c, [&](int, const Terms<Lane, 2>& m, const Lane& w) {
      moments.add(w, m);
      inwards.x += w * m[1];
      inwards.y += w * m[2];
    });
    const Vec<Lane, 2> wall = me.load(places.normal);
    const auto on_a_wall = Lane(0.5) < dot(wall, wall);
    const Lane per_length = rsqrt(dot(inwards, inwards) + Lane(1e-200));
    const Vec<Lane, 2> n{select(on_a_wall, wall.x, per_length * inwards.x),
                         select(on_a_wall, wall.y, per_length * inwards.y)};
    const Lane per_h = 1.0 / me.load(stencils.around.h), spread = k * per_h * per_h,
               scale = 1.0 / (1.0 + spread);
    const Terms<Lane, 2> r_p{{scale, Lane(0.0), Lane(0.0), -spread * scale, Lane(0.0), -spread * scale}};
    moments.add(Lane(equation_weight), r_p);
    moments.add(Lane(equation_weight), {{Lane(0.0), n.x, n.y, Lane(0.0), Lane(0.0), Lane(0.0)}});
    const Terms<Lane, 2> beta = value_factors(moments);
    return {beta, equation_weight * scale * dot(r_p, beta)};
  }

  KOKKOS_INLINE_FUNCTION void operator()(int c) const {
    const Lanes me = stencils.around.clusters(c);
    const RowParts parts = parts_of(me);
    const auto lap = stencils.load<StencilView<2>::slopes>(c, StencilView<2>::laplacian_first);
    FluxRow flux{};
    if (parts.any_flux) flux = flux_row(c, me);
    Lane sum{0.0};
    stencils.around.for_each(
        c, [&](int, const Terms<Lane, 2>& m, const Lane& w) { sum += w * of_slopes<Lane, 2>(m, lap); });
    const Lane per_diagonal = 1.0 / (1.0 + k * sum), direct = parts.free - parts.flux;
    int n = 0;
    stencils.around.for_each(c, [&](int, const Terms<Lane, 2>& m, const Lane& w) {
      const Lane entry = direct * per_diagonal * k * of_slopes<Lane, 2>(m, lap);
      matrix.set(c, n++, -w * (parts.any_flux ? entry + parts.flux * dot(m, flux.beta) : entry));
    });
    const Lane held = Lane(1.0) - parts.free;
    me.store(per_b, held + direct * per_diagonal + (parts.any_flux ? parts.flux * flux.per_b : Lane(0.0)));
  }
};

}  // namespace

void ImplicitViscosity::assemble(const StencilView<2>& stencils, double k) {
  const Neighbourhood<2>& around = stencils.around;
  const int n = around.points;
  matrix_.lay_out(around.clusters, around.near, n);
  if (per_b_.extent_int(0) < n + lanes)
    per_b_ = Field<double>("fpm.viscous_rows", static_cast<size_t>(n + n / 2 + lanes));
  for (Field<double>* f : {&b_, &x_}) reserve(*f, "fpm.viscous", 2 * n + lanes);
  launch("fpm::viscous_rows", Range(0, around.clusters.size()),
         AssembleViscousRows{stencils, places_, matrix_, per_b_, k});
}

void ImplicitViscosity::set_right_side(const VecField<double, 2>& v, const VecField<double, 2>& start) {
  const int n = matrix_.rows;
  const ViscousPlaces places = places_;
  const Field<double> b = b_, x = x_, per_b = per_b_;
  launch(
      "fpm::viscous_side", Range(0, n), KOKKOS_LAMBDA(int i) {
        const Vec<double, 2> full = at(v, i), normal = at(places.normal, i),
                             across = dot(full, normal) * normal;
        Vec<double, 2> side = per_b(i) * full;
        if (places.kind(i) != in_fluid && !places.slip) side = places.first_step ? full : across;
        else if (places.kind(i) == on_wall) side = across + per_b(i) * (full - across);
        b(i) = side.x, b(n + i) = side.y;
        const bool given = places.kind(i) == in_corner || (places.kind(i) == on_wall && !places.slip);
        x(i) = given ? side.x : start.x(i);
        x(n + i) = given ? side.y : start.y(i);
      });
}

// y := A x; on walls only what is along them.
void ImplicitViscosity::multiply(const Field<double>& x, const Field<double>& y) const {
  const linear::ClusterMatrix m = matrix_;
  const VecField<double, 2> normal = places_.normal;
  const VecField<double, 2> in{Kokkos::subview(x, std::make_pair(0, m.rows)),
                               Kokkos::subview(x, std::make_pair(m.rows, 2 * m.rows))};
  const VecField<double, 2> out{Kokkos::subview(y, std::make_pair(0, m.rows)),
                                Kokkos::subview(y, std::make_pair(m.rows, 2 * m.rows))};
  launch(
      "fpm::viscous_multiply", Range(0, m.clusters.size()), KOKKOS_LAMBDA(int c) {
        const Lanes me = m.clusters(c);
        const Vec<Lane, 2> n = me.load(normal), others = m.off_diagonal(c, in);
        me.store(out, me.load(in) + others - dot(others, n) * n);
      });
}

linear::BiCgStabReport ImplicitViscosity::solve(const StencilView<2>& stencils, const ViscousPlaces& places,
                                                double k, const VecField<double, 2>& v,
                                                const VecField<double, 2>& start) {
  const TimedRegion region("fpm::viscosity");
  places_ = places;
  assemble(stencils, k);
  set_right_side(v, start);
  const int n = matrix_.rows;
  linear::BiCgStabOptions options;
  options.tolerance = 1e-11;
  options.floor = 1e-300;
  const auto report = krylov_.solve(
      2 * n, [this](const auto& x, const auto& y) { multiply(x, y); },
      [n](const auto& r, const auto& z) { linear::follow(2 * n, r, 0, z); }, b_, x_, options);
  const Field<double> x = x_;
  launch(
      "fpm::viscous_result", Range(0, n), KOKKOS_LAMBDA(int i) {
        put(v, i, {x(i), x(n + i)});
      });
  return report;
}

}  // namespace freshet::fpm
