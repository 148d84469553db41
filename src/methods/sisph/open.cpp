// Formulation E's open boundaries: who stands behind them, and what they hold there.
#include "src/methods/sisph/at_rest.hpp"
#include "src/methods/sisph/side_at.hpp"
#include "src/scene/place/place.hpp"
#include "src/scene/sections/boundaries/open_law.hpp"

namespace freshet::sisph {

template <int D>
std::vector<RimPlace<D>> EulerianSph<D>::rim_places() const {
  const auto kind = on_host(particles_.integer("kind"));
  const std::vector<Point> at = Base::places();
  std::vector<RimPlace<D>> places;
  for (int i = 0; i < particles_.size(); ++i) {
    const SideAt side = kind(i) > 0 ? side_at(scene_, at[static_cast<std::size_t>(i)]) : SideAt{};
    if (side.opening < 0) continue;
    const int across = D == 2 && side.n[1] != 0 ? 1 : 0;
    const double width = D == 2 ? cell_width(scene_, 1 - across) : 1.0;  // m
    const bool first_row = side.outside < cell_width(scene_, across);
    places.push_back({i, side.opening, side.outside, first_row ? width : 0.0, to_vec<D>(side.n)});
  }
  return places;
}

template <int D>
void EulerianSph<D>::build_openings() {
  if (scene_.boundaries.empty()) return;
  std::vector<LawInTime> laws;
  for (const OpenBoundary& boundary : scene_.boundaries) laws.push_back(law_in_time(boundary));
  open_.emplace(std::move(laws), rim_places(), traced());
}

template <int D>
TracedWater<D> EulerianSph<D>::traced() const {
  return {order_.rows(), geometry_.x, water(), g_n2_, scene_.gravity, scene_.water.spacing};
}

template <int D>
void EulerianSph<D>::extend_slope(const Field<double>& depth) {
  if (!open_) return;
  TracedWater<D> traced_now = traced();
  traced_now.water.depth = depth;
  open_->extend(traced_now, slope_);
}

// The friction of the water at t, and the rim's state at t + dt.
template <int D>
void EulerianSph<D>::meet_boundaries(double t, double dt) {
  const Layer<D> now = water();
  if (drag_.extent(0) > 0) find_drag<D>(particles_.size(), now, g_n2_, dt, drag_);
  if (!open_) return;
  open_->find(traced(), t, dt);
  open_->impose(now.bed, surface_.level(), surface_.depth());
}

template class EulerianSph<1>;
template class EulerianSph<2>;

}  // namespace freshet::sisph
