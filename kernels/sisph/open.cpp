#include "kernels/sisph/open.hpp"

#include <algorithm>
#include <cmath>

#include "cellgrid/assign.hpp"
#include "cellgrid/launch.hpp"
#include "kernels/sisph/open_fit.hpp"

namespace freshet::sisph {
namespace {

// The surface's gradient at each place of the rim, from all water around it.
template <int D>
struct RimSlope {
  Fit<D> fit;
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
  static KOKKOS_FORCEINLINE_FUNCTION Sym<double, 1> outer(double f, const Vec<double, 1>& d) { return {f * d.x * d.x}; }
  static KOKKOS_FORCEINLINE_FUNCTION Sym<double, 2> outer(double f, const Vec<double, 2>& d) {
    return {f * d.x * d.x, f * d.x * d.y, f * d.y * d.y};
  }
};

template <int D>
struct TraceBack {
  Fit<D> fit;
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
    if (w.g_n2.extent(0) > 0 && depth > 0) drag = dt * w.g_n2(i) * root(dot(found.v, found.v)) / (depth * ::cbrt(depth));
    foot_out(k) = (normal + fall) / (1 + drag);
  }
};

template <class T>
void copy_in(const std::vector<T>& values, const Field<T>& field) {
  const auto host = Kokkos::create_mirror_view(field);
  for (std::size_t k = 0; k < values.size(); ++k) host(k) = values[k];
  assign(field, host);
}

// m, what the surface falls by friction between the line and a place behind it, outwards; no more than a fifth of the depth.
double friction_fall(double n2, const InnerState& inner, double outside) {
  if (n2 == 0 || inner.depth <= 0) return 0;
  const double slope = -n2 * inner.inward * std::abs(inner.inward) / (inner.depth * std::cbrt(inner.depth));
  return std::clamp(slope * outside, -0.2 * inner.depth, 0.2 * inner.depth);
}

VecField<double, 1> vectors(std::size_t n, Vec<double, 1>) { return {Field<double>("sisph.rim_x", n)}; }
VecField<double, 2> vectors(std::size_t n, Vec<double, 2>) { return {Field<double>("sisph.rim_x", n), Field<double>("sisph.rim_y", n)}; }

}  // namespace

template <int D>
OpenRim<D>::OpenRim(std::vector<LawInTime> laws, const std::vector<RimPlace<D>>& places, const TracedWater<D>& traced)
    : count_(static_cast<int>(places.size())), gravity_(traced.gravity), spacing_(traced.spacing), laws_(std::move(laws)),
      places_(places), mean_out_(places.size(), 0.0), mean_celerity_(places.size(), 0.0),
      particle_("sisph.rim_particle", places.size()),
      n_(vectors(places.size(), Vec<double, D>{})), velocity_(vectors(places.size(), Vec<double, D>{})),
      foot_depth_("sisph.rim_foot_depth", places.size()), foot_out_("sisph.rim_foot_out", places.size()),
      depth_("sisph.rim_depth", places.size()), foot_v_(vectors(places.size(), Vec<double, D>{})) {
  const auto depth = on_host(traced.water.depth), bed = on_host(traced.water.bed);
  const bool rough = traced.g_n2.extent(0) > 0;
  const auto g_n2 = rough ? on_host(traced.g_n2) : depth;
  std::vector<int> particle;
  std::vector<double> across, along;
  for (const RimPlace<D>& p : places) {
    particle.push_back(p.particle);
    still_.push_back(depth(p.particle));
    bed_.push_back(bed(p.particle));
    n2_.push_back(rough ? g_n2(p.particle) / gravity_ : 0.0);
    across.push_back(p.n.x);
    along.push_back(up(p.n));
  }
  copy_in(particle, particle_);
  copy_in(across, n_.x);
  if constexpr (D == 2) copy_in(along, n_.y);
}

// The laws are host code: a rim has few particles.
template <int D>
void OpenRim<D>::find(const TracedWater<D>& traced, double t, double dt) {
  launch("sisph::trace_back", Range(0, count_),
         TraceBack<D>{{traced}, particle_, n_, foot_v_, foot_depth_, foot_out_, dt});
  const auto foot_depth = on_host(foot_depth_), foot_out = on_host(foot_out_);
  const std::vector<double> depths(foot_depth.data(), foot_depth.data() + count_);
  std::vector<std::vector<double>> share;
  for (std::size_t o = 0; o < laws_.size(); ++o) share.push_back(shares(o, laws_[o](t + dt), depths));
  std::vector<double> depth, out;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const RimPlace<D>& p = places_[k];
    const auto opening = static_cast<std::size_t>(p.opening);
    const double c = std::sqrt(gravity_ * std::max(depths[k], still_[k])), when = t + dt + (c > 0 ? p.outside / c : 0);
    const InnerState inner = inner_state(k, depths[k], foot_out(k), c * dt / spacing_);
    const double fall = friction_fall(n2_[k], inner, p.outside);
    const OpenStrip strip{gravity_, bed_[k] + fall, still_[k], share[opening].empty() ? 0.0 : share[opening][k]};
    const ExteriorState state = exterior_state(laws_[opening](when), inner, strip);
    depth.push_back(state.depth);
    out.push_back(-state.inward);
  }
  copy_in(depth, depth_);
  copy_in(out, foot_out_);
  turn_velocities();
}

