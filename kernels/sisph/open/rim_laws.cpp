#include "kernels/sisph/open/rim_laws.hpp"

#include <type_traits>

#include "cellgrid/parallel/launch.hpp"
#include "cellgrid/parallel/on_device.hpp"
#include "cellgrid/simd/lanes.hpp"

namespace freshet::sisph {
namespace {

// m, what the surface falls by friction between the line and a place behind it, outwards; no more than a
// fifth of the depth.
KOKKOS_INLINE_FUNCTION double friction_fall(double n2, const InnerState& inner, double outside) {
  if (n2 == 0 || inner.depth <= 0) return 0;
  const double slope = -n2 * inner.inward * ::fabs(inner.inward) / (inner.depth * ::cbrt(inner.depth));
  return clamp(slope * outside, -0.2 * inner.depth, 0.2 * inner.depth);
}

// The first row behind the line stands for the line; places of other openings for nothing.
struct PortionOfPlace {
  Kokkos::View<RimRecord*, Memory> place;
  Field<double> foot_depth;
  int opening;

  KOKKOS_INLINE_FUNCTION Portion operator()(int k) const {
    const RimRecord& p = place(k);
    const bool own = p.opening == opening;
    return {p.bed + foot_depth(k), p.bed, own ? p.width : 0.0, own && foot_depth(k) > 0};
  }
};

template <class Law>
struct FindStates {
  Law kind;
  TimeSeries first, second;
  PortionOfPlace portion;
  RimFeet feet;
  Field<double> mean_out, mean_celerity;
  Kokkos::View<DischargeShares*, Memory> shares;
  double gravity, spacing, t, dt;

  KOKKOS_INLINE_FUNCTION void operator()(int k) const {
    const RimRecord& p = portion.place(k);
    if (p.opening != portion.opening) return;
    const double depth = feet.depth(k), c = ::sqrt(gravity * larger(depth, p.still));
    const double when = t + dt + (c > 0 ? p.outside / c : 0);
    const InnerState inner = inner_state(k, depth, feet.out(k), c * dt / spacing);
    double share = 0;
    if constexpr (std::is_same_v<Law, ImposedDischarge>) share = shares(0).of(portion(k));
    Law law = kind;
    law.set(first.at(when), second.at(when));
    const double fall = friction_fall(p.n2, inner, p.outside);
    const ExteriorState state = imposed(law, inner, {gravity, p.bed + fall, p.still, share});
    feet.next_depth(k) = state.depth;
    feet.out(k) = -state.inward;
  }

  // The water before the place, and its slow means: taken on while a wave crosses some spacings, anew on the
  // first water. As in the explicit method, what arrives meets a mean inflow so that it ends.
  KOKKOS_INLINE_FUNCTION InnerState inner_state(int k, double depth, double out, double crossed) const {
    constexpr double memory = 15;  // spacings
    if (!(depth > 0)) {
      mean_out(k) = mean_celerity(k) = 0;
      return {};
    }
    const double c = ::sqrt(gravity * depth), part = mean_celerity(k) == 0 ? 1 : 1 - ::exp(-crossed / memory);
    mean_out(k) += part * (out - mean_out(k));
    mean_celerity(k) += part * (c - mean_celerity(k));
    return {depth, -out, 2 * mean_celerity(k) - ::fabs(mean_out(k))};
  }
};

}  // namespace

RimLaws::RimLaws(std::vector<LawInTime> laws, const std::vector<RimRecord>& places, double gravity,
                 double spacing, bool by_width)
    : gravity_(gravity), spacing_(spacing), by_width_(by_width), laws_(std::move(laws)),
      place_(on_device("sisph.rim_places", places)), mean_out_("sisph.rim_mean_out", places.size()),
      mean_celerity_("sisph.rim_mean_celerity", places.size()), shares_("sisph.rim_shares", 1) {}

// One place after the other, as sums may not depend on the threads.
void RimLaws::share(int opening, bool by_width, const Field<double>& foot_depth) const {
  const PortionOfPlace portion{place_, foot_depth, opening};
  const auto shares = shares_;
  const int places = place_.extent_int(0);
  launch(
      "sisph::rim_shares", Range(0, 1),
      KOKKOS_LAMBDA(int) { shares(0) = DischargeShares(places, portion, by_width); });
}

void RimLaws::find(const RimFeet& feet, double t, double dt) const {
  for (std::size_t o = 0; o < laws_.size(); ++o) {
    const LawInTime& in_time = laws_[o];
    const int opening = static_cast<int>(o);
    if (const auto* discharge = std::get_if<ImposedDischarge>(&in_time.law))
      share(opening, discharge->by_width || by_width_, feet.depth);
    std::visit(
        [&](const auto& kind) {
          using Law = std::decay_t<decltype(kind)>;
          const FindStates<Law> found{kind,
                                      in_time.first,
                                      in_time.second,
                                      {place_, feet.depth, opening},
                                      feet,
                                      mean_out_,
                                      mean_celerity_,
                                      shares_,
                                      gravity_,
                                      spacing_,
                                      t,
                                      dt};
          launch("sisph::rim_states", Range(0, place_.extent_int(0)), found);
        },
        in_time.law);
  }
}

std::vector<double> RimLaws::means() const {
  const auto out = on_host(mean_out_), celerity = on_host(mean_celerity_);
  std::vector<double> all(out.data(), out.data() + out.extent(0));
  all.insert(all.end(), celerity.data(), celerity.data() + celerity.extent(0));
  return all;
}

void RimLaws::set_means(const std::vector<double>& means) {
  const auto middle = means.begin() + place_.extent_int(0);
  mean_out_ = on_device("sisph.rim_mean_out", std::vector<double>(means.begin(), middle));
  mean_celerity_ = on_device("sisph.rim_mean_celerity", std::vector<double>(middle, means.end()));
}

}  // namespace freshet::sisph
