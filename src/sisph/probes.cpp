// What the run loop asks of the solver's state: totals, point samples, run-up, restart scalars.
#include "src/point_states.hpp"
#include "kernels/choice.hpp"
#include "src/sisph/solver.hpp"

namespace freshet::sisph {
template <int D>
Totals Solver<D>::totals() const {
  Totals totals = passed_;
  const Field<double> mass = particles_.real("mass");
  const Field<int> kind = particles_.integer("kind");
  totals.mass = sum_of_particles<1>("sisph::mass", particles_.size(), KOKKOS_LAMBDA(int i) {
    return Addends<1>{{kind(i) > 0 ? 0.0 : mass(i)}};
  })[0];
  totals.flux = totals.inflow - totals.outflow;
  totals.flux_gross = totals.inflow + totals.outflow;
  return totals;
}

template <int D>
Mechanics Solver<D>::mechanics() const {
  const Water<D> now = water();
  const Field<double> mass = particles_.real("mass");
  const Field<int> kind = particles_.integer("kind");
  const double g = scene_.gravity;
  const auto sums = sum_of_particles<4>("sisph::mechanics", particles_.size(), KOKKOS_LAMBDA(int i) {
    const Vec<double, D> v = at(now.v, i);
    const double h = now.depth(i), m = kind(i) > 0 ? 0.0 : mass(i);
    double across = 0;
    if constexpr (D == 2) across = v.y;
    return Addends<4>{{m * v.x, m * across, 0.5 * m * dot(v, v), m * g * (now.bed(i) + 0.5 * h)}};
  });
  return {{sums[0], sums[1]}, sums[2], sums[3]};
}

template <int D>
std::vector<PointState> Solver<D>::sample(const std::vector<Point>& points) const {
  return point_states(sampler_.sample(sorted_water(), bed_ ? &*bed_ : nullptr, points));
}

template <int D>
void Solver<D>::raise_wet_levels(const Shores& shores) const {
  freshet::raise_wet_levels<D>(sorted_water(), bed_ ? &*bed_ : nullptr, scene_.water.spacing, shores);
}

template <int D>
std::vector<std::string> Solver<D>::features() const {
  std::vector<std::string> names{name_of(scene_.sisph.kernel) + " kernel"};
  if (!scene_.sisph.exact_slopes) names.push_back("slopes normalised by Shepard's sum alone");
  if (moving_) {
    names.push_back("particles that move with the water, paths by " + name_of(scene_.sisph.path));
  } else {
    names.push_back("particles at rest");
    names.push_back(paths_ ? "velocity along particle paths" : "momentum carried by the mass fluxes");
  }
  if (conservative_) names.push_back("conservative pressure");
  if (scene_.sisph.recomputed) names.push_back("coefficients found anew in every product");
  if (closure_.iterations > 0)
    names.push_back("pair areas closed in " + std::to_string(closure_.iterations) + " iterations, largest change " +
                    std::to_string(closure_.change));
  if (closure_.negative > 0) names.push_back(std::to_string(closure_.negative) + " pair areas below zero");
  if (bed_) names.push_back("bed");
  if (!scene_.walls.empty()) names.push_back("walls of mirror pairs");
  if (scene_.manning) names.push_back("friction, implicit");
  if (viscosity_) names.push_back(scene_.sisph.slip ? "viscosity, implicit" : "viscosity, implicit; walls hold the water");
  if (open_) names.push_back(std::to_string(scene_.boundaries.size()) + " open " + (scene_.boundaries.size() == 1 ? "boundary" : "boundaries"));
  if (held_ > static_cast<int>(open_ ? open_->size() : 0)) names.push_back(moving_ ? "sides that go with the water beside them" : "sides held at their state at t = 0");
  return names;
}

template <int D>
ScalarState Solver<D>::scalars() const {
  const auto number = [](auto value) { return static_cast<double>(value); };
  ScalarState state{{"passed", {passed_.inflow, passed_.outflow}},
          {"solver", {number(report_.passes), number(report_.solves), number(report_.iterations), number(report_.unsettled),
                      number(report_.newton_max)}}};
  if (moving_) {
    state["moving"] = {moving_->jump(), last_dt_, moving_->meshed() ? 1.0 : 0.0, allowed_, number(shortened_)};
    return state;
  }
  if (open_) state["rim"] = open_->means();
  state["mesh"] = {surface_->meshed() ? 1.0 : 0.0};
  return state;
}

template <int D>
void Solver<D>::restore(const ScalarState& state) {
  passed_.inflow = state.at("passed")[0];
  passed_.outflow = state.at("passed")[1];
  const std::vector<double>& solver = state.at("solver");
  report_.passes = static_cast<long>(solver[0]);
  report_.solves = static_cast<long>(solver[1]);
  report_.iterations = static_cast<long>(solver[2]);
  report_.unsettled = static_cast<long>(solver[3]);
  report_.newton_max = static_cast<int>(solver[4]);
  if (moving_) {
    moving_->set_jump(state.at("moving")[0]);
    last_dt_ = state.at("moving")[1];
    moving_->set_meshed(state.at("moving")[2] > 0);
    allowed_ = state.at("moving")[3];
    shortened_ = static_cast<long>(state.at("moving")[4]);
    settle_order();
    return measure_speeds();
  }
  surface_->set_meshed(state.at("mesh")[0] > 0);
  if (open_) open_->set_means(state.at("rim"));
  measure_speeds();
}

template class Solver<1>;
template class Solver<2>;

}  // namespace freshet::sisph