// The water before the place, and its slow means: taken on while a wave crosses some spacings, anew on the first water. As in the
// explicit method, what arrives meets a mean inflow so that it ends.
template <int D>
InnerState OpenRim<D>::inner_state(std::size_t k, double depth, double out, double crossed) {
  constexpr double memory = 15;  // spacings
  if (!(depth > 0)) {
    mean_out_[k] = mean_celerity_[k] = 0;
    return {};
  }
  const double c = std::sqrt(gravity_ * depth), part = mean_celerity_[k] == 0 ? 1 : 1 - std::exp(-crossed / memory);
  mean_out_[k] += part * (out - mean_out_[k]);
  mean_celerity_[k] += part * (c - mean_celerity_[k]);
  return {depth, -out, 2 * mean_celerity_[k] - std::abs(mean_out_[k])};
}

// Of a discharge that passes each place, per metre; the first row behind the line stands for the line. Empty for other laws.
template <int D>
std::vector<double> OpenRim<D>::shares(std::size_t opening, const OpenLaw& law, const std::vector<double>& foot_depth) const {
  const auto* discharge = std::get_if<ImposedDischarge>(&law);
  if (!discharge) return {};
  std::vector<Portion> portions;
  std::vector<std::size_t> own;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    if (static_cast<std::size_t>(places_[k].opening) != opening) continue;
    portions.push_back({bed_[k] + foot_depth[k], bed_[k], places_[k].width, foot_depth[k] > 0});
    own.push_back(k);
  }
  const std::vector<double> found = discharge_shares(portions, discharge->by_width || D == 1);
  std::vector<double> all(places_.size(), 0.0);
  for (std::size_t k = 0; k < own.size(); ++k) all[own[k]] = found[k];
  return all;
}

template <int D>
std::vector<double> OpenRim<D>::means() const {
  std::vector<double> all = mean_out_;
  all.insert(all.end(), mean_celerity_.begin(), mean_celerity_.end());
  return all;
}

template <int D>
void OpenRim<D>::set_means(const std::vector<double>& means) {
  const auto middle = means.begin() + count_;
  mean_out_.assign(means.begin(), middle);
  mean_celerity_.assign(middle, means.end());
}

// Leaving water keeps its velocity along the line, entering water has none.
template <int D>
void OpenRim<D>::turn_velocities() {
  const VecField<double, D> n = n_, foot = foot_v_, velocity = velocity_;
  const Field<double> out = foot_out_;
  launch("sisph::turn", Range(0, count_), KOKKOS_LAMBDA(int k) {
        const Vec<double, D> across = at(n, k), at_foot = at(foot, k);
        const Vec<double, D> along = at_foot - dot(at_foot, across) * across;
        put(velocity, k, out(k) * across + (out(k) > 0 ? 1.0 : 0.0) * along);
      });
}

template <int D>
void OpenRim<D>::impose(const Field<double>& bed, const Field<double>& level, const Field<double>& depth) const {
  const Field<int> particle = particle_;
  const Field<double> found = depth_;
  launch("sisph::impose_rim", Range(0, count_), KOKKOS_LAMBDA(int k) {
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
  launch("sisph::rim_before", Range(0, count_), KOKKOS_LAMBDA(int k) {
        const int i = particle(k);
        const double per = dragged ? 1 / (1 + by.drag(i)) : 1.0;
        put(to, i, by.theta * (at(next, k) + (by.impulse * per) * at(by.slope, i)) + (1 - by.theta) * at(by.v, i));
      });
}

template <int D>
void OpenRim<D>::set_end(const VecField<double, D>& end) const {
  const Field<int> particle = particle_;
  const VecField<double, D> next = velocity_, to = end;
  launch("sisph::rim_end", Range(0, count_), KOKKOS_LAMBDA(int k) { put(to, particle(k), at(next, k)); });
}

template class OpenRim<1>;
template class OpenRim<2>;

}  // namespace freshet::sisph
