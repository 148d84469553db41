#include "kernels/sisph/open/open.hpp"

#include "cellgrid/parallel/launch.hpp"
#include "cellgrid/parallel/on_device.hpp"
#include "kernels/sisph/open/open_fit.hpp"

namespace freshet::sisph {
namespace {

// The surface's gradient at each place of the rim, from all water around it.
template <int D>
struct RimSlope {
  OpenFit<D> fit;
  Field<int> particle;
  VecField<double, D> slope;

  KOKKOS_FUNCTION void operator()(int k) const {
    const TracedWater<D>& w = fit.w;
    const int i = particle(k);
    const double level = w.water.bed(i) + larger(w.water.depth(i), 0.0);
    Sym<double, D> moment;
    Vec<double, D> sum;
    fit.for_each(at(w.x, i), [&](int j, double weight, const Vec<double, D>& d) {
      if (!(w.water.depth(j) > 0)) return;
      moment += outer(weight, d);
      sum += (weight * (w.water.bed(j) + w.water.depth(j) - level)) * d;
    });
    put(slope, i, (1 / w.spacing) * solved(moment, sum));
  }

 private:
  static KOKKOS_FORCEINLINE_FUNCTION Sym<double, 1> outer(double f, const Vec<double, 1>& d) {
    return {f * d.x * d.x};
  }
  static KOKKOS_FORCEINLINE_FUNCTION Sym<double, 2> outer(double f, const Vec<double, 2>& d) {
    return {f * d.x * d.x, f * d.x * d.y, f * d.y * d.y};
  }
};

template <int D>
struct TraceBack {
  OpenFit<D> fit;
  Field<int> particle;
  VecField<double, D> n, foot_v;
  Field<double> foot_depth, foot_out;
  double dt;

