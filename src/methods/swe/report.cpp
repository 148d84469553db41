// What the run loop asks of the state: totals, features, restart scalars.
#include "cellgrid/parallel/launch.hpp"
#include "kernels/choice.hpp"
#include "src/methods/swe/solver.hpp"

namespace freshet::swe {

template <int D>
Totals ExplicitSph<D>::totals() const {
  Totals totals;
  const Particles<D> p = bind();
  const Field<int> kinds = kind();
  const bool open = !boundaries_.empty();
  const int n = particles_.size();
  totals.mass = sum_of_particles<1>(
      "swe::mass", n, KOKKOS_LAMBDA(int i) { return Addends<1>{open && kinds(i) != 0 ? 0.0 : p.m(i)}; })[0];
  for (const auto& boundary : boundaries_) {
    const OpenFlow flow = boundary.flow();
    totals.inflow += flow.inflow;
    totals.outflow += flow.outflow;
    totals.flux += flow.flux;
    totals.flux_gross += flow.flux_gross;
    totals.straddle += flow.straddle0 - boundary.straddling(p, kinds, n);
  }
  return totals;
}

// The variational acceleration belongs to water that follows the bed: its vertical velocity v . grad b
// counts.
template <int D>
Mechanics ExplicitSph<D>::mechanics() const {
  const Particles<D> p = bind();
  const Field<int> kinds = kind();
  const std::optional<BedTerm<D>> beds = bed_term();
  const bool open = !boundaries_.empty(), with_bed = beds.has_value(), rising = with_bed && beds->variational;
  const double g = scene_.gravity;
  const auto sums = sum_of_particles<4>(
      "swe::mechanics", particles_.size(), KOKKOS_LAMBDA(int i) {
        Addends<4> sum{};
        if (open && kinds(i) != 0) return sum;
        const Vec<double, D> v = at(p.v, i);
        const double up = rising ? dot(v, beds->spline.sloped_at(at(p.x, i)).slope) : 0.0;
        sum[0] = p.m(i) * v.x;
        if constexpr (D == 2) sum[1] = p.m(i) * v.y;
        sum[2] = 0.5 * p.m(i) * (dot(v, v) + up * up);
        sum[3] = p.m(i) * g * ((with_bed ? beds->level(i) : 0.0) + 0.5 * p.rho(i));
        return sum;
      });
  return {{sums[0], sums[1]}, sums[2], sums[3]};
}

template <int D>
std::vector<std::string> ExplicitSph<D>::features() const {
  std::vector<std::string> names{name_of(scene_.sph.kernel) + " kernel", "density Newton",
                                 std::visit([](const auto& s) { return s.title; }, stabilise_)};
  if (gradient_) names.push_back("velocity gradient");
  if (depth_gradient_) names.push_back("depth gradient");
  if (scene_.sph.well_balanced) names.push_back("well-balanced bed");
  else if (bed_)
    names.push_back(variational_ ? "bed, variational acceleration"
                    : scene_.sph.acceleration == Acceleration::classical
                        ? "bed, classical acceleration"
                        : "bed, classical acceleration (nearly flat: the variational one is within 1e-6 g)");
  if (friction_)
    names.push_back(friction_->roughness2.given() ? "Manning friction by place" : "Manning friction");
  if (walls_)
    names.push_back("walls (" + std::string(walls_->kind().title) + "), " + std::to_string(walls_->points()) +
                    " points");
  if (!boundaries_.empty()) names.push_back("open boundaries: " + std::to_string(boundaries_.size()));
  if (scene_.split) names.push_back("splitting into " + std::to_string(scene_.split->into));
  if (scene_.merge) names.push_back("merging");
  return names;
}

template <int D>
ScalarState ExplicitSph<D>::scalars() const {
  ScalarState state{{"crossing_time", {crossing_time_}},
                    {"next_id", {static_cast<double>(next_id_)}},
                    {"rebuilds", {static_cast<double>(report_.rebuilds)}}};
  for (size_t k = 0; k < boundaries_.size(); ++k)
    state["boundary." + std::to_string(k)] = boundaries_[k].save();
  if (refinement_) state["refinement"] = refinement_->save();
  return state;
}

template <int D>
void ExplicitSph<D>::restore(const ScalarState& state) {
  crossing_time_ = state.at("crossing_time").at(0);
  next_id_ = static_cast<int>(state.at("next_id").at(0));
  report_.rebuilds = static_cast<long>(state.at("rebuilds").at(0));
  for (size_t k = 0; k < boundaries_.size(); ++k)
    boundaries_[k].restore(state.at("boundary." + std::to_string(k)));
  if (refinement_) refinement_->restore(state.at("refinement"));
  const Particles<D> p = bind();
  launch(
      "swe::restore", Range(0, particles_.size()), KOKKOS_LAMBDA(int i) { p.inv_h(i) = 1.0 / p.h(i); });
  find_neighbours();  // the saved order is sorted already; gauges and walls ask for rows and lists before the
                      // next step
}

template class ExplicitSph<1>;
template class ExplicitSph<2>;

}  // namespace freshet::swe