  KOKKOS_FUNCTION void operator()(int k) const {
    const TracedWater<D>& w = fit.w;
    const int i = particle(k);
    const Vec<double, D> x = at(w.x, i), out = at(n, k);
    double depth = w.water.depth(i), normal = dot(at(w.water.v, i), out), away = 0;
    Found<D> found;
    for (int pass = 0; pass < 3; ++pass) {
      away = dt * larger(normal + root(w.gravity * depth), 0.0);
      found = fit(x - away * out);
      if (!found.wet) break;
      depth = larger(found.level - found.bed, 0.0);
      normal = dot(found.v, out);
    }
    foot_depth(k) = found.wet ? depth : 0.0;
    put(foot_v, k, found.v);
    const double fall = away > 0 ? dt * w.gravity * (found.bed - w.water.bed(i)) / away : 0.0;  // dt g S0.n
    double drag = 0;
    if (w.g_n2.extent(0) > 0 && depth > 0)
      drag = dt * w.g_n2(i) * root(dot(found.v, found.v)) / (depth * ::cbrt(depth));
    foot_out(k) = (normal + fall) / (1 + drag);
  }
};

VecField<double, 1> vectors(std::size_t n, Vec<double, 1>) { return {Field<double>("sisph.rim_x", n)}; }
VecField<double, 2> vectors(std::size_t n, Vec<double, 2>) {
  return {Field<double>("sisph.rim_x", n), Field<double>("sisph.rim_y", n)};
}

// Of the water at rest.
template <int D>
std::vector<RimRecord> records(const std::vector<RimPlace<D>>& places, const TracedWater<D>& at_rest) {
  const auto depth = on_host(at_rest.water.depth), bed = on_host(at_rest.water.bed);
  const bool rough = at_rest.g_n2.extent(0) > 0;
  const auto g_n2 = rough ? on_host(at_rest.g_n2) : depth;
  std::vector<RimRecord> all;
  for (const RimPlace<D>& p : places) {
    const double n2 = rough ? g_n2(p.particle) / at_rest.gravity : 0.0;
    all.push_back({p.opening, p.outside, p.width, bed(p.particle), depth(p.particle), n2});
  }
  return all;
}

}  // namespace

template <int D>
OpenRim<D>::OpenRim(std::vector<LawInTime> laws, const std::vector<RimPlace<D>>& places,
                    const TracedWater<D>& traced)
    : count_(static_cast<int>(places.size())),
      laws_(std::move(laws), records(places, traced), traced.gravity, traced.spacing, D == 1),
      velocity_(vectors(places.size(), Vec<double, D>{})), foot_depth_("sisph.rim_foot_depth", places.size()),
      foot_out_("sisph.rim_foot_out", places.size()), depth_("sisph.rim_depth", places.size()),
      foot_v_(vectors(places.size(), Vec<double, D>{})), flux_("sisph.rim_flux", 2) {
  std::vector<int> particle;
  std::vector<double> across, along, width;
  for (const RimPlace<D>& p : places) {
    particle.push_back(p.particle);
    across.push_back(p.n.x);
    along.push_back(y_of(p.n));
    width.push_back(p.width);
  }
  particle_ = on_device("sisph.rim_particle", particle);
  width_ = on_device("sisph.rim_width", width);
  n_.x = on_device("sisph.rim_x", across);
  if constexpr (D == 2) n_.y = on_device("sisph.rim_y", along);
}

template <int D>
void OpenRim<D>::find(const TracedWater<D>& traced, double t, double dt) {
  launch("sisph::trace_back", Range(0, count_),
         TraceBack<D>{{traced}, particle_, n_, foot_v_, foot_depth_, foot_out_, dt});
  laws_.find({foot_depth_, foot_out_, depth_}, t, dt);
  turn_velocities();
}

// Leaving water keeps its velocity along the line, entering water has none.
template <int D>
void OpenRim<D>::turn_velocities() {
  const VecField<double, D> n = n_, foot = foot_v_, velocity = velocity_;
  const Field<double> out = foot_out_;
  launch(
      "sisph::turn", Range(0, count_), KOKKOS_LAMBDA(int k) {
        const Vec<double, D> across = at(n, k), at_foot = at(foot, k);
        const Vec<double, D> along = at_foot - dot(at_foot, across) * across;
        put(velocity, k, out(k) * across + (out(k) > 0 ? 1.0 : 0.0) * along);
      });
}

template <int D>
void OpenRim<D>::impose(const Field<double>& bed, const Field<double>& level,
                        const Field<double>& depth) const {
  const Field<int> particle = particle_;
  const Field<double> found = depth_;
  launch(
      "sisph::impose_rim", Range(0, count_), KOKKOS_LAMBDA(int k) {
        const int i = particle(k);
        depth(i) = found(k);
        level(i) = bed(i) + found(k);
      });
}

template <int D>
void OpenRim<D>::extend(const TracedWater<D>& traced, const VecField<double, D>& slope) const {
  launch("sisph::rim_slope", Range(0, count_), RimSlope<D>{{traced}, particle_, slope});
}

template <int D>
void OpenRim<D>::set_before(const RimPush<D>& push, const VecField<double, D>& before) const {
  const Field<int> particle = particle_;
  const VecField<double, D> next = velocity_, to = before;
  const RimPush<D> by = push;
  const bool dragged = push.drag.extent(0) > 0;
  launch(
      "sisph::rim_before", Range(0, count_), KOKKOS_LAMBDA(int k) {
        const int i = particle(k);
        const double per = dragged ? 1 / (1 + by.drag(i)) : 1.0;
        put(to, i,
            by.theta * (at(next, k) + (by.impulse * per) * at(by.slope, i)) + (1 - by.theta) * at(by.v, i));
      });
}

template <int D>
void OpenRim<D>::set_end(const VecField<double, D>& end) const {
  const Field<int> particle = particle_;
  const VecField<double, D> next = velocity_, to = end;
  launch(
      "sisph::rim_end", Range(0, count_), KOKKOS_LAMBDA(int k) { put(to, particle(k), at(next, k)); });
}

// One place after the other: a line has few, and the host need not wait for a sum.
template <int D>
void OpenRim<D>::account(double dt) {
  const Field<double> width = width_, depth = depth_, out = foot_out_;
  const auto flux = flux_;
  const int places = count_;
  const double before = started_ ? 0.5 * dt : 0.0, now = dt - before;
  launch(
      "sisph::rim_flux", Range(0, 1), KOKKOS_LAMBDA(int) {
        OpenFlux rate;
        for (int k = 0; k < places; ++k) {
          const double q = -width(k) * depth(k) * out(k);
          rate.net += q, rate.gross += ::fabs(q);
        }
        flux(0).net += before * flux(1).net + now * rate.net;
        flux(0).gross += before * flux(1).gross + now * rate.gross;
        flux(1) = rate;
      });
  started_ = true;
}

template <int D>
OpenFlux OpenRim<D>::flux() const {
  return on_host(flux_)(0);
}

template <int D>
std::vector<double> OpenRim<D>::fluxes() const {
  const auto f = on_host(flux_);
  return {f(0).net, f(0).gross, f(1).net, f(1).gross, started_ ? 1.0 : 0.0};
}

template <int D>
void OpenRim<D>::set_fluxes(const std::vector<double>& f) {
  flux_ = on_device("sisph.rim_flux", std::vector<OpenFlux>{{f.at(0), f.at(1)}, {f.at(2), f.at(3)}});
  started_ = f.at(4) > 0;
}

template class OpenRim<1>;
template class OpenRim<2>;

}  // namespace freshet::sisph
